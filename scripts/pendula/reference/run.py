"""One multiprecision run of a case."""

from typing import NamedTuple

import numpy as np

from ..simulation import IntegrationError, output_times
from .half_chain import Constants, energy, norms, right_hand_side
from .numbers import Numbers


class Run(NamedTuple):
    """What is kept of a run, in multiprecision; components are A, B and sites 0..M."""

    tau: np.ndarray  # (time,), doubles
    linf: np.ndarray  # (component, time)
    l2: np.ndarray  # (component, time)
    energy: np.ndarray  # (time,)
    amplitude: np.ndarray  # (snapshot, row, site), rows Re A, Im A, Re B, Im B
    bits: int
    order: int
    tolerance: float
    steps: int


def start(problem: dict, numbers: Numbers) -> np.ndarray:
    """Return the initial state (row, site) of the half chain 0..M, in multiprecision.

    Raises ValueError where the data are not even, or the ends are not at rest.
    """
    initial = problem["initial"]
    if problem["boundary"] != "dirichlet":
        raise ValueError(f"the reference has Dirichlet ends only, not {problem['boundary']}")
    if any(initial.get(-site) != pair for site, pair in initial.items()):
        raise ValueError("the reference integrates half a chain: its data must be even")
    state = numbers.exactly(np.zeros((4, problem["half_width"] + 1)))
    for site, (a, b) in initial.items():
        parts = [part for z in (complex(a), complex(b)) for part in (z.real, z.imag)]
        for row, part in enumerate(parts):
            state[row, abs(site)] = numbers.given(part)
    return state


def integrate(problem: dict, snapshots: list[float], bits: int, decimal: bool = True) -> Run:
    """Integrate a case with `bits` bits and a tolerance of half a unit in their last place.

    `problem` holds the arguments of pendula.simulation.simulate; the solver is not used. Outputs
    are at the doubles that `output_times` returns. `decimal` is explained by Numbers. Raises
    IntegrationError where heyoka does not reach the end, ValueError as `start` does.
    """
    numbers = Numbers(bits, decimal)
    constants = Constants(*(numbers.given(problem[key]) for key in Constants._fields))
    state = start(problem, numbers)
    times = output_times(problem["end_time"], problem["output_step"])
    stepper = numbers.heyoka.taylor_adaptive(
        right_hand_side(numbers.heyoka, constants, problem["half_width"]),
        state.ravel(),
        time=numbers.exact(0.0),
        fp_type=numbers.heyoka.real,
        prec=bits,
        compact_mode=True,  # else the functions it compiles are far too long
        tol=numbers.exact(2.0**-bits),
    )
    outcome, _, _, steps, _, states = stepper.propagate_grid(numbers.exactly(times))
    if outcome != numbers.heyoka.taylor_outcome.time_limit:
        raise IntegrationError(f"heyoka stopped at tau = {float(stepper.time):.6g}: {outcome}")
    states = states.reshape(-1, *state.shape)
    kept = states[[round(tau / problem["output_step"]) for tau in snapshots]]
    return Run(
        times,
        *norms(states),
        energy(constants, states),
        kept,
        bits,
        stepper.order,
        2.0**-bits,
        steps,
    )
