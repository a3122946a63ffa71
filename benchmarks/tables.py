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


def titles_of(measured: xr.Dataset) -> dict[str, str]:
    return dict(zip(measured["contestant"].values, measured["title"].values, strict=True))


def tabulate_work_precision(measured: xr.Dataset) -> list[str]:
    """Return the parts of a page; every time in it stands beside the error that was measured."""
    targets = ", ".join(
        f"{regime.target:.0e} at tau = {regime.horizon:g} ({name})"
        for name, regime in REGIMES.items()
    )
    code_for = measured.attrs.get("code_for")
    parts = [
        "# Speed against error",
        f"Measured on {measured.attrs.get('processor', 'a processor without a name')}"
        f"{f', with code for the processor {code_for}' if code_for else ''}. One core, "
        "after warm-up, runs without outputs. Errors are those of the largest component against "
        f"the multiprecision reference. Compared at an error of {targets}; ratios are medians of "
        "runs in turns, with the least and the largest.",
    ]
    if "peer" in measured.dims:
        parts += ["## Times of the peers over that of the fastest solver here, at equal error"]
        parts += [_peers(measured)]
    absent = measured.attrs.get("absent", "").split("; ")
    parts += [f"Not measured: {name}." for name in absent if name]
    for case in measured["case"].values:
        parts += [f"## {case}", _solvers(measured.sel(case=case))]
    return parts


def _peers(measured: xr.Dataset) -> str:
    cases, titles, rows = list(measured["case"].values), titles_of(measured), []
    for peer in measured["peer"].values:
        own = measured.sel(peer=peer)
        mean, count = float(own["mean_ratio"]), int(own["reached_cases"])
        last = f"{mean:.3g} ({count} cases)" if count else "-"
        rows.append([titles[peer], *(_ratio(own.sel(case=case)) for case in cases), last])
    return markdown(["peer", *cases, "geometric mean"], rows)


def _ratio(pair: xr.Dataset) -> str:
    if not np.isfinite(pair["ratio"]):
        return "not reached"
    scatter = f"{float(pair['ratio_least']):.3g} to {float(pair['ratio_most']):.3g}"
    errors = f"{float(pair['peer_error']):.0e} / {float(pair['our_error']):.0e}"
    return f"{float(pair['ratio']):.3g} ({scatter}; errors {errors}, {pair['our_best'].item()})"


def _solvers(case: xr.Dataset) -> str:
    columns = {
        "accuracy": "{:.1e}",
        "seconds": "{:.3g}",
        "error": "{:.1e}",
        "norm_error": "{:.1e}",
        "energy_drift": "{:.1e}",
        "steps": "{:.0f}",
        "evaluations": "{:.0f}",
    }
    rows = []
    for solver in case["solver"].values:
        own = case.sel(contestant=solver, solver=solver)
        own = own.assign(seconds=1e3 * own["seconds"])
        for k in np.flatnonzero(np.isfinite(own["seconds"])):
            point = own.isel(point=k)
            cells = [form.format(float(point[name])) for name, form in columns.items()]
            rows.append([solver, *cells])
    head = ["solver", "accuracy", "time, ms", "error", "error of the norms", "energy drift"]
    return markdown([*head, "steps", "evaluations"], rows)


def tabulate_cost(cost: xr.Dataset) -> list[str]:
    """Return the parts of a page on how the cost grows: with chain, time and active sites."""
    title, said = "## Time per site and unit of slow time, in µs, over the ", "one core, medians."
    short, long = (cost["seconds"].sel(sites=sites).values for sites in COMPARED)
    ratios = [f"{ratio:.3g}" for ratio in long / short]
    last = [f"{COMPARED[1]} over {COMPARED[0]}", *ratios]
    parts = [
        "# How the cost grows",
        f"{title}{cost['sites'].long_name}",
        f"Tolerance {TOLERANCE:.0e}, from symmetric noise on all sites, {said}",
        _over(1e6 * cost["seconds"], cost["sites"], last),
        f"{title}{cost['end_time'].long_name}",
        f"Tolerance {TOLERANCE:.0e}, one case, {said}",
        _over(1e6 * cost["long_seconds"], cost["end_time"]),
    ]
    by_hand = cost["by_hand_ratio"].dropna("by_hand")
    if by_hand.size:
        parts += ["## Time of the Taylor method in C++, over that of taylor"]
        parts += [_over(by_hand, cost["end_time"])]
    return [*parts, "## The infinite chain", _over_active_sites(cost)]


def _over(values: xr.DataArray, along: xr.DataArray, *last: list[str]) -> str:
    """Return the table of values along a coordinate, with rows to end it."""
    rows = [
        [f"{place:g}", *(f"{value:.3g}" for value in row)]
        for place, row in zip(along.values, values.values, strict=True)
    ]
    names = values[values.dims[1]].values
    return markdown([along.long_name, *names], [*rows, *last])


def _over_active_sites(cost: xr.Dataset) -> str:
    head = ["active sites 2W + 1", "µs per site 0..W and unit of slow time"]
    head += ["right-hand sides per unit of slow time", "ns per site and right-hand side"]
    head += ["bytes per site 0..W"]
    names = ("active_width", "active_seconds", "active_evaluations", "active_memory")
    rows = [
        [
            f"{2 * int(width) + 1:,}",
            f"{1e6 * seconds:.3g}",
            f"{evaluations:.0f}",
            f"{1e9 * seconds / evaluations:.3g}",
            f"{memory:.0f}",
        ]
        for width, seconds, evaluations, memory in zip(
            *(cost[n].values for n in names), strict=True
        )
    ]
    return markdown(head, rows)


def tabulate_pendula(measured: xr.Dataset) -> list[str]:
    """Return the parts of a page: ratios of the peers, and every point of every contestant."""
    titles, cases = titles_of(measured), list(measured["case"].values)
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
