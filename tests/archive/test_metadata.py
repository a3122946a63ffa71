"""The crate of the archive: what it says, and that its library reads it back."""

import json

import pytest
import yaml
from helpers import ROOT
from pendula import __version__
from pendula.archive.metadata import describe_archive
from pendula.datasets import netcdf
from rocrate.rocrate import ROCrate

CITATION = yaml.safe_load((ROOT / "CITATION.cff").read_text())
FIGURE, DATASET = "results/figures/fig2.png", "results/figures/fig2.nc"


@pytest.fixture
def members(tmp_path):
    """Return files of an archive, one of which is a dataset on disk."""
    netcdf.write(tmp_path / "fig2.nc", {}, {"title": "The lifetime of a breather"})
    content = dict.fromkeys(("Snakefile", "README.md", FIGURE, "results/mine a.md"), b"content")
    return {**content, DATASET: tmp_path / "fig2.nc"}


@pytest.fixture
def described(members):
    return describe_archive(ROOT, members)


def test_citation_changelog_and_library_have_one_version():
    released = f"\n## {__version__}, {CITATION['date-released']}\n"
    assert CITATION["version"] == __version__ and released in (ROOT / "CHANGELOG.md").read_text()


def test_code_and_results_have_their_licences(described):
    entities = {entity["@id"]: entity for entity in described["@graph"]}
    found = [entities[name]["license"]["@id"].rpartition("/")[2] for name in ("./", DATASET)]
    assert found == [CITATION["license"], "CC-BY-4.0"]


def test_codecheck_lists_files_of_the_run_and_cites_the_paper():
    """The fields are those of https://codecheck.org.uk/spec/config/2.0/ that authors fill in."""
    text = (ROOT / "codecheck.yml").read_text()
    check = yaml.safe_load(text)
    made = json.loads((ROOT / "tests/baseline/hashes.json").read_text())["files"]
    assert text.startswith("---\n") and all(one["comment"] for one in check["manifest"])
    assert {one["file"] for one in check["manifest"]} <= {f"results/{name}" for name in made}
    paper = check["paper"]
    assert (paper["title"], paper["authors"]) == (CITATION["title"], CITATION["authors"])
    assert paper["reference-other"] == [f"https://doi.org/{CITATION['references'][0]['doi']}"]


def test_the_crate_is_read_back_with_its_workflow_and_the_paper(described, members, tmp_path):
    folder = tmp_path / "crate"
    for name in members:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text("content")
    (folder / "ro-crate-metadata.json").write_text(json.dumps(described))
    read = ROCrate(folder)
    assert read.mainEntity.id == "Snakefile" and read.name == CITATION["title"]
    paper = read.root_dataset["citation"]
    assert paper["name"] == CITATION["references"][0]["title"]
    assert [author["name"] for author in paper["author"]][2] == "D. E. Pelinovsky"


def test_a_dataset_is_described_by_its_title_and_a_figure_by_its_dataset(described):
    """A study that is added needs no line here."""
    entities = {entity["@id"]: entity for entity in described["@graph"]}
    assert entities[DATASET]["description"] == "The lifetime of a breather"
    assert entities[FIGURE]["isBasedOn"] == {"@id": DATASET}
    assert "results/mine%20a.md" in entities


def test_the_same_files_give_the_same_description_at_any_time(described, members, monkeypatch):
    monkeypatch.setattr("rocrate.model.root_dataset.iso_now", lambda: "2001-01-01T00:00:00+00:00")
    again = describe_archive(ROOT, dict(reversed(members.items())))
    assert json.dumps(again) == json.dumps(described)
    assert "2001" not in json.dumps(described)
