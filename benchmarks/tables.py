"""The measurements as tables in Markdown, made from the datasets alone."""

import numpy as np
import xarray as xr
from pendula.report.words import markdown

from .cost import TOLERANCE
from .pendula import END_TIME, MU, TARGET
from .problems import REGIMES

POINT = ("accuracy", "seconds", "error")
COMPARED = 1001, 100_001
"""Numbers of sites whose costs are compared in the last row of their table."""


def tabulate_work_precision(measured: xr.Dataset) -> list[str]:
    """Return the parts of a page; every time in it stands beside the error that was measured."""
    parts = ["# Speed against error", _explain(measured)]
    if "peer" in measured.dims:
        parts += ["## Times of the peers over that of the fastest solver here, at equal error"]
        parts += [_peers(measured)]
    absent = measured.attrs.get("absent", "").split("; ")
    parts += [f"Not measured: {name}." for name in absent if name]
    for case in measured["case"].values:
        parts += [f"## {case}", _solvers(measured.sel(case=case))]
    return parts


def _explain(measured: xr.Dataset) -> str:
    targets = ", ".join(
        f"{regime.target:.0e} at tau = {regime.horizon:g} ({name})"
        for name, regime in REGIMES.items()
    )
    return (
        f"Measured on {measured.attrs.get('processor', 'a processor without a name')}"
        f"{_code_for(measured)}. One core, "
        "after warm-up, runs without outputs. Errors are those of the largest component against "
        f"the multiprecision reference. Compared at an error of {targets}; ratios are medians of "
        "runs in turns, with the least and the largest."
    )


def _code_for(measured: xr.Dataset) -> str:
    name = measured.attrs.get("code_for")
    return f", with code for the processor {name}" if name else ""


def _peers(measured: xr.Dataset) -> str:
    cases = list(measured["case"].values)
    titles = dict(zip(measured["contestant"].values, measured["title"].values, strict=True))
    rows = []
    for peer in measured["peer"].values:
        own = measured.sel(peer=peer)
        cells = [_ratio(own.sel(case=case)) for case in cases]
        rows.append([titles[peer], *cells, _mean(own)])
    return markdown(["peer", *cases, "geometric mean"], rows)


def _mean(peer: xr.Dataset) -> str:
    mean, count = float(peer["mean_ratio"]), int(peer["reached_cases"])
    return f"{mean:.3g} ({count} cases)" if count else "-"


def _ratio(pair: xr.Dataset) -> str:
    if not np.isfinite(pair["ratio"]):
        return "not reached"
    scatter = f"{float(pair['ratio_least']):.3g} to {float(pair['ratio_most']):.3g}"
    errors = f"{float(pair['peer_error']):.0e} / {float(pair['our_error']):.0e}"
    return f"{float(pair['ratio']):.3g} ({scatter}; errors {errors}, {pair['our_best'].item()})"


def _solvers(case: xr.Dataset) -> str:
    head = ["solver", "accuracy", "time, ms", "error", "error of the norms", "energy drift"]
    rows = []
    for solver in case["solver"].values:
        own = case.sel(contestant=solver, solver=solver)
        points = (own.isel(point=i) for i in range(case.sizes["point"]))
        rows += [_point(solver, point) for point in points if np.isfinite(point["seconds"])]
    return markdown([*head, "steps", "evaluations"], rows)


def _point(solver: str, point: xr.Dataset) -> list[str]:
    accuracy, time = f"{float(point['accuracy']):.1e}", f"{1e3 * float(point['seconds']):.3g}"
    small = [f"{float(point[name]):.1e}" for name in ("error", "norm_error", "energy_drift")]
    work = [f"{int(point[name])}" for name in ("steps", "evaluations")]
    return [solver, accuracy, time, *small, *work]


def tabulate_cost(cost: xr.Dataset) -> list[str]:
    """Return the parts of a page on how the cost grows: with chain, time and active sites."""
    title, said = "## Time a site and unit of slow time, in µs, over the ", "one core, medians."
    noise = f"Tolerance {TOLERANCE:.0e}, even noise on all sites, {said}"
    parts = ["# How cost grows"]
    parts += [f"{title}{cost['sites'].long_name}", noise, _over_sites(cost["seconds"])]
    one_case = f"Tolerance {TOLERANCE:.0e}, one case, {said}"
    over_time = _over(cost["long_seconds"], "end_time")
    parts += [f"{title}{cost['end_time'].long_name}", one_case, over_time]
    if "by_hand" in cost and cost["by_hand_ratio"].notnull().any():
        parts += ["## The method of taylor in C++, in times of taylor", _over_by_hand(cost)]
    if "active_width" in cost:
        parts += ["## A chain without ends", _over_active_sites(cost)]
    return parts


def _over_sites(seconds: xr.DataArray) -> str:
    if not set(COMPARED) <= set(seconds["sites"].values):
        return _over(seconds, "sites")
    short, long = (seconds.sel(sites=sites) for sites in COMPARED)
    ratios = [f"{float(ratio):.3g}" for ratio in (long / short).values]
    return _over(seconds, "sites", [f"{COMPARED[1]} over {COMPARED[0]}", *ratios])


def _over(seconds: xr.DataArray, dim: str, *last: list[str]) -> str:
    """Return the table of costs along a dimension, a column a solver, with rows to end it."""
    rows = [
        [f"{value:g}", *(f"{1e6 * cost:.3g}" for cost in seconds.sel({dim: value}).values)]
        for value in seconds[dim].values
    ]
    return markdown([seconds[dim].long_name, *seconds["solver"].values], [*rows, *last])


def _over_by_hand(cost: xr.Dataset) -> str:
    ratios = cost["by_hand_ratio"].dropna("by_hand")
    head = [ratios["end_time"].long_name, *ratios["by_hand"].values]
    rows = [
        [f"{end:g}", *(f"{ratio:.3g}" for ratio in ratios.sel(end_time=end).values)]
        for end in ratios["end_time"].values
    ]
    return markdown(head, rows)


def _over_active_sites(cost: xr.Dataset) -> str:
    head = ["active sites 2W + 1", "µs a site 0..W and unit of slow time"]
    head += ["right-hand sides a unit of slow time", "ns a site and right-hand side"]
    head += ["bytes a site 0..W"]
    names = ("active_width", "active_seconds", "active_evaluations", "active_memory")
    columns = (cost[name].values for name in names)
    return markdown(head, [_active_row(*values) for values in zip(*columns, strict=True)])


def _active_row(width: int, seconds: float, evaluations: float, memory: float) -> list[str]:
    each = f"{1e9 * seconds / evaluations:.3g}"
    return [
        *(f"{2 * int(width) + 1:,}", f"{1e6 * seconds:.3g}", f"{evaluations:.0f}"),
        *(each, f"{memory:.0f}"),
    ]


def tabulate_pendula(measured: xr.Dataset) -> list[str]:
    """Return the parts of a page: ratios of the peers, and every point of every contestant."""
    titles = dict(zip(measured["contestant"].values, measured["title"].values, strict=True))
    cases = list(measured["case"].values)
    rows = [
        [titles[peer], *(f"{float(value):.3g}" for value in measured["ratio"].sel(peer=peer))]
        for peer in measured["peer"].values
    ]
    points = [
        [case, titles[name], *(f"{float(one.isel(point=k)[key]):.2g}" for key in POINT)]
        for case in cases
        for name in measured["contestant"].values
        for one in [measured.sel(case=case, contestant=name)]
        for k in np.flatnonzero(np.isfinite(one["error"]))
    ]
    return [
        "# Speed against error on the pendula",
        "Times of the peers over that of the fastest solver here, at an error of "
        f"{TARGET:.0e} rad, mu = {MU:g}, tau = {END_TIME:g}.",
        markdown(["peer", *cases], rows),
        markdown(["case", "solver", "tolerance or step", "seconds", "error"], points),
    ]
