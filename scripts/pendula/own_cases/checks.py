"""Checks of a user's case: those of any run, and what the paper states about it.

Of the amplitudes these are Lemma 1 for the chain at rest, and Lemma 2 and Theorems 1 to 3 for the
trajectory. Of pendula the amplitude equations (4) are solved from the same data instead, and what
the expansion (3) makes of them at the end is compared with the angles there. A pendulum that passes
the top has left the range of (3) for good.
"""

import numpy as np
import xarray as xr
from latticode import checks
from latticode.checks import measure_sensitivity, merged, run_again
from latticode.datasets.checks import table, variable
from latticode.measures.norms import power_of
from latticode.numerics.elementary import modulus, product, square_modulus
from latticode.numerics.quadrature import gauss_legendre
from latticode.simulation.problem import on_sites, place, read_initial
from latticode.simulation.simulate import IntegrationError, simulate

from pendula.models.bounds import best_bound, growth_margin
from pendula.models.linear_chain import finite_rate, finite_threshold, gamma_0, infinite_rate
from pendula.models.pendula import leading_angles
from pendula.problem import AMPLITUDES, PENDULA, Constants, Problem
from pendula.studies.theory.bounds import NUMBERS, case_numbers
from pendula.studies.theory.equations import run as run_on
from pendula.studies.theory.equations import total_energy

TITLE = "A case beside the paper's statements"
KEPT = {AMPLITUDES: ("energy",), PENDULA: ("final",)}
"""What the statements read of a run beside its norms."""


# --- The paper's statements -----------------------------------------------------------------------

MARGIN = {
    "from_start": "largest P over its bound (19)",
    "steepest": "steepest log P over 4 gamma",
}
RADIANS, PANELS = 40.0, 24
"""The balance of Lemma 2 is integrated while the data turn by RADIANS, on so many panels."""


def beside_bounds(run: xr.Dataset) -> dict:
    """Return the trajectory's numbers beside its bounds, and the theorem that covers it."""
    with np.errstate(divide="ignore", invalid="ignore"):  # a chain at rest has no ratios
        numbers = case_numbers(run)
        margin = growth_margin(run["tau"].values, run["l2"].values, float(run.attrs["gamma"]))
    described = {name: variable(numbers[name], (), text) for name, (text, _) in NUMBERS.items()}
    described |= {name: variable(margin[name], (), text) for name, text in MARGIN.items()}
    drift = float(np.abs(run["energy"] - run["energy"][0]).max())
    return described | {"energy_drift": variable(drift, (), "largest |H - H(0)|")}


def at_rest(problem: Problem) -> dict:
    """Return thresholds and growth rates of a chain at rest, infinite and of this length."""
    epsilon, gamma, omega = problem.constants
    chain = (epsilon, problem.sites, problem.boundary)
    rate, threshold = infinite_rate(omega, gamma, epsilon), finite_threshold(omega, *chain)
    finite, unit = finite_rate(omega, gamma, *chain), "per unit of tau"
    return {
        "gamma_0": variable(gamma_0(omega, epsilon), (), "threshold (12) of the infinite chain"),
        "finite_threshold": variable(threshold, (), "threshold of N sites"),
        "infinite_rate": variable(rate, (), f"largest rate of the infinite chain, {unit}"),
        "finite_rate": variable(finite, (), f"largest rate of the finite chain, {unit}"),
    }


def integrated_balance(
    constants, boundary: str, amplitudes, end_time: float, solver: dict
) -> tuple[float, float]:
    """Return the change of P along a trajectory and the integral of its balance (Gauss-Legendre).

    The rate of P is 2 gamma times the imaginary part of the sum of (A - B)^2, as Lemma 2 says. The
    state is carried from node to node, eight to a panel.
    """
    nodes, weights = gauss_legendre(8)
    half = 0.5 * end_time / PANELS
    times = np.concatenate([half * (2 * k + 1 + nodes) for k in range(PANELS)] + [[end_time]])
    state, integral = amplitudes, 0.0
    for i, step in enumerate(np.diff(times, prepend=0.0)):
        state = run_on(constants, boundary, state, step, solver=solver).final
        if i < len(times) - 1:
            apart = state[0] - state[1]
            rate = 2.0 * constants.gamma * np.sum(product(apart, apart)).imag
            integral += half * weights[i % 8] * float(rate)
    return power_of(state) - power_of(amplitudes), float(integral)


def balance(problem: Problem, run: xr.Dataset, solver: dict) -> dict:
    """Return how well the balance of P in Lemma 2 holds from the initial data on.

    `solver` carries the state from node to node of the quadrature. The error is NaN where that is
    refused, and of a chain at rest.
    """
    constants, amplitudes = problem.constants, problem.amplitudes
    start, peak = float(np.sum(square_modulus(amplitudes))), float(run["linf"].max())
    linear = 4 * abs(constants.epsilon) + 2 * abs(constants.gamma) + abs(constants.omega)
    rate = linear + peak * peak
    span = min(problem.end_time, RADIANS / rate) if rate else problem.end_time
    try:
        change, integral = integrated_balance(constants, problem.boundary, amplitudes, span, solver)
    except IntegrationError:  # `run_again` keeps the reason, which is of the solver and the data
        change, integral = np.nan, np.nan
    error = abs(change - integral) / max(start, start + change) if start else np.nan
    return {
        "balance_error": variable(error, (), "change of P minus its balance (Lemma 2), over P"),
        "balance_span": variable(span, (), "tau to which the balance is followed"),
    }


def beside_statements(problem: Problem, run: xr.Dataset, solver: dict) -> xr.Dataset:
    """Return what the paper states about a case, beside its trajectory."""
    numbers = beside_bounds(run) | at_rest(problem) | balance(problem, run, solver)
    return xr.Dataset.from_dict(table(TITLE, {}, **numbers))


# --- The pendula ----------------------------------------------------------------------------------

TITLE_OF_PENDULA = "A case of the pendula beside the expansion (3)"


def over_the_top(run: xr.Dataset) -> float:
    """Return the first tau of the outputs at which an angle exceeds pi, infinite if none does."""
    beyond = (run["linf"] > np.pi).any("component").values
    return float(run["tau"][beyond.argmax()]) if beyond.any() else np.inf


def beside_expansion(problem: Problem, run: xr.Dataset) -> xr.Dataset:
    """Return the largest angle, and how far the angles at the end are from those of (3)."""
    angles = run["final"].sel(part="angle").values
    solver = {"name": "taylor", "rtol": 1e-14, "atol": 1e-14}
    changed = problem.changed(model=AMPLITUDES, solver=solver, snapshot_every=0)
    try:
        amplitudes = simulate(changed).final
        expected = leading_angles(amplitudes, problem.constants.omega, problem.mu, problem.end_time)
        apart = float(np.abs(angles - expected).max())
        scale = float(2.0 * problem.mu * modulus(amplitudes).max())
    except IntegrationError:  # data of (4) may be refused that pendula can be followed from
        apart = scale = np.nan
    swing = "largest 2 mu abs(A_n) or 2 mu abs(B_n) of (4) at the end"
    top = "first tau at which an angle exceeds pi, infinite: at no output"
    numbers = {
        "largest_angle": variable(float(run["linf"].max()), (), "largest angle", "rad"),
        "over_the_top": variable(over_the_top(run), (), top),
        "expansion_error": variable(apart, (), "largest |x - x of (3)| at the end", "rad"),
        "expansion_swing": variable(scale, (), swing, "rad"),
    }
    return xr.Dataset.from_dict(table(TITLE_OF_PENDULA, {}, **numbers))


def check_sweep(name: str, swept: xr.Dataset) -> xr.Dataset:
    """Return the largest angle on each chain of a sweep, and on how many one goes over the top."""
    peaks = swept["linf"].sel(quantity="pair", statistic="max").max("window").values
    angles = variable(peaks, ("half_width",), "largest angle in the windows", "rad")
    over = variable(int(np.sum(peaks > np.pi)), (), "chains on which a pendulum goes over the top")
    coordinates = {"half_width": swept["half_width"].values}
    found = table(TITLE_OF_PENDULA, coordinates, swept_angle=angles, swept_over=over)
    return xr.Dataset.from_dict(found).assign_attrs(case=name)


def check_bounds(name: str, swept: xr.Dataset) -> xr.Dataset:
    """Return the largest P of each chain of a sweep over the smallest bound of Theorems 1 to 3."""
    constants, boundary = Constants.of(swept.attrs), str(swept.attrs["boundary"])
    initial, bounds = on_sites(read_initial(swept.attrs["initial"])), []
    for half_width in map(int, swept["half_width"].values):
        amplitudes = place(initial, half_width)
        energy = total_energy(constants, boundary, amplitudes)
        sites = 2 * half_width + 1
        bounds.append(best_bound(energy, power_of(amplitudes), sites, constants, boundary))
    peaks = swept["l2"].sel(quantity="pair", statistic="max").max("window").values ** 2
    words = "largest P of all chains in the windows over its bound"
    ratio = variable(np.max(peaks / bounds), (), words, tolerance=1.0)
    return xr.Dataset.from_dict(table(TITLE, {}, swept_ratio=ratio)).assign_attrs(case=name)


def check_swept(name: str, swept: xr.Dataset) -> xr.Dataset:
    """Return what the paper states about a sweep; nothing about a sweep of other equations."""
    if swept.attrs.get("model") == PENDULA:
        return check_sweep(name, swept)
    if "omega" in swept.attrs:
        return check_bounds(name, swept)
    return xr.Dataset(attrs={"case": name})


# --- All checks -----------------------------------------------------------------------------------


def check_run(problem: Problem, run: xr.Dataset) -> xr.Dataset:
    """Return all checks of a case as one dataset, with the attributes of the case.

    `run` is the trajectory that `simulate` made of `problem`.
    """
    if problem.model.name == PENDULA:
        return merged(run, run_again(problem, run), beside_expansion(problem, run))
    if problem.model.name != AMPLITUDES:
        return checks.check_run(problem, run)
    again = run_again(problem, run)
    solver = {key: again.attrs[f"second_{key}"] for key in ("name", "rtol", "atol")}
    others = measure_sensitivity(problem), beside_statements(problem, run, solver)
    return merged(run, again, *others)
