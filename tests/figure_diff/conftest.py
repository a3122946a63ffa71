"""A run and the baseline that was accepted from it, to plant faults into."""

import json
import shutil
from hashlib import sha256
from pathlib import Path
from typing import NamedTuple

import made_up_results as made_up
import netCDF4
import pytest
from latticode.datasets.json_files import ENTRY, load_json, write_json
from latticode.datasets.netcdf import LENGTH, MARK, read
from pendula.figure_diff import Finding, Verdict, acceptance, baseline


class Run(NamedTuple):
    """Folders of the results and of the baseline."""

    made: Path
    accepted: Path

    def judge(self, names=made_up.NAMES, any_bits=False) -> Verdict:
        """Compare these files of the run with the baseline."""
        return baseline.compare(names, *self, made_up.CONFIGURATION, any_bits)

    def findings(self, **options) -> dict[str, Finding]:
        """Compare, and return what was found of each file."""
        return {finding.name: finding for finding in self.judge(**options).findings}

    def accept(self, names=made_up.NAMES, words=()) -> str:
        """Take the run, or the files that words name, as the baseline; return what is told."""
        return acceptance.accept(names, *self, made_up.CONFIGURATION, words)

    def change(self, name: str, change) -> None:
        """Write a dataset of the run anew, as `change` returns it, without a check of its form."""
        changed = change(read(self.made / name))
        for variable in changed.variables.values():
            variable.encoding = {"_FillValue": None}
        changed.to_netcdf(self.made / name, engine="netcdf4", format="NETCDF4")
        seal(self.made / name)

    def hide(self, name: str, hidden) -> None:
        """Put into a dataset of the run what `hidden` adds to its file and xarray does not show."""
        path = self.made / name
        path.write_bytes(path.read_bytes()[:-LENGTH])
        with netCDF4.Dataset(path, "a") as file:
            hidden(file)
        seal(path)

    def edit(self, name: str, old: str, new: str, sealed: bool = True) -> None:
        """Replace a text in a file of the run, and renew the checksum of JSON if it is sealed."""
        path = self.made / name
        text = path.read_text()
        assert old in text
        path.write_text(text.replace(old, new, 1))
        if sealed and name.startswith("claims"):
            self.write(name, json.loads(path.read_text()))

    def write(self, name: str, content: dict) -> None:
        """Write JSON of the run with a checksum of this content."""
        write_json(self.made / name, {key: content[key] for key in content if key != ENTRY})

    def pretend(self, kind: str, package: str) -> None:
        """Make the baseline one that was made with another version of a package."""
        record = load_json(self.accepted / baseline.RECORD)
        record["environment"][kind][package] = "0.0"
        write_json(self.accepted / baseline.RECORD, record)


def seal(path: Path) -> None:
    """Add the checksum that a dataset has in its last line."""
    content = path.read_bytes()
    path.write_bytes(content + MARK + sha256(content).hexdigest().encode() + b"\n")


@pytest.fixture(scope="session")
def accepted_run(tmp_path_factory) -> Run:
    """Return a run and its baseline, not to be changed."""
    folder = tmp_path_factory.mktemp("accepted_run")
    run = Run(made_up.make_run(folder / "results"), folder / "baseline")
    run.accept()
    return run


@pytest.fixture
def run(accepted_run, tmp_path) -> Run:
    """Return a copy of the run and of its baseline, to be changed."""
    return Run(*(shutil.copytree(path, tmp_path / path.name) for path in accepted_run))
