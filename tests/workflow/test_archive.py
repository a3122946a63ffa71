"""The archive of the quick run, unpacked elsewhere: what is in it, and what is to be done there.

Lost figures are drawn anew there by tests/docs/test_commands.py, as docs/archive.md prints it.
"""

import getpass
import json
import os
import socket
import subprocess
import tarfile
from pathlib import Path

import pytest
from helpers import ROOT, edit, planned, snakemake
from pendula import __version__

NAME = f"pendula-{__version__}"
ARCHIVE = f"results/archive/{NAME}.tar.gz"


@pytest.fixture
def unpacked(full_run, tmp_path) -> Path:
    """Return the folder that the archive holds, unpacked by tar."""
    subprocess.run(["tar", "-xzf", full_run / ARCHIVE, "-C", tmp_path], check=True)
    return tmp_path / NAME


def test_the_checksums_hold(full_run, unpacked):
    for folder, name in (
        (full_run / "results/archive", f"{NAME}.tar.gz.sha256"),
        (unpacked, "manifest-sha256.txt"),
    ):
        check = ["sha256sum", "--check", "--strict", "--quiet", name]
        assert subprocess.run(check, cwd=folder).returncode == 0
    listed = (unpacked / "manifest-sha256.txt").read_text().splitlines()
    actual = {p.relative_to(unpacked).as_posix() for p in unpacked.rglob("*") if p.is_file()}
    assert {line.split("  ")[1] for line in listed} == actual - {"manifest-sha256.txt"}


def test_nothing_is_to_be_done_where_it_is_unpacked(unpacked):
    """Neither of Snakemake's own records nor of the times of files is there."""
    assert planned(unpacked, unpacked) == {}


def test_the_archive_is_packed_anew_when_any_file_changes(full_run, unpacked):
    assert not (unpacked / ".git").exists()
    assert planned(unpacked, full_run, "archive") == {}
    edit(unpacked / "LICENSE", "BSD 3-Clause License", "BSD 3-Clause Licence")
    assert planned(unpacked, full_run, "archive") == {"archive": 1}


def test_the_crate_describes_every_result(full_run):
    with tarfile.open(full_run / ARCHIVE) as tar:
        graph = json.load(tar.extractfile(f"{NAME}/ro-crate-metadata.json"))["@graph"]
        files = [entry.name.removeprefix(f"{NAME}/") for entry in tar if entry.isfile()]
    results = {name for name in files if name.startswith("results/")}
    assert len(results) > 100 and results <= {entity["@id"] for entity in graph}


def test_nothing_in_it_tells_of_the_machine(full_run):
    user = getpass.getuser()
    telling = [str(full_run), str(ROOT), str(Path.home() / "."), socket.gethostname(), f"{user}@"]
    secrets = [word.encode() for word in telling if len(word) > 4]
    with tarfile.open(full_run / ARCHIVE) as tar:
        for entry in tar:
            content = tar.extractfile(entry).read()
            assert not [word for word in secrets if word in content], entry.name
            assert os.path.splitext(entry.name)[1] != ".log"


def test_a_project_that_is_neither_cloned_nor_unpacked_is_refused_in_words(full_run, clone):
    result = snakemake(clone, full_run, "--dry-run", "archive")
    assert result.returncode != 0
    assert "manifest-sha256.txt is missing" in result.stdout
    assert "pack it from a clone or from an unpacked archive" in result.stdout
