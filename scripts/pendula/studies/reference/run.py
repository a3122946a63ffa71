"""One multiprecision run of a case."""

from typing import NamedTuple

import numpy as np

from pendula.problem import Problem, by_site
from pendula.simulation.simulate import IntegrationError

from .half_chain import Constants, energy, norms, right_hand_side
from .numbers import Numbers


class Run(NamedTuple):
    """What is kept of a run, in multiprecision; components are A, B and sites 0..M."""

    tau: np.ndarray  # (time,), doubles
    linf: np.ndarray  # (component, time)
    l2: np.ndarray  # (component, time)
    energy: np.ndarray  # (time,)
    snapshot_tau: np.ndarray  # (snapshot,), doubles
    amplitude: np.ndarray  # (snapshot, row, site), rows Re A, Im A, Re B, Im B
    bits: int
    order: int
    tolerance: float
    steps: int


def start(problem: Problem, numbers: Numbers) -> np.ndarray:
    """Return the initial state (row, site) of the half chain 0..M, in multiprecision.

    Raises ValueError where the data are not even, or the ends are not at rest.
    """
    if problem.boundary != "dirichlet":
        raise ValueError(f"the reference has Dirichlet ends only, not {problem.boundary}")
    if not np.array_equal(problem.initial, problem.initial[:, ::-1]):
        raise ValueError("the reference integrates half a chain: its data must be even")
    state = numbers.exactly(np.zeros((4, problem.half_width + 1)))
    for site, (a, b) in by_site(problem.initial).items():
        parts = [part for z in (complex(a), complex(b)) for part in (z.real, z.imag)]
        for row, part in enumerate(parts):
            state[row, abs(site)] = numbers.given(part)
    return state


def integrate(problem: Problem, snapshots: list[float], bits: int, decimal: bool = True) -> Run:
    """Integrate a case with `bits` bits, and a tolerance of 2^-bits.

    The problem's own solver is not used. Outputs are at the doubles `problem.times`; those
    among `snapshots` keep the state. `decimal` is explained by Numbers. Raises IntegrationError
    where heyoka does not reach the end, ValueError as `start` does.
    """
    numbers = Numbers(bits, decimal)
    given = problem.constants
    constants = Constants(*(numbers.given(getattr(given, key)) for key in Constants._fields))
    times = problem.times
    kept = np.isin(times, snapshots)
    stepper = _stepper(numbers, constants, start(problem, numbers))
    outcome, _, _, steps, _, states = stepper.propagate_grid(numbers.exactly(times))
    if outcome != numbers.heyoka.taylor_outcome.time_limit:
        raise IntegrationError(f"heyoka stopped at tau = {float(stepper.time):.6g}: {outcome}")
    states = states.reshape(len(times), 4, -1)
    energies = energy(constants, states)
    observed = (times, *norms(states), energies, times[kept], states[kept])
    return Run(*observed, bits, stepper.order, float(stepper.tol), steps)


def _stepper(numbers: Numbers, constants: Constants, state: np.ndarray):
    """Return heyoka's adaptive Taylor method, which chooses its order from the tolerance."""
    return numbers.heyoka.taylor_adaptive(
        right_hand_side(numbers.heyoka, constants, state.shape[1] - 1),
        state.ravel(),
        time=numbers.exact(0.0),
        fp_type=numbers.heyoka.real,
        prec=numbers.bits,
        tol=numbers.exact(2.0**-numbers.bits),
        compact_mode=True,  # else it compiles every site by itself, for minutes
    )
