"""Seeded ensembles: a case from data that differ in their last digits, as many times as wanted.

Where the motion is chaotic one run is one draw; what a second solver, or another computer, would
draw as well is the distribution.
"""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
import xarray as xr

from pendula.datasets.checks import describe
from pendula.datasets.netcdf import Variable
from pendula.datasets.registry import NAMES
from pendula.datasets.trajectories import Contents, describe_cases
from pendula.measures.difference import is_of_same_case
from pendula.measures.levels import bands, moments
from pendula.problem import Problem, by_name, name_window
from pendula.simulation.ensembles import draw_members
from pendula.simulation.simulate import simulate
from pendula.simulation.sweep import QUANTITIES, STATISTICS, pair_l2, pair_linf, sweep

NORMS = ("l2", "linf")
QUANTILES = (0.05, 0.25, 0.5, 0.75, 0.95)
TITLE = "Ensembles of the chaotic cases and sweeps, from almost equal data"


def run_members(
    problem: Problem, size: float, members: int, seed: int = 0, kind: str = "even"
) -> tuple[np.ndarray, np.ndarray]:
    """Return the norms l2 and l-infinity of each member, both (member, quantity, time)."""
    runs = [
        simulate(member, energy=False)
        for member in draw_members(problem, size, members, seed, kind)
    ]
    return np.array([pair_l2(run) for run in runs]), np.array([pair_linf(run) for run in runs])


def sweep_members(
    problem: Problem, half_widths, windows, size: float, members: int, seed: int = 0, kind="even"
) -> tuple[np.ndarray, np.ndarray]:
    """Return the swept l2 and l-infinity of each member, both (member, *shape of a Sweep).

    Each half-width has draws of its own. The same data would give the same motion on all chains
    that are too long for the front, so that their means would not be independent of each other.
    """
    columns = []
    for half_width in half_widths:
        drawn = draw_members(problem, size, members, [seed, half_width], kind)
        columns.append([sweep(member, [half_width], windows) for member in drawn])
    l2, linf = (
        np.concatenate([[getattr(one, norm) for one in column] for column in columns], axis=1)
        for norm in NORMS
    )
    return l2, linf


MOMENTS = {
    "mean": "ensemble mean",
    "deviation": "standard deviation over the ensemble",
    "error": "standard error of the ensemble mean",
}


def case_bands(
    problems: dict[str, Problem], size: float, members: int, seed: int, kind: str = "even"
) -> Contents:
    """Return quantile bands of the norms of each case by name."""
    results = [run_members(problem, size, members, seed, kind) for problem in problems.values()]
    grid = ("case", "quantile", "quantity", "tau")
    described, shared = describe_cases(problems)
    variables = {
        **described,
        "quantile": Variable(("quantile",), np.array(QUANTILES), "quantile over the ensemble"),
        "quantity": Variable(("quantity",), list(QUANTITIES)),
        "tau": Variable(("tau",), next(iter(problems.values())).times),
    }
    for name, norms in zip(NORMS, zip(*results, strict=True), strict=True):
        values = np.array([bands(norm, QUANTILES) for norm in norms])
        variables[name] = Variable(grid, values, f"{NAMES[name]}, quantiles over the ensemble")
    return variables, {"title": TITLE, **shared}


class Swept(NamedTuple):
    """The ensembles of a sweep: so many members of a problem on chains of each half-width."""

    problem: Problem
    half_widths: list[int]
    members: int


def sweep_moments(
    drawn: dict[str, Swept], windows, size: float, seed: int, kind: str = "even"
) -> dict[str, Variable]:
    """Return mean, deviation and standard error of every swept norm of each sweep by name.

    They are NaN at the half-widths that another sweep has alone.
    """
    results = [
        sweep_members(one.problem, one.half_widths, windows, size, one.members, seed, kind)
        for one in drawn.values()
    ]
    half_widths = sorted({width for one in drawn.values() for width in one.half_widths})
    rows = [np.searchsorted(half_widths, one.half_widths) for one in drawn.values()]
    variables = {
        "sweep": Variable(("sweep",), list(drawn)),
        "half_width": Variable(("half_width",), np.array(half_widths)),
        "quantity": Variable(("quantity",), list(QUANTITIES)),
        "statistic": Variable(("statistic",), list(STATISTICS)),
        "window": Variable(("window",), [name_window(window) for window in windows]),
        "swept_members": Variable(
            ("sweep",), [one.members for one in drawn.values()], "members at each half-width"
        ),
    }
    grid = ("sweep", "half_width", "quantity", "statistic", "window")
    for name, norms in zip(NORMS, zip(*results, strict=True), strict=True):
        reduced = [moments(norm) for norm in norms]
        for key, words in MOMENTS.items():
            shape = (len(drawn), len(half_widths), *norms[0].shape[2:])
            values = np.full(shape, np.nan)
            for i, (row, one) in enumerate(zip(rows, reduced, strict=True)):
                values[i, row] = one[key]
            variables[f"{name}_{key}"] = Variable(grid, values, f"{words} of the {NAMES[name]}")
    return variables


# --- The paper's runs among them ------------------------------------------------------------------

BAND = (0.05, 0.95)
"""The quantiles that bound the band of an ensemble."""

COMPARED = {
    "run": "l2 norm of the pair in the paper's run",
    "true": "l2 norm of the pair in the true run",
    "run_inside": "part of the later half of the time that the paper's run is within the band",
    "band_width": "mean width of the band from 5 to 95 % over the median, later half",
    "band_middle": "mean of the ensemble's median, later half",
    "band_share": "part of the ensemble in the band",
    "swept_run": "maximum of the l2 norm of the pair in the paper's run",
    "deviations": "maximum of the paper's run minus the mean, in standard deviations",
    "swept_window": "time window of the maximum",
    "swept_omega": "detuning Omega",
    "swept_initial": "initial {site: [A, B]}",
}
"""What is compared: of the cases the norms over time, of the sweeps the maxima over M."""


def measure_ensembles(
    problems: dict[str, Problem], members: int, swept: Mapping[str, Mapping], windows,
    size: float, seed: int, kind: str,
) -> Contents:  # fmt: skip
    """Return the bands of cases and the moments of sweeps; there may be no cases.

    `swept` gives by sweep its problem as plain values, half-widths and members at each of them.
    """
    drawn = {"size": size, "seed": seed, "kind": kind}
    own = by_name({name: one["problem"] for name, one in swept.items()})
    runs = {
        name: Swept(own[name], one["half_widths"], one["members"]) for name, one in swept.items()
    }
    cases, shared = {}, {"title": TITLE, **describe_cases(own)[1]}
    if problems:
        cases, shared = case_bands(problems, members=members, **drawn)
        shared["members"] = members
    shared["ensemble"] = f"{kind} in n"
    about = {**shared, "perturbation": size, "seed": seed}
    return cases | sweep_moments(runs, windows, **drawn), about


def compare_runs(ensembles: xr.Dataset, lyapunov: xr.Dataset, **others: Mapping) -> xr.Dataset:
    """Return `compare`, which takes the `others`, and how many chaotic cases have no ensemble."""
    found = compare(ensembles, **others)
    found["mismatched"] = mismatched(ensembles["case"].values, lyapunov)
    print(describe("ensembles of the chaotic cases", found.to_dict()))
    return found


def compare(
    ensembles: xr.Dataset,
    runs: Mapping[str, xr.Dataset],
    references: Mapping[str, xr.Dataset],
    sweeps: Mapping[str, xr.Dataset],
    windows: Mapping[str, str],
) -> xr.Dataset:
    """Return the paper's runs and the references of the same cases beside the ensembles.

    `ensembles` holds what `case_bands` and `sweep_moments` return; the mappings are by case and by
    sweep; `windows` names the time window of each sweep, such as "[10, 50]". All is dimensionless:
    see COMPARED, and `l2_mean`, `l2_deviation` of the ensembles over the same maxima.
    """
    pair = ensembles.sel(quantity="pair", drop=True)
    known = [
        references[case].where(is_of_same_case(run, references[case])) for case, run in runs.items()
    ]
    run, true = (_norms_of(pair, list(runs), data) for data in (runs.values(), known))
    cases = pair[["omega", "initial"]].assign(run=run, true=true)
    late = pair["l2"].sel(tau=slice(float(pair["tau"].max()) / 2, None))
    low, high = (late.sel(quantile=quantile, drop=True) for quantile in BAND)
    run, middle = run.sel(tau=late["tau"]), late.median("quantile")
    cases["run_inside"] = ((run >= low) & (run <= high)).where(run.notnull()).mean("tau")
    cases["band_width"] = ((high - low) / middle).mean("tau")
    cases["band_middle"] = middle.mean("tau")
    cases["band_share"] = BAND[1] - BAND[0]
    swept = [_compare_sweep(pair, name, sweeps[name], window) for name, window in windows.items()]
    found = xr.merge([cases, xr.concat(swept, xr.Variable("sweep", list(windows)))])
    for name, long_name in COMPARED.items():
        found[name].attrs = {"long_name": long_name}
    title = "The paper's runs among ensembles from almost equal data"
    others = {str(run.attrs["solver"]) for run in (*runs.values(), *sweeps.values())} - {"ode45"}
    by = {"other_solvers": ", ".join(sorted(others))} if others else {}
    return found.assign_attrs({**ensembles.attrs, **by, "title": title})


def _norms_of(pair: xr.Dataset, cases: list[str], runs) -> xr.DataArray:
    norms = [np.sqrt((run["l2"] ** 2).sum("component", skipna=False)) for run in runs]
    along = xr.Variable("case", cases)
    # no further than to the nearest output: beyond its end a run is not known
    at = {"tau": pair["tau"], "method": "nearest", "tolerance": 1e-9}
    return xr.concat(norms, along, join="outer").reindex(**at)


def _compare_sweep(pair: xr.Dataset, name: str, own: xr.Dataset, window: str) -> xr.Dataset:
    at = {"statistic": "max", "window": window, "drop": True}
    data = pair[["l2_mean", "l2_deviation"]].sel(sweep=name, **at)
    run = own["l2"].sel(quantity="pair", **at).reindex(half_width=data["half_width"])
    return data.assign(
        swept_run=run,
        deviations=(run - data["l2_mean"]) / data["l2_deviation"],
        swept_window=window,
        swept_omega=float(own.attrs["omega"]),
        swept_initial=str(own.attrs["initial"]),
    )


def mismatched(cases, lyapunov: xr.Dataset) -> xr.Variable:
    """Return how many cases are chaotic without an ensemble, or have one without being chaotic.

    Which cases get ensembles must be configured before any run; what is chaotic is measured. None
    may differ.
    """
    chaotic = {str(case) for case in lyapunov["case"].values[lyapunov["chaotic"].values == 1]}
    about = {"long_name": "cases that have an ensemble or are chaotic, but not both", "units": "1"}
    return xr.Variable((), len(chaotic ^ set(map(str, cases))), {**about, "tolerance": 0.0})
