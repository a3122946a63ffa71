"""Metadata of the archive: built from the project's own files, valid by other people's tools."""

import json

import jsonschema
import netCDF4
import pytest
import yaml
from helpers import package
from metadata_schemas import CODEMETA, CRATE
from offline_contexts import Answer, codemeta_context
from pendula import __version__
from pendula.archive import metadata
from pendula.archive.metadata import agent, read_about
from pendula.datasets import netcdf
from pendula.sources import SCRIPTS
from rocrate.rocrate import ROCrate

PROJECT = SCRIPTS.parent
NEEDS = "-r tests/archive/requirements.txt"
NAMES = (
    *("Snakefile", "README.md", "LICENSE", "config/config.yaml", "scripts/pendula/problem.py"),
    *("results/figures/fig2.png", "results/figures/fig2.nc", "results/trajectories/mine a.nc"),
)


@pytest.fixture(scope="module")
def about():
    return read_about(PROJECT)


@pytest.fixture(scope="module")
def described(about):
    return metadata.describe_archive(about, dict.fromkeys(NAMES, b"content"))


@pytest.fixture
def folder(described, tmp_path):
    """Return a folder with the files of that crate."""
    for name in NAMES:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("content")
    (tmp_path / "ro-crate-metadata.json").write_text(json.dumps(described))
    return tmp_path


def by_id(description: dict) -> dict[str, dict]:
    return {entity["@id"]: entity for entity in description["@graph"]}


def test_the_citation_speaks_of_this_version(about):
    citation = yaml.safe_load((PROJECT / "CITATION.cff").read_text())
    assert citation["version"] == __version__ == about.version


def test_the_crate_is_flat_and_every_link_in_it_leads_somewhere(described):
    jsonschema.validate(described, CRATE)
    entities = by_id(described)
    assert len(entities) == len(described["@graph"])
    outside = (
        "https://w3id.org/ro/",
        "https://w3id.org/workflowhub/workflow-ro-crate/",
        "https://bioschemas.org/",
        "https://snakemake.readthedocs.io",
        "https://doi.org/10.1093/bioinformatics/bts480",  # the paper on Snakemake
    )
    for entity in entities.values():
        for value in entity.values():
            for link in value if isinstance(value, list) else [value]:
                if isinstance(link, dict) and not link["@id"].startswith(outside):
                    assert link["@id"] in entities


def test_the_crate_names_the_workflow_the_paper_and_the_files(described, about):
    entities = by_id(described)
    root = entities["./"]
    parts = {part["@id"] for part in root["hasPart"]}
    workflow = entities[root["mainEntity"]["@id"]]
    assert entities[workflow["programmingLanguage"]["@id"]]["name"] == "Snakemake"
    assert entities[root["citation"]["@id"]]["name"] == about.paper["title"]
    assert {"results/figures/fig2.png", "results/trajectories/mine%20a.nc", "scripts/"} <= parts
    assert entities["results/figures/fig2.png"]["isBasedOn"] == {"@id": "results/figures/fig2.nc"}


def test_the_same_files_give_the_same_description_at_any_time(about, monkeypatch):
    members = dict.fromkeys(NAMES, b"content")
    first = json.dumps(metadata.describe_archive(about, members))
    monkeypatch.setattr("rocrate.model.root_dataset.iso_now", lambda: "2001-01-01T00:00:00+00:00")
    assert json.dumps(metadata.describe_archive(about, dict(reversed(members.items())))) == first
    assert "2001" not in first and about.released in first


def test_a_dataset_is_described_by_its_own_title(about, tmp_path):
    """A study that is added needs no line here."""
    titled, plain = tmp_path / "titled.nc", tmp_path / "plain.nc"
    netcdf.write(titled, {}, {"title": "The lifetime of a breather"})
    netCDF4.Dataset(plain, "w").close()
    members = {"Snakefile": b"", "results/new/a.nc": titled, "results/new/b.nc": plain}
    entities = by_id(metadata.describe_archive(about, members))
    assert entities["results/new/a.nc"]["description"] == "The lifetime of a breather"
    assert entities["results/new/b.nc"]["description"] == "A dataset"


def test_authors_may_be_people():
    person = {"family-names": "Noether", "given-names": "Emmy", "orcid": "https://orcid.org/0"}
    assert agent(person)["name"] == "Emmy Noether" and agent(person)["@id"] == person["orcid"]


def test_the_crate_holds_by_the_validator_of_its_profile(folder, monkeypatch):
    services = package("rocrate_validator.services", NEEDS)
    from rocrate_validator.utils.http import HttpRequester

    monkeypatch.setattr(HttpRequester, "get", lambda *_, **__: Answer(), raising=False)
    settings = services.ValidationSettings(
        rocrate_uri=str(folder),
        profile_identifier="workflow-ro-crate-1.0",
        requirement_severity="REQUIRED",
        cache_path=folder / "cache",
        offline=True,
        skip_availability_check=True,
    )
    result = services.validate(settings)
    assert result.passed(), [
        (issue.check.identifier, issue.message) for issue in result.get_issues()
    ]


def test_the_crate_is_read_back(folder, about):
    read = ROCrate(folder)
    assert read.mainEntity.id == "Snakefile" and read.name == about.title
    assert {entity.id for entity in read.data_entities} >= {"LICENSE", "results/figures/fig2.nc"}


def test_codemeta_has_what_catalogues_ask_for(about):
    jsonschema.validate(metadata.describe_software(about), CODEMETA)


def test_codemeta_uses_words_that_codemeta_defines(about):
    jsonld = package("pyld.jsonld", NEEDS)
    package("codemeta", NEEDS)

    def load(url, _):
        assert url == metadata.CONTEXT
        return {"contextUrl": None, "documentUrl": url, "document": codemeta_context()}

    described = metadata.describe_software(about)
    (found,) = jsonld.expand(described, {"documentLoader": load, "base": "file:///"})
    known = ("http://schema.org/", "https://codemeta.github.io/terms/", "@")
    assert len(found) == len(described) - 1 and all(key.startswith(known) for key in found)
    assert found["@type"] == ["http://schema.org/SoftwareSourceCode"]
    (paper,) = found["https://codemeta.github.io/terms/referencePublication"]
    assert paper["@id"].endswith(about.paper["doi"]) and paper["@type"][0].startswith(known[0])
