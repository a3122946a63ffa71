"""Scatter: the size of the differences of chaotic numbers between correct runs.

Each row of a variable (see `values`) has a mean difference and a mean size. The scatter of the
variable is the largest ratio of the two. `write_scatter` measures and stores it in the baseline.
"""

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
import xarray as xr
from latticode.datasets.json_files import load_json, write_json
from latticode.datasets.netcdf import DatasetError, read

from . import values
from .chaos import Chaos, Trust, known_chaos

SCATTER, RECORD = "scatter.json", "hashes.json"
DIGITS = 3
"""Significant digits of the stored scatter."""


def known_scatter(folder: Path) -> dict[str, float]:
    """Return the recorded scatter by dataset:variable, empty if there is no record.

    A damaged record is ignored. Without a record the limits are wider.
    """
    try:
        return load_json(folder / SCATTER)["scatter"]
    except (DatasetError, OSError):
        return {}


def measure(folder: Path, runs: Sequence[Path], trust: Trust | None) -> dict[str, float]:
    """Return the scatter by dataset:variable of correct `runs` around the baseline in `folder`."""
    record = load_json(folder / RECORD)
    chaos, scatter = known_chaos(folder, record["configuration"], trust), {}
    for name in (name for name in record["files"] if name.endswith(".nc")):
        was, correct_runs = read(folder / name), [read(run / name) for run in runs]
        for key in map(str, was.variables):
            differences = [
                difference
                for now in correct_runs
                for difference in _relative_differences(name, key, was, now, chaos)
            ]
            if differences:
                scatter[f"{name.removesuffix('.nc')}:{key}"] = float(
                    f"{max(differences):.{DIGITS}g}"
                )
    return scatter


def _relative_differences(
    name: str, key: str, was: xr.Dataset, now: xr.Dataset, chaos: Chaos
) -> Iterator[float]:
    """Yield, for each chaotic row of a variable, its mean difference over its mean size."""
    if was[key].dtype.kind not in "fi" or values.is_statistic(was.variables[key]):
        return
    rests = chaos.freedom(name, key, was) > 0.0
    old, new = (each[key].values.astype(float) for each in (was, now))
    known = rests & np.isfinite(old) & np.isfinite(new)
    for row in values.rows(was.variables[key], was):
        before, after = (np.atleast_1d(each[row])[np.atleast_1d(known[row])] for each in (old, new))
        if size := float(abs(before).mean()) if before.size else 0.0:
            yield float(abs(after - before).mean()) / size


def write_scatter(baseline: Path, runs: Sequence[Path], trust: Trust | None) -> None:
    """Measure the scatter on the results of correct runs, and write it into the baseline."""
    write_json(baseline / SCATTER, {"scatter": measure(baseline, runs, trust)})
