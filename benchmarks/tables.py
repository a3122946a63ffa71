"""The measurements as tables in Markdown, made from the datasets alone."""

import numpy as np
import xarray as xr
from pendula.report.words import markdown

from .cost import TOLERANCE
from .pendula import END_TIME, MU, TARGET
from .problems import REGIMES

RATIOS = ("ratio", "ratio_least", "ratio_most")


def tabulate_work_precision(measured: xr.Dataset) -> list[str]:
    """Return the parts of a page; every time in it stands beside the error that was measured."""
    targets = ", ".join(
        f"{regime.target:.0e} at tau = {regime.horizon:g} ({name})"
        for name, regime in REGIMES.items()
    )
    about = f"Errors are against the multiprecision reference. Compared at an error of {targets}"
    return _pages("# Speed against error", about, measured)


def tabulate_pendula(measured: xr.Dataset) -> list[str]:
    """Return the parts of a page on Newton's equations."""
    about = f"Compared at an error of {TARGET:.0e} rad, mu = {MU:g}, tau = {END_TIME:g}"
    return _pages("# Speed against error on the pendula", about, measured)


def _pages(title: str, about: str, measured: xr.Dataset) -> list[str]:
    told = measured.attrs
    absent = [name for name in told.get("absent", "").split("; ") if name]
    code_for = f", with code for the processor {told['code_for']}" if "code_for" in told else ""
    return [
        title,
        f"Measured on {told.get('processor', 'a processor without a name')}{code_for}. One core, "
        "after warm-up, runs without outputs. Errors are those of the largest component. "
        f"{about}; ratios are medians of runs in turns, with the least and the largest.",
        *([_peers(measured)] if "peer" in measured.dims else []),
        *(f"Not measured: {name}." for name in absent),
        _points(measured),
    ]


def _peers(measured: xr.Dataset) -> str:
    """Return the table of the peers' times over those of our fastest solver at equal error."""
    cases, titles = list(measured["case"].values), measured["title"].to_series()
    rows = []
    for name in measured["peer"].values:
        peer = measured.sel(peer=name)
        told = [[f"{float(peer[ratio].sel(case=case)):.3g}" for ratio in RATIOS] for case in cases]
        cells = ["not reached" if mid == "nan" else f"{mid} ({low} to {high})"
                 for mid, low, high in told]  # fmt: skip
        mean = f"{float(np.exp(np.log(peer['ratio']).mean())):.3g}"
        rows.append([titles[name], *cells, "-" if mean == "nan" else mean])
    return markdown(["peer", *cases, "geometric mean"], rows)


def _points(measured: xr.Dataset) -> str:
    """Return the table of all points of all contestants."""
    rows = [
        [str(case), str(one["title"].item()), *(f"{float(one[key][k]):.2g}" for key in POINT)]
        for case in measured["case"].values
        for name in measured["contestant"].values
        for one in [measured.sel(case=case, contestant=name)]
        for k in np.flatnonzero(np.isfinite(one["error"]))
    ]
    return markdown(["case", "solver", "tolerance or step", "seconds", "error"], rows)


POINT = ("accuracy", "seconds", "error")


def tabulate_cost(cost: xr.Dataset) -> list[str]:
    """Return the parts of a page on how the cost grows with the chain."""
    seconds = cost["seconds"].transpose("sites", "solver")
    pairs = zip(seconds["sites"].values, 1e6 * seconds.values, strict=True)
    rows = [[f"{sites:g}", *(f"{value:.3g}" for value in row)] for sites, row in pairs]
    return [
        "# How the cost grows",
        f"Time in µs per site and unit of slow time: tolerance {TOLERANCE:.0e}, from symmetric "
        "noise on all sites, one core, medians.",
        markdown([cost["sites"].long_name, *seconds["solver"].values], rows),
    ]
