"""The sections of the report that belong to no study: speed against error, and how it was run.

Speed is read from the dataset that `snakemake speed` makes. How the run was made is told by
versions, processor, hashes of what went in, and times of the rules.
"""

import hashlib
import platform
import re
from collections.abc import Mapping
from importlib.metadata import version
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from llvmlite import binding

from pendula.datasets.registry import SOLVER_NAMES
from pendula.sources import TOOK, describe_machine

from .page import picture
from .results import Figure, ReportError, Results, Table
from .words import case_of, number, told


class Measured(NamedTuple):
    """Where the measurements are, as links of the page; `fresh` if this machine made them."""

    data: str
    table: str
    pictures: list[str]
    fresh: bool


def gather_speed(results: Results, measured: Measured) -> dict[str, Any]:
    """Return our solvers' least times at the required error, and the peers' times over ours."""
    source = measured.data.removesuffix(".nc")
    data = results[source]
    if "best_seconds" not in data:
        raise ReportError(f"{measured.data} holds no times of solvers: run `snakemake speed`")
    best = 1e3 * data["best_seconds"].dropna("solver", how="all").dropna("case", how="all")
    winners = [str(name) for name in best.idxmin("solver").values]
    fastest = max(dict.fromkeys(winners), key=winners.count)
    caption = told(
        "Time against error above; below, the time of other solvers over that of the fastest "
        "solver here, at equal error."
    )
    return {
        "fastest": told(
            "{solver} is the fastest solver here in {wins} of {cases} cases.",
            solver=SOLVER_NAMES[fastest],
            wins=results.quote(source, winners.count(fastest)),
            cases=results.quote(source, len(winners)),
        ),
        "least": Table(
            "Least time in ms at the required error, "
            + ("measured by snakemake speed" if measured.fresh else "as measured and kept by "
               "the project; snakemake speed measures it on your machine"),
            ["case", "error", *(SOLVER_NAMES[str(name)] for name in best["solver"].values)],
            [_row(results, source, best.sel(case=case)) for case in best["case"].values],
        ),
        "peers": Table(
            "Times of other solvers over that of the fastest here, at equal error",
            ["solver", "geometric mean", "cases"], _peers(results, source),
        ),
        **{
            link: Figure(picture(results.path(link), f"Time against error: {link}", link), caption)
            for link in measured.pictures
        },
    }  # fmt: skip


def _peers(results: Results, source: str) -> list[list]:
    """Return the mean ratio of each peer, and in how many cases it reached the error."""
    data = results[source]
    titles = dict(zip(data["contestant"].values, data["title"].values, strict=True))
    own = [data.sel(peer=peer) for peer in data["peer"].values] if "peer" in data.dims else []
    return [
        [str(titles[str(one["peer"].values)]), results.quote(source, float(one["mean_ratio"])),
         results.quote(source, int(one["reached_cases"]))]
        for one in sorted(own, key=lambda one: not one["reached_cases"])
    ]  # fmt: skip


def _row(results: Results, source: str, times: xr.DataArray) -> list:
    cells = [
        results.quote(source, time) if np.isfinite(time) else "not reached" for time in times.values
    ]
    case = str(times["case"].values)
    target = float(results[source]["target"].sel(case=case))
    return [case_of(results[source].sel(case=case)), number(target), *cells]


# --- How the report was run -----------------------------------------------------------------------

PACKAGES = ("snakemake", "xarray", "netCDF4", "matplotlib", "pydantic", "Jinja2", "pillow")
VECTORS = ("sse", "avx", "fma", "neon", "sve")
SHOWN = 16
"""Digits of a hash that the page shows."""


def gather_provenance(
    made_by: Mapping[str, str], references: list[str], settings: str, logs: Path
) -> dict[str, Any]:
    """Return what a reader needs to repeat the run.

    `made_by` has the hash of each function that jobs called, with all that it rests on. The
    `references` are files, `settings` is the configuration as text. Logs lie below the folder
    `logs`. Only `times` differ between two runs.
    """
    times = run_times(logs)
    files = {f"reference {Path(path).stem}": Path(path).read_bytes() for path in references}
    features = binding.get_host_cpu_features()  # the instructions that compiled kernels can use
    found = (name for name, there in features.items() if there and name.startswith(VECTORS))
    machine = {"system": platform.system(), "vector instructions": ", ".join(sorted(found))}
    hashes = {
        "configuration of the paper's cases and sweeps": _digest(settings.encode()),
        **{name: digest[:SHOWN] for name, digest in sorted(made_by.items())},
        **{name: _digest(content) for name, content in files.items()},
    }
    total = sum(seconds for _, seconds, _ in times)
    return {
        "versions": Table("Processor and versions", ("what", "which"),
                          [*(versions() | machine).items()]),
        "hashes": Table(
            "Beginnings of SHA-256: functions that jobs called, with all that they rest on, and "
            "references", ("what", "hash"), [*hashes.items()], folded=True,
        ),
        "times": Table(
            f"Wall times and largest memory of the jobs: {total:.0f} s in all, start-up included; "
            "several ran side by side", ("job", "s", "MB"),
            [(name, f"{seconds:.1f}", memory) for name, seconds, memory in times], folded=True,
        ),
    }  # fmt: skip


def versions() -> dict[str, str]:
    """Return the processor and the versions of the packages that the numbers pass through."""
    return describe_machine() | {name: version(name) for name in PACKAGES}


def run_times(logs: Path) -> list[tuple[str, float, str]]:
    """Return the wall time in s and the memory in MB of each job with a log, the longest first."""
    found = []
    for log in sorted(logs.rglob("*.log")):
        last = log.read_text(encoding="utf-8", errors="replace").rstrip().rpartition("\n")[2]
        if took := re.match(rf"{TOOK}([\d.]+) s, largest memory: (\d+) MB", last):
            name = log.relative_to(logs).with_suffix("").as_posix()
            found.append((name, float(took[1]), took[2]))
    return sorted(found, key=lambda job: (-job[1], job[0]))


def _digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()[:SHOWN]
