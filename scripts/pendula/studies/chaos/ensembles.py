"""Seeded ensembles: a case from data that differ in their last digits, as many times as wanted.

Where the motion is chaotic one run is one draw; what a second solver, or another computer, would
draw as well is the distribution.
"""

from collections.abc import Mapping

import numpy as np
import xarray as xr

from pendula.datasets.netcdf import Variable
from pendula.measures.difference import is_of_same_case
from pendula.measures.levels import bands, moments
from pendula.problem import Problem, name_window
from pendula.simulation.simulate import simulate
from pendula.simulation.sweep import QUANTITIES, STATISTICS, pair_l2, pair_linf, sweep

from .lyapunov import describe_cases

QUANTILES = (0.05, 0.25, 0.5, 0.75, 0.95)


def perturb(initial: np.ndarray, size: float, rng: np.random.Generator) -> np.ndarray:
    """Return data (2, 2r + 1), each amplitude times 1 + size (x + iy) of Gaussian x and y.

    Sites n and -n take the same factors, so that even data stay even.
    """
    reach = initial.shape[1] // 2
    drawn = (reach + 1, 2)
    factors = 1.0 + size * (rng.normal(size=drawn) + 1j * rng.normal(size=drawn))
    return initial * factors[np.abs(np.arange(-reach, reach + 1))].T


def draw_members(problem: Problem, size: float, members: int, seed: int) -> list[Problem]:
    """Return as many copies of `problem` with perturbed data."""
    rng = np.random.default_rng(seed)
    return [problem.changed(initial=perturb(problem.initial, size, rng)) for _ in range(members)]


def run_members(
    problem: Problem, size: float, members: int, seed: int = 0
) -> tuple[np.ndarray, np.ndarray]:
    """Return the norms l2 and l-infinity of each member, both (member, quantity, time)."""
    runs = [simulate(member) for member in draw_members(problem, size, members, seed)]
    return np.array([pair_l2(run) for run in runs]), np.array([pair_linf(run) for run in runs])


def sweep_members(
    problem: Problem, half_widths, windows, size: float, members: int, seed: int = 0
) -> tuple[np.ndarray, np.ndarray]:
    """Return the swept l2 and l-infinity of each member, both (member, *shape of a Sweep)."""
    drawn = draw_members(problem, size, members, seed)
    sweeps = [sweep(member, half_widths, windows) for member in drawn]
    return np.array([s.l2 for s in sweeps]), np.array([s.linf for s in sweeps])


NORMS = {"l2": "l2", "linf": "l-infinity"}
MOMENTS = {
    "mean": "ensemble mean",
    "deviation": "standard deviation over the ensemble",
    "error": "standard error of the ensemble mean",
}


def case_bands(problems: dict[str, Problem], size: float, members: int, seed: int):
    """Return quantile bands of the norms of each case by name."""
    results = [run_members(problem, size, members, seed) for problem in problems.values()]
    first = next(iter(problems.values()))
    tau = first.times
    grid = ("case", "quantile", "quantity", "tau")
    variables = {
        **describe_cases(problems),
        "quantile": Variable(("quantile",), np.array(QUANTILES), "quantile over the ensemble"),
        "quantity": Variable(("quantity",), list(QUANTITIES)),
        "tau": Variable(("tau",), tau),
    }
    for (name, title), norms in zip(NORMS.items(), zip(*results, strict=True), strict=True):
        values = np.array([bands(norm, QUANTILES) for norm in norms])
        variables[name] = Variable(grid, values, f"quantiles of the {title} norm")
    return variables


def sweep_moments(
    problems: dict[str, Problem], half_widths, windows, size: float, members: int, seed: int
) -> dict[str, Variable]:
    """Return mean, deviation and standard error of every swept norm of each sweep by name."""
    results = [
        sweep_members(problem, half_widths, windows, size, members, seed)
        for problem in problems.values()
    ]
    names = [name_window(window) for window in windows]
    variables = {
        "sweep": Variable(("sweep",), list(problems)),
        "half_width": Variable(("half_width",), np.array(half_widths)),
        "statistic": Variable(("statistic",), list(STATISTICS)),
        "window": Variable(("window",), names),
    }
    grid = ("sweep", "half_width", "quantity", "statistic", "window")
    for (name, title), norms in zip(NORMS.items(), zip(*results, strict=True), strict=True):
        reduced = [moments(norm) for norm in norms]
        for key, words in MOMENTS.items():
            values = np.array([one[key] for one in reduced])
            variables[f"{name}_{key}"] = Variable(grid, values, f"{words} of the {title} norm")
    return variables


# --- The paper's runs among them ------------------------------------------------------------------

BAND = (0.05, 0.95)
"""The quantiles that bound the band of an ensemble."""


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
    `run`, `true` (case, tau) are l2 norms of the pair, `run_inside`, `true_inside` (case) the parts
    of the later half of the time that they are inside BAND, `band_width`, `band_middle` (case) the
    mean width of that band relative to the median and the mean median, over the same time;
    `l2_mean`, `l2_deviation`, `swept_run`, `deviations` (sweep, half_width) are the maxima of the
    ensemble and of the paper's run, and their distance in standard deviations.
    """
    pair = ensembles.sel(quantity="pair", drop=True)
    names = xr.Variable("case", list(runs), ensembles["case"].attrs)
    known = [
        references[case].where(is_of_same_case(run, references[case])) for case, run in runs.items()
    ]
    run, true = (_norms_of(pair, names, data) for data in (runs.values(), known))
    run.attrs = _words("l2 norm of the paper's run")
    true.attrs = _words("l2 norm of the true run")
    cases = pair[["omega", "initial"]].assign(run=run, true=true)
    cases["run_inside"], cases["true_inside"] = (_inside(pair, norm) for norm in (run, true))
    cases["band_width"], cases["band_middle"] = _band(pair)
    cases["band_share"] = (), BAND[1] - BAND[0], _words("part of the ensemble in the band")
    swept = [_compare_sweep(pair, name, sweeps[name], window) for name, window in windows.items()]
    name = xr.Variable("sweep", list(windows), _words("sweep"))
    title = "The paper's runs among ensembles from almost equal data"
    both = xr.merge([cases, xr.concat(swept, name)], combine_attrs="drop_conflicts")
    return both.drop_attrs(deep=False).assign_attrs(title=title)


def _words(long_name: str) -> dict[str, str]:
    return {"long_name": long_name, "units": "1"}


def _norms_of(pair: xr.Dataset, names: xr.Variable, runs) -> xr.DataArray:
    norms = [np.sqrt((run["l2"] ** 2).sum("component", skipna=False)) for run in runs]
    return xr.concat(norms, names, join="outer").reindex(tau=pair["tau"], method="nearest")


def _late(curve):
    """Return the later half of the time."""
    return curve.sel(tau=slice(float(curve["tau"].max()) / 2, None))


def _inside(pair: xr.Dataset, norm: xr.DataArray) -> xr.DataArray:
    """Return the part of the later half of the time in which a norm is within the band."""
    low, high = (pair["l2"].sel(quantile=quantile) for quantile in BAND)
    inside = ((norm >= low) & (norm <= high)).where(norm.notnull())
    name = f"part of the later half that {norm.attrs['long_name']} is within 5 to 95 %"
    found = _late(inside).mean("tau").drop_vars("quantile", errors="ignore")
    return found.assign_attrs(_words(name))


def _band(pair: xr.Dataset) -> tuple[xr.DataArray, xr.DataArray]:
    """Return the mean width of the band relative to the median, and the mean median."""
    late = _late(pair["l2"])
    low, high = (late.sel(quantile=quantile, drop=True) for quantile in BAND)
    middle = late.median("quantile")
    width = ((high - low) / middle).mean("tau")
    words = _words("mean width of the band from 5 to 95 % over the median, later half")
    return width.assign_attrs(words), middle.mean("tau").assign_attrs(
        _words("mean of the ensemble's median, later half")
    )


def _compare_sweep(pair: xr.Dataset, name: str, own: xr.Dataset, window: str) -> xr.Dataset:
    at = {"statistic": "max", "window": window, "drop": True}
    data = pair[["l2_mean", "l2_deviation"]].sel(sweep=name, **at)
    run = own["l2"].sel(quantity="pair", **at).reindex(half_width=data["half_width"])
    data["swept_run"] = run.assign_attrs(_words("maximum of the paper's run"))
    off = (run - data["l2_mean"]) / data["l2_deviation"]
    words = "maximum of the paper's run minus the mean, in standard deviations"
    data["deviations"] = off.assign_attrs(_words(words))
    data["swept_window"] = (), window, _words("window of the maximum")
    data["swept_omega"] = (), float(own.attrs["omega"]), _words("detuning Omega")
    data["swept_initial"] = (), str(own.attrs["initial"]), _words("initial {site: [A, B]}")
    return data


def mismatched(cases, lyapunov: xr.Dataset) -> xr.Variable:
    """Return how many cases are chaotic without an ensemble, or have one without being chaotic.

    Which cases get ensembles must be configured before any run; what is chaotic is measured. None
    may differ.
    """
    chaotic = {str(case) for case in lyapunov["case"].values[lyapunov["chaotic"].values == 1]}
    about = {"long_name": "cases that have an ensemble or are chaotic, but not both", "units": "1"}
    return xr.Variable((), len(chaotic ^ set(map(str, cases))), {**about, "tolerance": 0.0})
