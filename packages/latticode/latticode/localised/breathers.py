"""Localised states of a traced model, steady or rotating in phase, and their stability.

If the equations have a global phase symmetry, the state is u_n(tau) = phi_n exp(-i lambda tau) with
the power P of the initial data:

    F(phi) + i lambda phi = nu phi,    |phi|^2 = P,

where F are the rates of the model. The unknown nu must vanish, otherwise the state would grow or
decay. Other models have a steady state, F(phi) = 0. Without coupling the state occupies the site
with the largest initial data. The coupling is then turned on in steps, and Newton's method follows
the state (R. S. MacKay and S. Aubry, Nonlinearity 7 (1994) 1623).

In the frame that rotates with the state, perturbations grow as exp(mu tau) with the eigenvalues mu
of the derivative of F + i lambda. Floquet multipliers are exp(2 pi mu / abs(lambda)).

A state that is even in n is computed on the sites 0..M. Its even and odd perturbations then have
separate matrices. In reversible equations around a real state, real parts (or values) drive only
imaginary parts (or rates) and vice versa; mu^2 are then the eigenvalues of a matrix of half the
size. LAPACK's last digits depend on the machine, so published results must be rounded.
"""

from typing import NamedTuple

import numpy as np

from latticode.numerics.elementary import square_modulus
from latticode.simulation.problem import Problem
from latticode.simulation.traced import TracedEquations

from .linearised import EVEN, ODD, linearise

MOST_UNKNOWNS = 1000
"""Largest size of a matrix; the eigenvalues of a larger one take more than a minute."""
TOLERANCE, ITERATIONS = 1e-13, 30
"""Newton's method stops at rates below TOLERANCE times the largest slope times the largest value,
and fails after ITERATIONS steps."""
FIRST_STEP, SMALLEST_STEP, LARGEST_CHANGE = 1 / 8, 1 / 4096, 0.2
"""First and smallest step of the coupling; largest change of a state in one step, relative to the
largest value of the state. A larger change may lead to a different family of states."""
DAMPING = 1e-12
"""Damping of Newton's method (Levenberg), relative to the largest squared slope."""
NOISE = 1e-5
"""Accuracy of exponents. A double exponent, such as 0 for a phase shift, loses half the digits."""


class NoStateError(ArithmeticError):
    """No localised state was found; the message gives the reason."""


class LocalisedState(NamedTuple):
    """A localised state phi as a flat real array x, rotating as exp(-i frequency tau) or steady.

    x is (row, site), flattened: the rows are the real and imaginary parts of each field, or its
    value and its rate.
    """

    x: np.ndarray
    frequency: float = 0.0
    growth: float = 0.0  # nu in the equation of the module
    even: bool = False  # whether x has only the sites 0..M

    @property
    def parity(self) -> int | None:
        """The argument `parity` of `linearise`: EVEN for a state on the sites 0..M, else None."""
        return EVEN if self.even else None

    def components(self, problem: Problem) -> np.ndarray:
        """Return the state on the sites -M..M, (field, part, site)."""
        fields = self.x.reshape(len(problem.model.fields), 2, -1)
        return np.concatenate([fields[..., :0:-1], fields], axis=2) if self.even else fields

    def weights(self, problem: Problem) -> np.ndarray:
        """Return the number of sites of the whole chain that each entry of x represents."""
        count = 2 * len(problem.model.fields)
        sites = np.full(self.x.size // count, 2.0 if self.even else 1.0)
        sites[0] = 1.0
        return np.tile(sites, count)


def flat(fields: np.ndarray, even: bool = False) -> np.ndarray:
    """Return complex fields (field, site) as a flat real state, on the sites 0..M if `even`."""
    half = fields[:, fields.shape[1] // 2 :] if even else fields
    return np.stack([half.real, half.imag], axis=1).ravel()


def widened(problem: Problem, state: LocalisedState) -> LocalisedState:
    """Return an even state padded with zeros to the longer chain of `problem`."""
    rows = state.x.reshape(2 * len(problem.model.fields), -1)
    more = problem.half_width + 1 - rows.shape[1]
    return state._replace(x=np.pad(rows, [(0, 0), (0, more)]).ravel())


def turning(problem: Problem, size: int) -> np.ndarray:
    """Return the matrix that multiplies all fields by i, for a flat state with `size` entries."""
    fields = len(problem.model.fields)
    one_field = np.kron([[0.0, -1.0], [1.0, 0.0]], np.eye(size // (2 * fields)))
    return np.kron(np.eye(fields), one_field)


def can_turn(problem: Problem) -> bool:
    """Return whether the equations have a global phase symmetry.

    The test compares the rates of one random state before and after a rotation of the phase.
    """
    if problem.model.real:
        return False
    turn = turning(problem, 2 * problem.amplitudes.size)
    x = np.random.default_rng(1).normal(size=len(turn))
    rates, after = (linearise(problem, state)[0] for state in (x, 0.6 * x + 0.8 * (turn @ x)))
    expected = 0.6 * rates + 0.8 * (turn @ rates)
    return bool(np.abs(after - expected).max() <= 1e-10 * np.abs(expected).max())


def newton(
    problem: Problem, state: LocalisedState, power: float | None, coupling: float = 1.0
) -> LocalisedState:
    """Return the state to which Newton's method converges from `state`.

    The state has the given `power`, or is steady if `power` is None. `coupling` is the fraction of
    the full coupling between sites. Raises NoStateError if the method does not converge.
    """
    turn, weights, least = turning(problem, state.x.size), state.weights(problem), np.inf
    for _ in range(ITERATIONS):
        x = state.x
        rates, matrix = linearise(problem, x, coupling, state.parity)
        scale = np.abs(matrix).max() * np.abs(x).max()
        if power is not None:
            frame = state.frequency * turn - state.growth * np.eye(x.size)
            rates = np.append(rates + frame @ x, weights * x @ x - power)
            slopes = np.column_stack([matrix + frame, turn @ x, -x])
            matrix = np.vstack([slopes, np.append(2.0 * weights * x, (0.0, 0.0))])
        left = np.abs(rates).max() / scale if scale > 0.0 else np.inf
        if not np.isfinite(left):
            break
        if left <= TOLERANCE and left >= 0.5 * least:  # converged, and no longer improving
            return state
        least = min(left, least)
        change = least_change(matrix, rates)
        more = change[x.size :] if power is not None else (0.0, 0.0)
        state = LocalisedState(
            x + change[: x.size], state.frequency + more[0], state.growth + more[1], state.even
        )
    raise NoStateError("Newton's method does not converge")


def least_change(matrix: np.ndarray, rates: np.ndarray) -> np.ndarray:
    """Return the least-squares solution with the smallest norm of matrix @ change = -rates.

    The solution is not unique where the phase or the position of the state is free. Damping selects
    the smallest solution (K. Levenberg, Quart. Appl. Math. 2 (1944) 164).
    """
    normal = matrix.T @ matrix
    normal[np.diag_indices_from(normal)] += DAMPING * np.abs(normal).max()
    return -np.linalg.solve(normal, matrix.T @ rates)


def find_state(problem: Problem) -> LocalisedState:
    """Return the localised state at the site with the largest initial data, at full coupling.

    Raises NoStateError with the reason if there is none.
    """
    data, even = problem.amplitudes, TracedEquations(problem).find_reduction().even
    if problem.model.driven:
        raise NoStateError("the equations depend on time")
    if problem.model.matrices:
        raise NoStateError("models with a coupling matrix are not supported")
    if not data.any():
        raise NoStateError("the chain is at rest")
    if flat(data, even).size > MOST_UNKNOWNS:
        most = MOST_UNKNOWNS // (2 * len(data))
        raise NoStateError(f"the chain has {problem.sites} sites; give at most {most}")
    if linearise(problem, flat(0.0 * data))[0].any():
        raise NoStateError("rest does not solve the equations, so no state can decay to it")
    try:
        state, power = uncoupled(problem, even)
    except NoStateError:
        raise NoStateError(
            "a single uncoupled site has no such state near the data; change the data"
        ) from None
    return coupled(problem, state, power)


def uncoupled(problem: Problem, even: bool) -> tuple[LocalisedState, float | None]:
    """Return the uncoupled state at the site with the largest data, and its power, None if steady.

    Newton's method starts from the data at this site, scaled to the power of the whole chain.
    """
    data = problem.amplitudes
    sizes = np.sum(square_modulus(data), axis=0)
    state = LocalisedState(flat(np.where(sizes == sizes.max(), data, 0.0), even), even=even)
    if not can_turn(problem):
        return newton(problem, state, None, coupling=0.0), None
    power, weights = float(np.sum(sizes)), state.weights(problem)
    x = state.x * np.sqrt(power / (weights * state.x @ state.x))
    rates = weights * linearise(problem, x, 0.0, state.parity)[0]
    turn = turning(problem, x.size)
    start = LocalisedState(x, -(turn @ x) @ rates / power, x @ rates / power, even)
    return newton(problem, start, power, coupling=0.0), power


def coupled(problem: Problem, state: LocalisedState, power: float | None) -> LocalisedState:
    """Return `state` continued from zero to full coupling; raises NoStateError if this fails."""
    reached, step = 0.0, FIRST_STEP
    while reached < 1.0:
        target = min(1.0, reached + step)
        try:
            converged = newton(problem, state, power, target)
            near = np.abs(converged.x - state.x).max() <= LARGEST_CHANGE * np.abs(state.x).max()
        except NoStateError:
            near = False
        if near:
            state, reached, step = converged, target, 2.0 * step
        elif step > SMALLEST_STEP:
            step *= 0.5
        else:
            raise NoStateError(f"continuation fails at {reached:.3g} of the coupling")
    if abs(state.growth) > NOISE:
        change = "grow" if state.growth > 0.0 else "decay"
        raise NoStateError(f"its power would {change} at the rate {2.0 * abs(state.growth):.3g}")
    return state


def exponents(problem: Problem, state: LocalisedState) -> np.ndarray:
    """Return the sorted complex exponents mu of perturbations, per unit of tau, to 9 decimals."""
    rates = []
    for parity in (EVEN, ODD) if state.even else (None,):
        matrix = linearise(problem, state.x, parity=parity)[1]
        matrix += state.frequency * turning(problem, len(matrix))
        if problem.model.form == "dt":  # the second row of a field is always zero
            rates.append(np.linalg.eigvals(_values_alone(matrix, len(problem.model.fields))))
        else:
            rates.append(_eigenvalues(matrix, len(problem.model.fields)))
    values = np.concatenate(rates)
    real, imaginary = (np.where(np.abs(x) < NOISE, 0.0, x) for x in (values.real, values.imag))
    return np.sort_complex(np.round(real, 9) + 1j * np.round(imaginary, 9))


def _values_alone(matrix: np.ndarray, fields: int) -> np.ndarray:
    """Return the submatrix of the fields' values, without the rows and columns of their rates."""
    half = len(matrix) // 2
    blocks = matrix.reshape(fields, 2, half // fields, fields, 2, half // fields)
    return blocks[:, 0, :, :, 0].reshape(half, half)


def _eigenvalues(matrix: np.ndarray, fields: int) -> np.ndarray:
    blocks = matrix.reshape(fields, 2, -1, fields, 2, matrix.shape[0] // (2 * fields))
    if blocks[:, 0, :, :, 0].any() or blocks[:, 1, :, :, 1].any():
        return np.linalg.eigvals(matrix).astype(complex)
    half = len(matrix) // 2
    first, second = (blocks[:, i, :, :, 1 - i].reshape(half, half) for i in (0, 1))
    squares = np.linalg.eigvals(first @ second).astype(complex)
    squares[np.abs(squares) < NOISE**2] = 0.0
    roots = np.sqrt(squares)
    return np.concatenate([roots, -roots])
