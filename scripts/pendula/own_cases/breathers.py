"""A localised state of a model of a user's own, steady or turning, and its stability.

Where the equations do not change as all fields turn by one phase, a state u_n(tau) = phi_n
exp(-i lambda tau) with the power of the user's data is looked for:

    F(phi) + i lambda phi = nu phi,    |phi|^2 = P,

F the rates of the model. The unknown nu must come out as zero: elsewhere the state would grow or
decay. In other models a steady state F(phi) = 0 is looked for. The coupling of the sites is turned
on in steps from zero, where the state lies on the one site at which the data are largest, and each
step is solved by Newton's method (R. S. MacKay and S. Aubry, Nonlinearity 7 (1994) 1623).

In the frame that turns with the state, a perturbation grows as exp(mu tau) with the eigenvalues mu
of the derivative of F + i lambda; exp(2 pi mu / abs(lambda)) is its Floquet multiplier.
"""

from typing import NamedTuple

import numpy as np
import xarray as xr
from latticode.datasets.checks import table, variable
from latticode.localised.linearised import linearise
from latticode.numerics.elementary import square_modulus

from pendula.problem import Problem

TITLE = "A localised state of a model of one's own"
MOST_UNKNOWNS = 1000
"""The eigenvalues of a larger matrix take a minute and more."""
TOLERANCE, ITERATIONS = 1e-11, 30
"""Largest rate that is left, relative to the largest slope times the largest value."""
FIRST_STEP, SMALLEST_STEP, LARGEST_CHANGE = 1 / 8, 1 / 4096, 0.2
"""Of the coupling; and of a state in one such step, relative to its largest value: a larger change
may lead to another family."""
DAMPING = 1e-12
"""Of the squares of slopes: those below are none."""
NOISE = 1e-5
"""Exponents are known to the root of rounding where two of them meet, as those of a phase do."""
LOCALISED = 0.01
"""Largest value at the sites farthest from the centre, relative to that at the centre."""


class NoStateError(ArithmeticError):
    """There is no localised state to be found; the message says why."""


class State(NamedTuple):
    """A state phi that turns as exp(-i frequency tau), or is steady, as a flat real state x.

    That is by row, the real and imaginary parts of each field or its value and its rate, and site.
    """

    x: np.ndarray
    frequency: float = 0.0
    growth: float = 0.0  # nu of the module's text


def flat(fields: np.ndarray) -> np.ndarray:
    """Return complex fields (field, site) as a flat real state."""
    return np.stack([fields.real, fields.imag], axis=1).ravel()


def turning(problem: Problem) -> np.ndarray:
    """Return the matrix that multiplies all fields of a flat state by i."""
    one_field = np.kron([[0.0, -1.0], [1.0, 0.0]], np.eye(problem.sites))
    return np.kron(np.eye(len(problem.model.fields)), one_field)


def can_turn(problem: Problem) -> bool:
    """Return whether the equations stay the same as all fields turn by one phase.

    Random fields decide: a polynomial that vanishes there vanishes everywhere.
    """
    if problem.model.second_order:
        return False
    turn = turning(problem)
    x = np.random.default_rng(1).normal(size=len(turn))
    rates, after = (linearise(problem, one)[0] for one in (x, 0.6 * x + 0.8 * (turn @ x)))
    expected = 0.6 * rates + 0.8 * (turn @ rates)
    return bool(np.abs(after - expected).max() <= 1e-10 * np.abs(expected).max())


def newton(problem: Problem, state: State, power: float | None, coupling: float = 1.0) -> State:
    """Return the state that Newton's method finds: of a `power`, or steady if it is None.

    Raises NoStateError where it finds none.
    """
    turn, least = turning(problem), np.inf
    for _ in range(ITERATIONS):
        x = state.x
        rates, matrix = linearise(problem, x, coupling)
        scale = np.abs(matrix).max() * np.abs(x).max()
        if power is not None:
            frame = state.frequency * turn - state.growth * np.eye(x.size)
            rates = np.append(rates + frame @ x, x @ x - power)
            slopes = np.column_stack([matrix + frame, turn @ x, -x])
            matrix = np.vstack([slopes, np.append(2.0 * x, (0.0, 0.0))])
        left = np.abs(rates).max() / scale if scale > 0.0 else np.inf
        if not np.isfinite(left):
            break
        if left <= TOLERANCE and left >= 0.5 * least:  # converged, and rounding is reached
            return state
        least = min(left, least)
        change = least_change(matrix, rates)
        more = change[x.size :] if power is not None else (0.0, 0.0)
        state = State(x + change[: x.size], state.frequency + more[0], state.growth + more[1])
    raise NoStateError("Newton's method does not converge")


def least_change(matrix: np.ndarray, rates: np.ndarray) -> np.ndarray:
    """Return the step that solves matrix @ step = -rates, along no direction that this leaves free.

    Such are a phase, and the place of a state that can slide (K. Levenberg, Quart. Appl. Math. 2
    (1944) 164).
    """
    normal = matrix.T @ matrix
    normal[np.diag_indices_from(normal)] += DAMPING * np.abs(normal).max()
    return -np.linalg.solve(normal, matrix.T @ rates)


def find_state(problem: Problem) -> State:
    """Return the localised state that continues the data at their largest site.

    Raises NoStateError, with the reason, where there is none.
    """
    data = problem.amplitudes
    if problem.model.driven:
        raise NoStateError("the equations depend on the time")
    if not data.any():
        raise NoStateError("the chain is at rest")
    if 2 * data.size > MOST_UNKNOWNS:
        most = MOST_UNKNOWNS // (2 * len(data))
        raise NoStateError(f"the chain has {problem.sites} sites; give at most {most}")
    if linearise(problem, flat(0.0 * data))[0].any():
        raise NoStateError("rest does not solve the equations, so that no state decays to it")
    try:
        state, power = uncoupled(problem)
    except NoStateError:
        raise NoStateError("an uncoupled site has none near the data; try others") from None
    return coupled(problem, state, power)


def uncoupled(problem: Problem) -> tuple[State, float | None]:
    """Return the state of the site where the data are largest, and its power if it turns.

    It starts from the data there, made larger to have the power of all.
    """
    data = problem.amplitudes
    sizes = np.sum(square_modulus(data), axis=0)
    x = flat(np.where(sizes == sizes.max(), data, 0.0))
    if not can_turn(problem):
        return newton(problem, State(x), None, coupling=0.0), None
    power = float(np.sum(sizes))
    x *= np.sqrt(power / (x @ x))
    rates = linearise(problem, x, 0.0)[0]
    start = State(x, -(turning(problem) @ x) @ rates / power, x @ rates / power)
    return newton(problem, start, power, coupling=0.0), power


def coupled(problem: Problem, state: State, power: float | None) -> State:
    """Return the state of the full coupling that continues one without any."""
    reached, step = 0.0, FIRST_STEP
    while reached < 1.0:
        target = min(1.0, reached + step)
        try:
            found = newton(problem, state, power, target)
            near = np.abs(found.x - state.x).max() <= LARGEST_CHANGE * np.abs(state.x).max()
        except NoStateError:
            near = False
        if near:
            state, reached, step = found, target, 2.0 * step
        elif step > SMALLEST_STEP:
            step *= 0.5
        else:
            raise NoStateError(f"it ends at {reached:.3g} of the coupling")
    if abs(state.growth) > NOISE:
        change = "grow" if state.growth > 0.0 else "decay"
        raise NoStateError(f"its power would {change}, at the rate {2.0 * abs(state.growth):.3g}")
    return state


def exponents(problem: Problem, state: State) -> np.ndarray:
    """Return the eigenvalues mu of perturbations in the frame of a state, complex, sorted."""
    matrix = linearise(problem, state.x)[1] + state.frequency * turning(problem)
    values = np.linalg.eigvals(matrix)
    clean = [np.where(np.abs(part) < NOISE, 0.0, part) for part in (values.real, values.imag)]
    return np.sort_complex(np.round(clean[0], 9) + 1j * np.round(clean[1], 9))


def check_breather(problem: Problem) -> xr.Dataset:
    """Return a localised state with its exponents, or as an attribute why there is none.

    The multipliers are those over a period, or over a unit of tau where the state is steady.
    """
    try:
        with np.errstate(all="ignore"):  # Newton's method may run away, and is then stopped
            state = find_state(problem)
    except NoStateError as error:
        return xr.Dataset(attrs={"breather_refusal": str(error)})
    parts = state.x.reshape(-1, 2, problem.sites)
    moduli = np.sqrt(np.sum(parts**2, axis=1))
    sizes = moduli.max(axis=0)
    away = np.abs(np.arange(sizes.size) - sizes.argmax())
    end = sizes[away >= away.max() - 1].max() / sizes.max()
    waves, found = exponents(problem, state._replace(x=0.0 * state.x)), exponents(problem, state)
    period = 2.0 * np.pi / abs(state.frequency) if state.frequency else 1.0
    growth, multipliers = found.real.max(), np.exp(period * found)
    frequencies = "its distance from the frequencies of linear waves"
    edge = "its largest value far from the centre, over that at the centre"
    modes, sites = ("part", "mode"), np.arange(sizes.size) - problem.half_width
    numbers = {
        "_frequency": (state.frequency, (), "frequency lambda of a localised state"),
        "_gap": (np.abs(waves).min(), (), frequencies),
        "_end": (end, (), edge),
        "_growth": (growth, (), "largest rate of growth of its perturbations, per unit of tau"),
        "_exponents": (_parts(found), modes, "exponents of its perturbations, per unit of tau"),
        "_multipliers": (_parts(multipliers), modes, "Floquet multipliers of its perturbations"),
        "": (moduli, ("component", "site"), "moduli of a localised state"),
    }
    described = {f"breather{name}": variable(*given, digits=6) for name, given in numbers.items()}
    axes = {"part": ["re", "im"], "component": list(problem.model.fields), "site": sites}
    return xr.Dataset.from_dict(table(TITLE, axes, **described))


def _parts(values: np.ndarray) -> np.ndarray:
    return np.stack([values.real, values.imag])
