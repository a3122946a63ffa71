"""Whether a small A + B grows on the chaotic chain with A = -B, and at which speed it spreads.

To first order in S = (A + B) / sqrt 2, D = (A - B) / sqrt 2 moves alone behind the first front, and
S obeys a linear equation with D in its coefficients. Seen at a site that moves at a velocity v,
|S| grows as exp(lambda(v) tau). S spreads at the velocity at which lambda vanishes, as errors do in
chaotic media (Cencini and Torcini, Phys. Rev. E 63 (2001) 056201): that is the predicted speed of
the second front. It is the first front's where lambda is positive up to there.

The equations are those of `sums`, with S so small that its squares are lost in rounding errors.
"""

from functools import partial

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.datasets.trajectories import Contents
from latticode.measures.confidence import mean_limits
from latticode.measures.spreading import lay_line
from latticode.numerics.elementary import log
from latticode.simulation.runs import Run

from pendula.problem import Problem

from .active_sites import PIECE, advance, begin, is_even, piece_times, right_half, widen
from .front import linear_front
from .long_runs import attributes, members_of
from .sums import in_sums

SMALL = 1e-20
"""The largest |S| after each piece."""

VELOCITIES, NEAR = 32, 8
"""Parts into which velocities up to the first front's are cut, and the sites to each side of which
the largest |S| is taken: it vanishes here and there."""

LATE = 0.5
"""The part of a run, at its end, over which growth is measured. By a factor below e it is no
exponential growth that could be told from a power of tau: then no second front is predicted."""


def solve_transverse(
    name: str, problems: list[Problem], rest: float, members: int, perturbation: float, seed: int,
    run: Run,
) -> Contents:  # fmt: skip
    """Return the exponents of small S over the velocity, and the speed at which it spreads."""
    ensemble = {"members": members, "perturbation": perturbation, "seed": seed}
    fronts = [linear_front(problem.constants).speed for problem in problems]
    found = run(members_of(problems, **ensemble), partial(exponents_of, rest=rest))
    exponents = found["exponents"].reshape(len(problems), members, -1)
    means = mean_limits(np.swapaxes(exponents, 0, 1))
    least = 1.0 / (LATE * problems[0].end_time)
    crossings = mean_limits(np.transpose([
        [crossing_of(one, least) for one in of_members] for of_members in exponents
    ]))  # fmt: skip
    limits = "half of the 95 % limits of the mean over members"
    exponent = "exponent of |A + B| at a site that moves at this velocity, on the chain with A = -B"
    speeds = np.array(fronts)
    second = np.array([crossing_of(one, least) for one in means.value]) * speeds
    variables = {
        "omega": Variable(("omega",), [one.constants.omega for one in problems]),
        "velocity": Variable(("velocity",), velocities(), "velocity over that of the first front"),
        "exponent": Variable(("omega", "velocity"), means.value, exponent),
        "exponent_error": Variable(("omega", "velocity"), means.half, limits),
        "second_speed": Variable(
            ("omega",), second, "predicted speed of the second front, sites per unit of tau"
        ),
        "second_speed_error": Variable(
            ("omega",),
            np.where(second > 0.0, crossings.half * speeds, np.nan),
            f"{limits}; NaN: no second front is predicted",
        ),
    }
    title = "Growth of a small A + B on the infinite chain with A = -B"
    return variables, attributes(title, name, problems, rest, **ensemble)


def velocities() -> np.ndarray:
    """Return the velocities of the exponents, over that of the first front."""
    return np.arange(VELOCITIES) / VELOCITIES


def exponents_of(problem: Problem, rest: float) -> dict[str, np.ndarray]:
    """Return the exponent of |S| at each velocity, (velocity,), from S = D at tau = 0."""
    (a, b), front_speed = problem.initial, linear_front(problem.constants).speed
    even, rooms = is_even(problem.initial), {}
    own = in_sums(problem.changed(initial=0.5 * np.array([a - b, b - a])))
    own = own.changed(initial=np.array([SMALL * own.initial[1], own.initial[1]]))
    state, grown, logs = begin(own.initial), 0.0, []
    pieces = round(problem.end_time / PIECE)
    for piece in range(pieces):
        state = widen(state, None, rest, even)
        times = piece_times(problem, piece)
        advance(own, state, times, rooms, even)
        sizes = np.abs(right_half(state, even)[:2]).max(axis=0)  # squares would underflow
        largest = sizes.max()
        state[:2] *= SMALL / largest
        grown += float(log(largest / SMALL))
        if piece >= LATE * pieces:
            places = (velocities() * front_speed * times[-1]).astype(int)
            nearby = [sizes[max(0, at - NEAR) : at + NEAR + 1].max() for at in places]
            logs.append(log(np.maximum(nearby, np.finfo(float).tiny) / largest) + grown)
    late = PIECE * np.arange(len(logs))
    return {"exponents": np.array([lay_line(late, one).slope for one in np.transpose(logs)])}


def crossing_of(exponents: np.ndarray, least: float) -> float:
    """Return the velocity from which on exponents (velocity,) are negative, over the first front's.

    It is interpolated: one if the last is not negative, and zero if none is above `least`.
    """
    if not exponents.max() > least:
        return 0.0
    here = np.flatnonzero(exponents > 0.0)[-1]
    if here == exponents.size - 1:
        return 1.0
    high, low = exponents[here], exponents[here + 1]
    return float((here + high / (high - low)) / VELOCITIES)
