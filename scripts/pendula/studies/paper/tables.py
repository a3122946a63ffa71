"""The paper's solvers in numbers: energy, agreement with each other and with the references.

Two pages of tables.
"""

import math
from itertools import product

import xarray

from pendula.datasets.netcdf import read
from pendula.report.words import horizons_in_words, markdown, write_markdown


def tabulate_solvers(solvers: str, trust: str, table: str, trust_table: str) -> None:
    """Write one page of tables on each dataset."""
    compared = read(solvers)
    parts = [energy_part(compared), agreement_part(compared), sweep_part(compared)]
    title = "# The two solvers of the paper"
    write_markdown(table, title, *(text for part in parts for text in part))
    write_markdown(trust_table, *trust_part(read(trust)))


def energy_part(data: xarray.Dataset) -> list[str]:
    """Return the largest drift early and by the end, beside the order that the paper states."""
    ends = [[f"{float(until):g}" for until in sorted(set(one.values))] for one in data["until"].T]
    early, end = (" or ".join(each) for each in ends)
    words = (
        f"Largest drift of H by tau = {early} / by tau = {end}, beside the order that the paper "
        "states. Kept is a drift of at most twice that order."
    )
    rows = []
    for name in data["case"].values:
        case = data.sel(case=name)
        drifts = [
            " / ".join(f"{drift:.1e}" for drift in one.values)
            for one in case["largest_drift"].transpose("solver", "span")
        ]
        stated, claimed = "none: another case", "no claim"
        if not math.isnan(case["stated_drift"]):
            kept = zip(("early", "to the end"), case["kept"].sel(solver="ode45"), strict=True)
            claimed = ", ".join(word if holds else f"not {word}" for word, holds in kept)
            stated = f"{float(case['stated_drift']):.0e}"
        rows.append((name, stated, *drifts, claimed))
    head = ("case", "paper", *data["solver"].values, "ode45 as claimed")
    return ["## Conservation of the energy", words, markdown(head, rows)]


def agreement_part(data: xarray.Dataset) -> list[str]:
    """Return the divergence time of each pair of solvers in each case."""
    words = (
        f"The first tau at which the norms of two solvers differ by {float(data['visible']):.0%} "
        "of full scale, and the largest difference. Once a pair has diverged in a chaotic case, "
        "it stays so: the curves are then two different solutions of the same kind."
    )
    rows = []
    for name in data["case"].values:
        case = data.sel(case=name)
        pairs = zip(case["divergence_time"].values, case["largest_difference"].values, strict=True)
        told = [
            f"{'never' if time == math.inf else f'{time:.1f}'} ({largest:.0e})"
            for time, largest in pairs
        ]
        rows.append((name, *told))
    head = ("case", *data["pair"].values)
    return ["## Agreement of the trajectories", words, markdown(head, rows)]


def sweep_part(data: xarray.Dataset) -> list[str]:
    """Return how far the swept l2 norms of the pair differ between the paper's two solvers."""
    words = (
        "Largest and median difference of the pair's l2 norm between the two solvers over all "
        "half-widths, relative to the first solver's value. Points of a chaotic sweep differ by "
        "chance: the ledger holds them to the ensemble."
    )
    rows = []
    for sweep, window in product(data["sweep"].values, data["window"].values):
        cells = []
        for statistic in ("max", "mean"):
            found = data.sel(sweep=sweep, window=window, statistic=statistic)
            values = [float(found[f"{name}_sweep_difference"]) for name in ("largest", "median")]
            told = " / ".join(f"{value:.1e}" for value in values)
            cells.append("not swept" if any(map(math.isnan, values)) else told)
        rows.append((sweep, window, *cells))
    head = ("sweep", "window", "maximum: largest / median", "mean: largest / median")
    return ["## Agreement of the sweeps", words, markdown(head, rows)]


def trust_part(data: xarray.Dataset) -> list[str]:
    """Return until when each solver can be trusted: a row a solver, a column a level."""
    words = (
        "The first tau at which a norm is off by a part of its full scale (0.67 % is the width of "
        "a line in Figs 2 to 4), against the multiprecision references."
    )
    if (data["known_until"] < data["run_end"]).any():
        words += " Where a reference ends before the run, nothing is known of the time after it."
    rows = [
        (case, solver, *horizons_in_words(data.sel(case=case, solver=solver), 4))
        for case in data["case"].values
        for solver in data["solver"].values
    ]
    head = ("case", "solver", *(f"off by {float(size):.2%}" for size in data["size"]))
    return ["# Until when the solvers can be trusted", words, markdown(head, rows)]
