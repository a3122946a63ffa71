"""The measurements in words: who needs how many times as long at the same error."""

import numpy as np
import xarray as xr

from .regimes import REGIMES


def write_tables(measured: xr.Dataset) -> str:
    """Return a page of Markdown; every time in it stands beside the error that was measured."""
    lines = ["# Speed against error", "", _explain(measured), ""]
    if "peer" in measured.dims:
        lines += [*_peers(measured), ""]
    for absent in measured.attrs.get("absent", "").split("; "):
        if absent:
            lines += [f"Not measured: {absent}.", ""]
    for case in measured["case"].values:
        lines += [f"## {case}", "", *_solvers(measured.sel(case=case)), ""]
    return "\n".join(lines)


def _explain(measured: xr.Dataset) -> str:
    targets = ", ".join(
        f"{regime.target:.0e} at tau = {regime.horizon:g} ({name})"
        for name, regime in REGIMES.items()
    )
    return (
        "One core, after warm-up, runs without outputs. Errors are those of the largest component "
        f"against the multiprecision reference. Compared at an error of {targets}; ratios are "
        "medians of runs in turns, with the least and the largest."
    )


def _peers(measured: xr.Dataset) -> list[str]:
    cases = list(measured["case"].values)
    lines = [
        "## Times of the peers over that of the fastest solver here, at equal error",
        "",
        f"| peer | {' | '.join(cases)} | geometric mean |",
        f"| --- |{' --- |' * (len(cases) + 1)}",
    ]
    titles = measured["title"].to_series()
    for peer in measured["peer"].values:
        row = measured.sel(peer=peer)
        cells = [_ratio(row.sel(case=case)) for case in cases]
        known = row["ratio"].values[np.isfinite(row["ratio"].values)]
        mean = f"{np.exp(np.mean(np.log(known))):.3g} ({len(known)} cases)" if len(known) else "-"
        lines.append(f"| {titles[peer]} | {' | '.join(cells)} | {mean} |")
    return lines


def _ratio(pair: xr.Dataset) -> str:
    if not np.isfinite(pair["ratio"]):
        return "not reached"
    spread = f"{float(pair['ratio_least']):.3g} to {float(pair['ratio_most']):.3g}"
    errors = f"{float(pair['peer_error']):.0e} / {float(pair['our_error']):.0e}"
    return f"{float(pair['ratio']):.3g} ({spread}; errors {errors}, {pair['our_best'].item()})"


def _solvers(case: xr.Dataset) -> list[str]:
    lines = [
        "| solver | accuracy | time, ms | error | error of the norms | energy drift | "
        "steps | evaluations |",
        "| --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    for solver in case["solver"].values:
        own = case.sel(contestant=solver, solver=solver)
        for rung in range(case.sizes["rung"]):
            row = own.isel(rung=rung)
            if np.isfinite(row["seconds"]):
                lines.append(_solver_row(solver, row))
    return lines


def _solver_row(solver: str, row: xr.Dataset) -> str:
    time = f"{1e3 * float(row['seconds']):.3g}"
    small = [f"{float(row[name]):.1e}" for name in ("error", "norm_error", "energy_drift")]
    work = [f"{int(row[name])}" for name in ("steps", "evaluations")]
    return f"| {solver} | {float(row['accuracy']):.1e} | {' | '.join([time, *small, *work])} |"
