"""What an archive holds, what its crate says of it, and that the same files give the same bytes."""

import gzip
import json
import os
import subprocess
import tarfile

import pytest
import yaml
from helpers import ROOT
from latticode.datasets import netcdf
from pendula import __version__
from replication.archive import pack
from replication.archive.contents import METADATA, ArchiveError, code_files
from rocrate.rocrate import ROCrate

CITATION = yaml.safe_load((ROOT / "CITATION.cff").read_text())
FIGURE, DATASET = "results/figures/fig2.png", "results/figures/fig2.nc"


def git(folder, *words):
    subprocess.run(["git", "-C", str(folder), *words], check=True, capture_output=True)


PROJECT = pack.Project(ROOT, "pendula", __version__)


@pytest.fixture
def project(tmp_path):
    """Return a folder with two files; the second may be run as a program."""
    folder = tmp_path / "project"
    (folder / "scripts").mkdir(parents=True)
    (folder / "scripts/a.py").write_text("a")
    (folder / "run").write_text("b")
    (folder / "run").chmod(0o700)
    return folder


def test_a_clone_of_git_gives_its_tracked_files(project):
    git(project, "init")
    git(project, "add", ".")
    (project / "scripts/untracked.py").write_text("c")
    assert code_files(project) == ["run", "scripts/a.py"]
    (project / "run").unlink()
    with pytest.raises(ArchiveError, match=r"run is missing: restore it"):
        code_files(project)


def test_results_of_code_that_is_left_behind_are_refused(project):
    git(project, "init")
    git(project, "add", "run")
    with pytest.raises(ArchiveError, match=r"scripts/a.py made.*`git add` it"):
        pack.pack_results(
            pack.Project(project, "waves", "1"), [], ["scripts/a.py"], "a.tar.gz", "a.sha256", {}
        )


def test_the_same_files_give_the_same_bytes_and_belong_to_nobody(project, tmp_path):
    """Whatever their times and permissions are, and in whatever order they come."""
    files = {"run": project / "run", "a": project / "scripts/a.py", "results/b": project / "run"}
    texts = dict.fromkeys(METADATA[:2], "said")
    pack.pack(tmp_path / "first.tar.gz", "pendula-1", files, texts)
    os.utime(project / "run")
    (project / "run").chmod(0o755)
    (project / "scripts/a.py").chmod(0o600)
    pack.pack(tmp_path / "second.tar.gz", "pendula-1", dict(reversed(files.items())), texts)
    packed = (tmp_path / "first.tar.gz").read_bytes()
    assert packed == (tmp_path / "second.tar.gz").read_bytes()
    assert b"first" not in gzip.decompress(packed)[:1024] + packed[:32]
    with tarfile.open(tmp_path / "first.tar.gz") as tar:
        entries = tar.getmembers()
        tar.extractall(tmp_path, filter="data")
    modes = {entry.name: entry.mode for entry in entries if entry.mode != 0o644}
    assert modes == {"pendula-1/run": 0o755, "pendula-1/results/b": 0o755}
    assert {(e.uid, e.gid, e.uname, e.gname) for e in entries} == {(0, 0, "", "")}
    assert code_files(tmp_path / "pendula-1") == ["a", "run"]


def test_a_configuration_is_written_whole():
    brief = {"end_time": 4}
    both = {"cases": {"one": brief, "two": brief}, "sites": ({0: [1, "2j"]},)}
    text = yaml.dump(both, Dumper=pack.AliasFreeDumper)
    assert text.count("end_time: 4") == 2 and "&" not in text and "0:" in text


@pytest.fixture
def members(tmp_path):
    """Return files of an archive, one of which is a dataset on disk."""
    netcdf.write(tmp_path / "fig2.nc", {}, {"title": "The lifetime of a breather"})
    (tmp_path / "other").write_text("content")
    content = ("Snakefile", "README.md", FIGURE, "results/mine a.md")
    return dict.fromkeys(content, tmp_path / "other") | {DATASET: tmp_path / "fig2.nc"}


def test_the_crate_is_read_back_with_what_it_says_of_each_file(members, tmp_path):
    folder = tmp_path / "crate"
    for name in members:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text("content")
    described = pack.describe(PROJECT, members)
    (folder / "ro-crate-metadata.json").write_text(json.dumps(described))
    read = ROCrate(folder)
    assert read.mainEntity.id == "Snakefile" and read.name == CITATION["title"]
    paper = read.root_dataset["citation"]
    assert paper["name"] == CITATION["references"][0]["title"]
    entities = {entity["@id"]: entity for entity in described["@graph"]}
    licenses = [entities[name]["license"]["@id"].rpartition("/")[2] for name in ("./", DATASET)]
    assert licenses == [CITATION["license"], "CC-BY-4.0"]
    assert entities["./"]["author"] == [{"@id": "#The-pendula-maintainers"}]
    assert entities[DATASET]["description"] == "The lifetime of a breather"
    assert entities[FIGURE]["isBasedOn"] == {"@id": DATASET}
    assert "results/mine%20a.md" in entities


def test_the_same_files_give_the_same_description_at_any_time(members, monkeypatch):
    described = pack.describe(PROJECT, members)
    monkeypatch.setattr("rocrate.model.root_dataset.iso_now", lambda: "2001-01-01T00:00:00+00:00")
    reordered = pack.describe(PROJECT, dict(reversed(members.items())))
    assert json.dumps(reordered) == json.dumps(described)
    assert "2001" not in json.dumps(described)


def test_citation_changelog_and_library_have_one_version():
    released = f"\n## {__version__}, {CITATION['date-released']}\n"
    assert CITATION["version"] == __version__ and released in (ROOT / "CHANGELOG.md").read_text()


def test_codecheck_lists_files_of_the_run_and_cites_the_paper():
    """The fields are those of https://codecheck.org.uk/spec/config/2.0/ that authors fill in."""
    text = (ROOT / "codecheck.yml").read_text()
    check = yaml.safe_load(text)
    hashes = json.loads((ROOT / "tests/baseline/hashes.json").read_text())["files"]
    assert text.startswith("---\n") and all(entry["comment"] for entry in check["manifest"])
    assert {entry["file"] for entry in check["manifest"]} <= {f"results/{name}" for name in hashes}
    paper = check["paper"]
    assert (paper["title"], paper["authors"]) == (CITATION["title"], CITATION["authors"])
    assert paper["reference-other"] == [f"https://doi.org/{CITATION['references'][0]['doi']}"]
