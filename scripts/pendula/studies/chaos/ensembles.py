"""Seeded ensembles: a case from slightly perturbed initial conditions, as many times as wanted.

Where the motion is chaotic one run is one draw; what a second solver, or another computer, would
draw as well is the distribution.
"""

from collections.abc import Mapping

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

NORMS = {"l2": pair_l2, "linf": pair_linf}
QUANTILES = (0.05, 0.25, 0.5, 0.75, 0.95)
MOMENTS = {
    "mean": "ensemble mean",
    "deviation": "standard deviation over the ensemble",
    "error": "standard error of the ensemble mean",
}


def run_members(problem: Problem, size: float, members: int, seed: int, kind: str) -> np.ndarray:
    """Return the norms l2 and l-infinity of each member, (norm, member, quantity, time)."""
    drawn = draw_members(problem, size, members, seed, kind)
    runs = [simulate(member, energy=False) for member in drawn]
    return np.array([[norm(run) for run in runs] for norm in NORMS.values()])


def sweep_members(
    problem: Problem, half_widths, windows, size: float, members: int, seed: int, kind: str
) -> np.ndarray:
    """Return the swept l2 and l-infinity of each member, (norm, member, *shape of a Sweep).

    Each half-width has draws of its own. The same data would give the same motion on all chains
    that are too long for the front, so that their means would not be independent of each other.
    """
    columns = []
    for half_width in half_widths:
        drawn = draw_members(problem, size, members, [seed, half_width], kind)
        runs = [sweep(member, [half_width], windows) for member in drawn]
        columns.append([[getattr(run, norm) for run in runs] for norm in NORMS])
    return np.concatenate(columns, axis=2)


def measure_ensembles(
    problems: dict[str, Problem], members: int, swept: Mapping[str, Mapping], windows,
    size: float, seed: int, kind: str,
) -> Contents:  # fmt: skip
    """Return quantile bands of the norms of cases, which may be none, and the moments of sweeps.

    `swept` gives by sweep its problem as plain values, half-widths and members at each of them.
    """
    own = by_name({name: one["problem"] for name, one in swept.items()})
    shared, variables = describe_cases(own)[1], {}
    if problems:
        variables, shared = describe_cases(problems)
        shared["members"] = members
        drawn = [run_members(one, size, members, seed, kind) for one in problems.values()]
        tau = next(iter(problems.values())).times
        variables["quantile"] = Variable(
            ("quantile",), np.array(QUANTILES), "quantile over the ensemble"
        )
        variables["quantity"] = Variable(("quantity",), list(QUANTITIES))
        variables["tau"] = Variable(("tau",), tau)
        for name, norms in zip(NORMS, zip(*drawn, strict=True), strict=True):
            variables[name] = Variable(
                ("case", "quantile", "quantity", "tau"),
                np.array([bands(norm, QUANTILES) for norm in norms]),
                f"{NAMES[name]}, quantiles over the ensemble",
            )
    about = {"ensemble": f"{kind} in n", "perturbation": size, "seed": seed}
    title = "Ensembles of the chaotic cases and sweeps, from almost equal data"
    variables |= sweep_moments(own, swept, windows, size, seed, kind)
    return variables, {"title": title, **shared, **about}


def sweep_moments(
    problems: dict[str, Problem], swept: Mapping[str, Mapping], windows,
    size: float, seed: int, kind: str,
) -> dict[str, Variable]:  # fmt: skip
    """Return mean, deviation and standard error of every swept norm of each sweep by name.

    They are NaN at the half-widths that another sweep has alone.
    """
    half_widths = sorted({width for one in swept.values() for width in one["half_widths"]})
    shape = (len(swept), len(half_widths), len(QUANTITIES), len(STATISTICS), len(windows))
    values = {(norm, key): np.full(shape, np.nan) for norm in NORMS for key in MOMENTS}
    for i, (name, one) in enumerate(swept.items()):
        widths, members = one["half_widths"], one["members"]
        found = sweep_members(problems[name], widths, windows, size, members, seed, kind)
        row = np.searchsorted(half_widths, widths)
        for norm, numbers in zip(NORMS, found, strict=True):
            for key, moment in moments(numbers).items():
                values[norm, key][i, row] = moment
    grid = ("sweep", "half_width", "quantity", "statistic", "window")
    return {
        "sweep": Variable(("sweep",), list(swept)),
        "half_width": Variable(("half_width",), np.array(half_widths)),
        "quantity": Variable(("quantity",), list(QUANTITIES)),
        "statistic": Variable(("statistic",), list(STATISTICS)),
        "window": Variable(("window",), [name_window(window) for window in windows]),
        "swept_members": Variable(
            ("sweep",), [one["members"] for one in swept.values()], "members at each half-width"
        ),
        **{
            f"{norm}_{key}": Variable(grid, each, f"{MOMENTS[key]} of the {NAMES[norm]}")
            for (norm, key), each in values.items()
        },
    }


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


def compare_runs(
    ensembles: xr.Dataset,
    lyapunov: xr.Dataset,
    runs: Mapping[str, xr.Dataset],
    references: Mapping[str, xr.Dataset],
    sweeps: Mapping[str, xr.Dataset],
    windows: Mapping[str, str],
) -> xr.Dataset:
    """Return the paper's runs and the references of the same cases beside the ensembles.

    `ensembles` holds what `measure_ensembles` returns; `runs` and `references` are by case, the
    others by sweep; `windows` names time windows, such as "[10, 50]". All is dimensionless: see
    COMPARED, and `l2_mean`, `l2_deviation` of the ensembles over the same maxima.
    """
    pair = ensembles.sel(quantity="pair", drop=True)
    known = [
        references[case].where(is_of_same_case(run, references[case])) for case, run in runs.items()
    ]
    run, true = (norms_at(pair["tau"], list(runs), data) for data in (runs.values(), known))
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
    found = found.assign_attrs({**ensembles.attrs, **by, "title": title})
    found["mismatched"] = mismatched(ensembles["case"].values, lyapunov)
    print(describe("ensembles of the chaotic cases", found.to_dict()))
    return found


def norms_at(tau: xr.DataArray, cases: list[str], runs) -> xr.DataArray:
    """Return the l2 norm of the pair in each run at `tau`, (case, tau); NaN beyond its end."""
    norms = [np.sqrt((run["l2"] ** 2).sum("component", skipna=False)) for run in runs]
    joined = xr.concat(norms, xr.Variable("case", cases), join="outer")
    return joined.reindex(tau=tau, method="nearest", tolerance=1e-9)


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
