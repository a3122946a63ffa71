"""The crate of the archive: what it says, and that its library reads it back."""

import json

import pytest
import yaml
from pendula import __version__
from pendula.archive.metadata import describe_archive
from pendula.datasets import netcdf
from pendula.sources import SCRIPTS
from rocrate.rocrate import ROCrate

PROJECT = SCRIPTS.parent
CITATION = yaml.safe_load((PROJECT / "CITATION.cff").read_text())
FIGURE, DATASET = "results/figures/fig2.png", "results/figures/fig2.nc"


@pytest.fixture
def members(tmp_path):
    """Return files of an archive, one of which is a dataset on disk."""
    netcdf.write(tmp_path / "fig2.nc", {}, {"title": "The lifetime of a breather"})
    content = dict.fromkeys(("Snakefile", "README.md", FIGURE, "results/mine a.md"), b"content")
    return {**content, DATASET: tmp_path / "fig2.nc"}


@pytest.fixture
def described(members):
    return describe_archive(PROJECT, members)


def test_the_citation_speaks_of_this_version():
    assert CITATION["version"] == __version__


def test_the_crate_is_read_back_with_its_workflow_and_the_paper(described, members, tmp_path):
    folder = tmp_path / "crate"
    for name in members:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text("content")
    (folder / "ro-crate-metadata.json").write_text(json.dumps(described))
    read = ROCrate(folder)
    assert read.mainEntity.id == "Snakefile" and read.name == CITATION["title"]
    paper = read.root_dataset["citation"]
    assert paper["name"] == CITATION["preferred-citation"]["title"]
    assert [author["name"] for author in paper["author"]][2] == "D. E. Pelinovsky"


def test_a_dataset_is_described_by_its_title_and_a_figure_by_its_dataset(described):
    """A study that is added needs no line here."""
    entities = {entity["@id"]: entity for entity in described["@graph"]}
    assert entities[DATASET]["description"] == "The lifetime of a breather"
    assert entities[FIGURE]["isBasedOn"] == {"@id": DATASET}
    assert "results/mine%20a.md" in entities


def test_the_same_files_give_the_same_description_at_any_time(described, members, monkeypatch):
    monkeypatch.setattr("rocrate.model.root_dataset.iso_now", lambda: "2001-01-01T00:00:00+00:00")
    again = describe_archive(PROJECT, dict(reversed(members.items())))
    assert json.dumps(again) == json.dumps(described)
    assert "2001" not in json.dumps(described)
