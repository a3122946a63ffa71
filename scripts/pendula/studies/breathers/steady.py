"""Steady states of the chain that are localised at one pair: families, and where there is none.

A steady state of (4), steady in the rotating frame of (3), obeys

    epsilon (A_{n+1} - 2 A_n + A_{n-1}) + Omega A_n + gamma (conj B_n - conj A_n)
        + |A_n|^2 A_n / 2 = 0                                                                (S)

and the same with A and B exchanged. The families of one pair (see `models.pairs`) are continued
from epsilon = 0 by what the library does with any model (`latticode.localised.breathers`).

Where there is none. Multiply (S) by conj A and its partner by conj B, sum over the chain and take
the real part:

    -epsilon (|dA|^2 + |dB|^2) + Omega P - gamma Re sum (A_n - B_n)^2
        + (1/2) sum (|A_n|^4 + |B_n|^4) = 0,

where |dA|^2 = sum |A_{n+1} - A_n|^2 <= 4 |A|^2 and |A - B|^2 <= 2 (|A|^2 + |B|^2). The left side is
at least (Omega - 4 epsilon - 2 gamma) P plus a sum of fourth powers, which is positive unless all
is zero. So for Omega >= 4 epsilon + 2 gamma no steady state but zero lies in l2, localised or not.
"""

from collections.abc import Iterator, Sequence

import numpy as np
from latticode.localised.breathers import State, coupled, exponents, flat, newton, widened

from pendula.models.pairs import Family, pair
from pendula.problem import Constants, Problem


def chain_of(family: Family, constants: Constants, half_width: int) -> Problem | None:
    """Return a chain with the family's state of one pair as data; None where there is no such."""
    ends = pair(family, constants.gamma, constants.omega)
    if ends is None:
        return None
    data = np.array(ends).reshape(2, 1) * (1j if family.imaginary else 1.0)
    return Problem(
        parameters=vars(constants), half_width=half_width, boundary="dirichlet", initial=data,
        end_time=1.0, output_step=1.0, solver={},
    )  # fmt: skip


def continued(
    family: Family, constants: Constants, half_widths: Sequence[int]
) -> Iterator[tuple[Problem, State]]:
    """Yield a family's state on each chain, or none where the pair has no such state.

    The first continues that of the pair; each other starts from the one before, on a shorter chain.
    Raises NoStateError where the family does not reach this epsilon.
    """
    state = None
    for half_width in half_widths:
        problem = chain_of(family, constants, half_width)
        if problem is None:
            return
        if state is None:
            start = State(flat(problem.amplitudes, even=True), even=True)
            state = coupled(problem, start, None)
        else:
            state = newton(problem, widened(problem, state), None)
        yield problem, state


def growth(problem: Problem, state: State) -> float:
    """Return the rate at which the worst perturbation of a state grows; 0 if none does."""
    return max(0.0, float(exponents(problem, state).real.max()))
