"""Ensembles of long runs on chains without ends: their members, their datasets, how norms grow.

Where the chain at rest is unstable, a front moves at the speed v of linear spreading and leaves a
thermal bulk of mean power P per site on both sides. The norm is then l2 = (2 v P tau)^(1/2).
"""

from collections.abc import Mapping

import numpy as np
import xarray as xr

from pendula import __version__
from pendula.datasets.netcdf import Variable
from pendula.measures.growth import local_exponents
from pendula.problem import Problem, write_initial

from .active_sites import LEVELS, LongRun
from .front import linear_front

SIZE = 1e-6
"""Relative size of the differences: grown to order one within some ten units of tau by chaos."""


def member(initial: np.ndarray, number: int, seed: int = 2017) -> np.ndarray:
    """Return the initial data of an ensemble's member; number 0 has the data as they are.

    All sites of a component share a factor, so that even data stay even.
    """
    if number == 0:
        return initial
    factors = 1.0 + SIZE * np.random.default_rng([seed, number]).normal(size=2)
    return initial * factors[:, None]


RUN = ("variant", "member")


def run_variables(problems: list[Problem], runs: list[list[LongRun]]) -> dict[str, Variable]:
    """Return the variables of `runs` [variant][member] of as many problems."""
    first = runs[0][0]
    predicted = [linear_front(problem.constants) for problem in problems]

    def series(name: str, axis: str, title: str, more: tuple = ()) -> Variable:
        values = [[getattr(run, name) for run in members] for members in runs]
        return Variable((*RUN, axis, *more), np.array(values), title)

    return {
        "tau": Variable(("tau",), first.tau, "slow time"),
        "piece_tau": Variable(("piece_tau",), first.piece_tau, "slow time at the end of a piece"),
        "level": Variable(("level",), LEVELS, "power |A|^2 + |B|^2 at which the front is found"),
        **_parameters(problems),
        "l2": series("l2", "tau", "l2 norm of (A, B) over the chain"),
        "linf": series("linf", "tau", "l-infinity norm of (A, B) over the chain"),
        "energy": series("energy", "tau", "conserved energy H of equation (8)"),
        "front": series("front", "piece_tau", "outermost site above a power", ("level",)),
        "width": series("width", "piece_tau", "last site that is integrated, W"),
        "evaluations": series("evaluations", "piece_tau", "right-hand sides taken in the piece"),
        "state": Variable(
            (*RUN, "row", "site"),
            _padded([[run.state[:, 1:-1] for run in members] for members in runs]),
            "Re A, Im A, Re B, Im B at the end, zero beyond W",
        ),
        "predicted_speed": _of_variants(
            [front.speed for front in predicted], "linear spreading speed (sites per tau)"
        ),
        "predicted_delay": _of_variants(
            [front.delay for front in predicted], "sites lost per unit of log tau on the way to it"
        ),
    }


def attributes(name: str, problem: Problem, rest: float) -> dict:
    """Return what was solved: no dates, no hosts."""
    values = problem.plain()
    plain = {key: values[key] for key in ("epsilon", "gamma", "omega", "end_time", "output_step")}
    return {
        "case": name,
        **plain,
        "rest": rest,
        "initial": write_initial(values["initial"]),
        "boundary": "none: sites are added as the front moves",
        "solver": problem.solver["name"],
        "solver_rtol": problem.solver["rtol"],
        "version": __version__,
    }


def _parameters(problems: list[Problem]) -> dict[str, Variable]:
    return {
        "omega": _of_variants([p.constants.omega for p in problems], "detuning Omega"),
        "amplitude": _of_variants([_central(p) for p in problems], "initial |A_0|"),
        "tolerance": _of_variants([p.solver["rtol"] for p in problems], "solver's tolerance"),
    }


def _central(problem: Problem) -> float:
    """Return |A_0| at the start."""
    return abs(problem.initial[0, problem.initial.shape[1] // 2])


def _of_variants(values: list[float], title: str) -> Variable:
    return Variable(("variant",), np.array(values, float), title)


def _padded(states: list[list[np.ndarray]]) -> np.ndarray:
    widest = max(state.shape[1] for members in states for state in members)
    return np.array(
        [[np.pad(s, ((0, 0), (0, widest - s.shape[1]))) for s in members] for members in states]
    )


# --- Growth -------------------------------------------------------------------------------------

POINTS, OCTAVES = 120, 4
"""Times of a series, equally spaced in log tau; the last octaves of time with an exponent each."""
NORMS = {"l2": "l2", "linf": "l-infinity"}
STATISTICS = ["lowest", "mean", "highest"]


def measure_growth(runs: Mapping[str, xr.Dataset], thermal: xr.Dataset) -> xr.Dataset:
    """Return series, exponents and laws of the ensembles in `runs`, by case.

    `runs` are datasets of `run_variables`, of which the first variant is measured; `thermal`
    holds the mean power of the thermal states over Omega. All values are dimensionless:
    `l2`, `linf` (case, statistic, point) over `tau` (case, point); `l2_exponent` and
    `linf_exponent` (case, octave) with standard errors, at `octave_tau` (case, octave); `law`
    (case), the coefficient of tau^(1/2), NaN where the chain at rest is stable.
    """
    first = [run.isel(variant=0) for run in runs.values()]
    case = xr.Variable("case", list(runs), _words("case of the paper, on a chain without ends"))
    data = xr.concat([_measure(run) for run in first], case)
    data["omega"] = "case", [float(run["omega"]) for run in first], _words("detuning Omega")
    initials = [str(run.attrs["initial"]) for run in first]
    data["initial"] = "case", initials, _words("initial {site: [A, B]}")
    laws = [_law(run, thermal) for run in first]
    title = "coefficient of tau^(1/2) by linear spreading and the thermal bulk"
    data["law"] = "case", laws, _words(title)
    same = {key: first[0].attrs[key] for key in ("epsilon", "gamma", "version") if key in
            first[0].attrs}  # fmt: skip
    title = "Growth of the norms on chains without ends"
    return data.assign_attrs(title=title, **same)


def _words(long_name: str) -> dict[str, str]:
    return {"long_name": long_name, "units": "1"}


def _law(run: xr.Dataset, thermal: xr.Dataset) -> float:
    """Return (2 v P)^(1/2), NaN where the chain at rest is stable or no state was sampled."""
    near = thermal.sel(omega=run["omega"], method="nearest")
    if not (run["predicted_delay"] > 0 and abs(near["omega"] - run["omega"]) < 1e-9):
        return float("nan")
    return float(np.sqrt(2.0 * run["predicted_speed"] * near["power"]))


def _measure(run: xr.Dataset) -> xr.Dataset:
    tau = run["tau"].values
    grid = np.geomspace(1.0, tau[-1], POINTS)
    found = xr.Dataset({"tau": ("point", grid, _words("slow time"))})
    for name, title in NORMS.items():
        values = run[name].transpose("member", "tau").values
        drawn = np.array([np.interp(grid, tau, series) for series in values])
        band = [drawn.min(axis=0), drawn.mean(axis=0), drawn.max(axis=0)]
        found[name] = ("statistic", "point"), np.array(band), _words(f"{title} norm of (A, B)")
        middles, fits = local_exponents(tau, values, OCTAVES)
        exponents, errors = np.array(fits).T
        title = f"exponent of tau in the {title} norm over an octave"
        found[f"{name}_exponent"] = "octave", exponents, _words(title)
        found[f"{name}_exponent_error"] = "octave", errors, _words(f"standard error of the {title}")
    found["octave_tau"] = "octave", middles, _words("middle of an octave of tau")
    return found.assign_coords(statistic=("statistic", STATISTICS, _words("over the ensemble")))
