"""What an archive holds, and that the same files give the same bytes."""

import gzip
import os
import subprocess
import tarfile

import pytest
from pendula.archive.contents import (
    MANIFEST,
    ArchiveError,
    check_code,
    code_files,
    dump_configuration,
    manifest,
    names_in,
    pack,
)


def git(folder, *words):
    subprocess.run(["git", "-C", str(folder), *words], check=True, capture_output=True)


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
    with pytest.raises(ArchiveError, match=r"run is missing; put it back"):
        code_files(project)


def test_an_unpacked_archive_gives_what_its_manifest_lists(project):
    with pytest.raises(ArchiveError, match=r"manifest-sha256.txt is missing.*pack it from a clone"):
        code_files(project)
    members = {name: project / name for name in ("run", "scripts/a.py")}
    members |= {"ro-crate-metadata.json": b"{}", "results/claims.json": b"[]"}
    (project / MANIFEST).write_bytes(manifest(members))
    assert code_files(project) == ["run", "scripts/a.py"]


def test_results_of_code_that_is_left_behind_are_refused(project):
    made_by = ["scripts/a.py", "scripts/untracked.py"]
    with pytest.raises(ArchiveError, match=r"scripts/untracked.py made.*`git add` it"):
        check_code(made_by, ["run", "scripts/a.py"])
    check_code(made_by, ["run", *made_by])


def test_the_manifest_is_accepted_by_sha256sum(project):
    (project / MANIFEST).write_bytes(manifest({"run": project / "run", "note": b"said"}))
    (project / "note").write_text("said")
    check = ["sha256sum", "--check", "--strict", MANIFEST]
    assert subprocess.run(check, cwd=project, capture_output=True).returncode == 0
    (project / "note").write_text("something else")
    assert subprocess.run(check, cwd=project, capture_output=True).returncode == 1
    assert names_in((project / MANIFEST).read_text()) == ["note", "run"]


def test_the_same_files_give_the_same_bytes_and_belong_to_nobody(project, tmp_path):
    """Whatever their times and permissions are, and in whatever order they come."""
    members = {"run": project / "run", "a": project / "scripts/a.py", "note": b"said"}
    pack(tmp_path / "first.tar.gz", "pendula-1", members)
    os.utime(project / "run")
    (project / "run").chmod(0o755)
    (project / "scripts/a.py").chmod(0o600)
    pack(tmp_path / "second.tar.gz", "pendula-1", dict(reversed(members.items())))
    packed = (tmp_path / "first.tar.gz").read_bytes()
    assert packed == (tmp_path / "second.tar.gz").read_bytes()
    assert b"first" not in gzip.decompress(packed)[:1024] + packed[:32]
    with tarfile.open(tmp_path / "first.tar.gz") as tar:
        entries = tar.getmembers()
        assert tar.extractfile("pendula-1/note").read() == b"said"
    modes = {entry.name.removeprefix("pendula-1/"): entry.mode for entry in entries}
    assert modes == {"a": 0o644, "note": 0o644, "run": 0o755}
    assert {(e.uid, e.gid, e.uname, e.gname) for e in entries} == {(0, 0, "", "")}


def test_a_configuration_is_written_whole():
    brief = {"end_time": 4}
    text = dump_configuration(
        {"cases": {"one": brief, "two": brief}, "sites": ({0: [1, "2j"]},)}
    ).decode()
    assert text.count("end_time: 4") == 2 and "&" not in text and "0:" in text
