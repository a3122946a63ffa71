"""Steady states of the chain that are localised at one pair, and parameters without such states.

A state of (4) that is steady in the rotating frame of (3) obeys

    epsilon (A_{n+1} - 2 A_n + A_{n-1}) + Omega A_n + gamma (conj B_n - conj A_n)
        + |A_n|^2 A_n / 2 = 0                                                                (S)

and the same with A and B exchanged. The families of one pair (see `pairs`) are continued from
epsilon = 0 by the library's method for any model (`latticode.localised.breathers`).

Parameters without steady states: multiply (S) by conj A and its partner by conj B, sum over the
chain and take the real part:

    -epsilon (|dA|^2 + |dB|^2) + Omega P - gamma Re sum (A_n - B_n)^2
        + (1/2) sum (|A_n|^4 + |B_n|^4) = 0,

where |dA|^2 = sum |A_{n+1} - A_n|^2 <= 4 |A|^2 and |A - B|^2 <= 2 (|A|^2 + |B|^2). The left side is
at least (Omega - 4 epsilon - 2 gamma) P plus a sum of fourth powers, which is positive unless all
is zero. So for Omega >= 4 epsilon + 2 gamma the only steady state in l2 is zero.
"""

import numpy as np
from latticode.localised.breathers import (
    LocalisedState,
    NoStateError,
    coupled,
    flat,
    newton,
    widened,
)

from pendula.problem import Constants, PaperProblem

from .pairs import Family, pair

SHORT = 8
"""Half-width of the short chain on which a state is continued, before the full chain is solved."""


def localised(
    family: Family, constants: Constants, half_width: int
) -> tuple[PaperProblem, LocalisedState]:
    """Return a problem on the full chain, and its steady state of a family, even in n.

    Raises NoStateError if a pair has no such state, or if continuation ends before this epsilon.
    """
    ends = pair(family, constants.gamma, constants.omega)
    if ends is None:
        raise NoStateError(f"a pair has no state {family.name} at Omega = {constants.omega:g}")
    data = np.array(ends).reshape(2, 1) * (1j if family.imaginary else 1.0)
    problem = PaperProblem(
        parameters=vars(constants),
        half_width=min(SHORT, half_width),
        boundary="dirichlet",
        initial=data,
        end_time=1.0,
        output_step=1.0,
        solver={},
    )
    state = coupled(problem, LocalisedState(flat(problem.amplitudes, even=True), even=True), None)
    problem = problem.changed(half_width=half_width)
    return problem, newton(problem, widened(problem, state), None)
