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
from replication.figure_diff import ComparisonResult, FileResult, acceptance, baseline, scatter


class Run(NamedTuple):
    """Folders of the results and of the baseline."""

    made: Path
    accepted: Path

    def judge(self, names=made_up.NAMES, any_bits=False) -> ComparisonResult:
        """Compare these files of the run with the baseline."""
        return baseline.compare(names, *self, made_up.CONFIGURATION, made_up.TRUSTED, any_bits)

    def findings(self, **options) -> dict[str, FileResult]:
        """Compare, and return what was found of each file."""
        return {finding.name: finding for finding in self.judge(**options).findings}

    def anew(self, name: str, known: dict[str, FileResult]) -> list[FileResult]:
        """Judge a file, and those of its figure, where all others are `known`.

        Return what is found of it in the accepted environment, there where any bits will do, and in
        an environment of other versions.
        """
        findings, stem = [], name.rpartition(".")[0]
        for is_accepted_environment in (True, False):
            comparison = baseline.Comparison(
                baseline.recorded(self.accepted), *self, made_up.TRUSTED
            )
            if not is_accepted_environment:
                comparison.same_data = comparison.same_drawing = False
            comparison.found = dict(known)
            for sibling in sorted(known, key=baseline.place):
                if sibling.startswith(f"{stem}."):
                    comparison.look_at(sibling)
            finding = comparison.found[name]
            findings += [comparison.strictly(finding, any_bits) for any_bits in (False, True)]
        return findings[:3]

    def accept(self, names=made_up.NAMES, words=()) -> str:
        """Take the run, or the files that words name, as the baseline; return what is told."""
        return acceptance.accept(names, *self, made_up.CONFIGURATION, words)

    def change(self, name: str, change, fill: dict | None = None) -> None:
        """Write a dataset of the run anew, as `change` returns it, without a check of its form.

        `fill` is the value by which a variable of this name says that it has none.
        """
        changed = change(read(self.made / name))
        for key, variable in changed.variables.items():
            variable.encoding = {"_FillValue": (fill or {}).get(key)}
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
            content = json.loads(path.read_text())
            write_json(path, {key: content[key] for key in content if key != ENTRY})

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
    right_runs = [made_up.make_run(folder / f"right_{seed}", seed) for seed in (2, 3)]
    scatter.write_scatter(run.accepted, right_runs, made_up.TRUSTED)
    return run


@pytest.fixture(scope="session")
def known(accepted_run) -> dict[str, FileResult]:
    """Return what is found of each file of the run."""
    return accepted_run.findings(any_bits=True)


@pytest.fixture(scope="session")
def moved_run(accepted_run, tmp_path_factory) -> Run:
    """Return another right run, not to be changed, in which chaos has other last bits."""
    moved = made_up.make_run(tmp_path_factory.mktemp("moved_run") / "results", seed=1)
    return accepted_run._replace(made=moved)


@pytest.fixture(scope="session")
def known_of_moved(moved_run) -> dict[str, FileResult]:
    """Return what is found of each file of the other run."""
    return moved_run.findings(any_bits=True)


def copy_of(run: Run, folder: Path) -> Run:
    return Run(*(shutil.copytree(path, folder / path.name) for path in run))


@pytest.fixture
def run(accepted_run, tmp_path) -> Run:
    """Return a copy of the run and of its baseline, to be changed."""
    return copy_of(accepted_run, tmp_path)


@pytest.fixture
def moved(moved_run, tmp_path) -> Run:
    """Return a copy of the other right run and of the baseline, to be changed."""
    return copy_of(moved_run, tmp_path / "moved")
