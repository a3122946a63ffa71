"""A run and the baseline that was accepted from it, to plant faults into."""

import json
import shutil
from pathlib import Path
from typing import NamedTuple

import made_up_results as made_up
import pytest
from pendula.datasets.netcdf import read
from pendula.figure_diff import Finding, Verdict, acceptance, baseline, tolerances
from pendula.figure_diff.compare_curves import Curve, curves

from benchmarks import spreads

TABLE = Path(__file__).resolve().parents[1] / "baseline" / tolerances.TOLERANCES


class Run(NamedTuple):
    """Folders of the results and of the baseline."""

    made: Path
    accepted: Path

    def judge(self, names=made_up.NAMES, any_bits=False) -> Verdict:
        """Compare these files of the run with the baseline."""
        return baseline.compare(names, *self, made_up.CONFIGURATION, any_bits)

    def compare(self, names) -> list[Finding]:
        """Compare these files with the baseline, and let the allowances decide on other bits."""
        return self.judge(names, any_bits=True).findings

    def accept(self, names=made_up.NAMES, chosen=None) -> list[str]:
        """Take the run, or the chosen files of it, as the baseline; return what that changed."""
        planned = acceptance.plan(names, *self, made_up.CONFIGURATION, chosen)
        acceptance.take(planned, *self)
        return planned.lines

    def change(self, name: str, change) -> None:
        """Write a dataset of the run anew, as `change` returns it, without a check of its form."""
        changed = change(read(self.made / name))
        for variable in changed.variables.values():
            variable.encoding = {"_FillValue": None}
        changed.to_netcdf(self.made / name, engine="netcdf4", format="NETCDF4")

    def findings(self, names=made_up.NAMES) -> dict[str, Finding]:
        """Compare, and return what was found of each file."""
        return {finding.name: finding for finding in self.compare(names)}

    def faults(self, names=made_up.NAMES) -> list[str]:
        """Compare, and return the lines of the faults."""
        return [each.line for each in self.compare(names) if each.is_fault]

    def move_to_another_environment(self) -> None:
        """Make the baseline one that another matplotlib has drawn."""
        path = self.accepted / baseline.RECORD
        record = json.loads(path.read_text())
        record["environment"]["matplotlib"] = "1.0"
        path.write_text(json.dumps(record))


@pytest.fixture(scope="session")
def kept_curves() -> list[Curve]:
    """Return every curve of the datasets that are kept as accepted, which takes seconds to read."""
    return [
        curve
        for name in baseline.recorded(TABLE.parent)["files"]
        if name.endswith(".nc") and baseline.is_kept(name)
        for curve in curves(read(TABLE.parent / name), name.removesuffix(".nc"))
    ]


@pytest.fixture(scope="session")
def ensemble(tmp_path_factory) -> list[spreads.Measured]:
    """Return what ten made-up runs say about the chaotic curves."""
    folder = tmp_path_factory.mktemp("ensemble")
    members = [made_up.make_chaos(folder / str(seed), seed) for seed in range(10)]
    rules = tolerances.read_rules(TABLE.parent)
    return spreads.measure(members, made_up.CHAOTIC_DATASETS, rules)


@pytest.fixture(scope="session")
def accepted_run(tmp_path_factory, ensemble) -> Run:
    folder = tmp_path_factory.mktemp("figure_diff")
    run = Run(made_up.make_run(folder / "results"), folder / "baseline")
    run.accepted.mkdir()
    shutil.copy(TABLE, run.accepted)
    excess = spreads.accusations(ensemble)
    spreads.write(run.accepted / tolerances.SPREADS, ensemble, excess)
    run.accept()
    return run


@pytest.fixture
def run(accepted_run, tmp_path) -> Run:
    """Return a copy of the run and of its baseline, to be changed."""
    copies = (shutil.copytree(path, tmp_path / path.name) for path in accepted_run)
    return Run(*copies)


@pytest.fixture(params=["same environment", "other environment"])
def any_environment(request, run) -> Run:
    """Return the run, compared by pixels and by look."""
    if request.param == "other environment":
        run.move_to_another_environment()
    return run
