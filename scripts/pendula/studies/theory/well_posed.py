"""Checks of Lemma 2 on runs: solutions exist for all times, and depend continuously on the data.

Runs cannot prove the lemma, but they could contradict it: by a norm that grows faster than (19)
allows, by two solutions from one initial condition, or by a distance between two solutions that
does not shrink with the initial distance.
"""

from itertools import product

import numpy as np
from latticode.datasets.checks import columns, table, variable
from latticode.measures.norms import power_of
from latticode.numerics.draws import complex_normal
from latticode.numerics.elementary import log

from pendula.models.bounds import growth_margin
from pendula.problem import Constants

from .equations import ENDS, constants_at, controls_of, random_amplitudes, run

OMEGAS, POWERS, COURSES = [-4.0, 0.0, 8.0], [1.0, 26.0, 1000.0], ["forward", "backward"]
"""Omega of the paper's figures; P(0), which is 26 for the paper's large data; directions of
time."""
DIRECTIONS, SIZES = ["A alone", "one pair", "all sites"], [1e-4, 1e-6, 1e-8]
"""Which amplitudes are perturbed, and the sizes of perturbations relative to the norm."""
SITES, SEED = 21, 11
END_TIME, CLOSE_TIME, OUTPUTS = 10.0, 1.0, 400
"""Distances are measured at CLOSE_TIME, before chaos amplifies small ones to order one."""
SOLVER = {"name": "taylor", "rtol": 1e-13, "atol": 1e-13}
SECOND = {"name": "dop853", "rtol": 1e-12, "atol": 1e-12}


def start_of(power: float, course: str) -> np.ndarray:
    """Return random amplitudes (2, N) with P = |A|^2 + |B|^2 = `power`.

    For backward runs they are conjugate: a forward run from conjugate data is the conjugate of the
    backward run from the data.
    """
    amplitudes = np.sqrt(power) * random_amplitudes(SEED, SITES)
    return amplitudes.conj() if course == "backward" else amplitudes


def perturbed(amplitudes: np.ndarray, direction: str, size: float) -> np.ndarray:
    """Return the amplitudes plus a random change with `size` times their norm."""
    change = complex_normal(np.random.default_rng([SEED, DIRECTIONS.index(direction)]), (2, SITES))
    if direction == "A alone":
        change[1] = 0.0
    elif direction == "one pair":
        change[:, np.arange(SITES) != SITES // 2] = 0.0
    return amplitudes + size * np.sqrt(power_of(amplitudes) / power_of(change)) * change


def distance_of(first: np.ndarray, second: np.ndarray) -> float:
    """Return the l2 distance of two states."""
    return float(np.sqrt(power_of(first - second)))


def margins(constants: Constants, start: np.ndarray, gamma: float) -> dict[str, float]:
    """Return the largest ratios of a run's growth to the bound (19) for the drive `gamma`."""
    trajectory = run(constants, ENDS, start, END_TIME, OUTPUTS, solver=SOLVER)
    return growth_margin(trajectory.tau, trajectory.l2, gamma)


def dependence(constants: Constants, start: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the factors by which distances of perturbed runs grow until CLOSE_TIME, and rates.

    Both are (direction, size). A rate is the logarithm of a factor divided by its bound
    (2 |gamma| + M^2 / 2) tau, where M is the largest amplitude.
    """
    first = run(constants, ENDS, start, CLOSE_TIME, OUTPUTS, solver=SOLVER)
    ratios = np.empty((len(DIRECTIONS), len(SIZES)))
    allowed = np.empty_like(ratios)
    for place, (direction, size) in zip(
        np.ndindex(ratios.shape), product(DIRECTIONS, SIZES), strict=True
    ):
        near = perturbed(start, direction, size)
        second = run(constants, ENDS, near, CLOSE_TIME, OUTPUTS, solver=SOLVER)
        ratios[place] = distance_of(first.final, second.final) / distance_of(start, near)
        peak = max(first.linf.max(), second.linf.max())
        allowed[place] = (2.0 * abs(constants.gamma) + 0.5 * peak * peak) * CLOSE_TIME
    return ratios, log(ratios) / allowed


def between_solvers(constants: Constants, start: np.ndarray) -> float:
    """Return the distance at CLOSE_TIME between two solvers' runs, relative to the initial norm."""
    ends = [
        run(constants, ENDS, start, CLOSE_TIME, solver=solver).final for solver in (SOLVER, SECOND)
    ]
    return distance_of(*ends) / float(np.sqrt(power_of(start)))


def check_well_posed() -> dict:
    """Return the table of runs from random data of several sizes, in both directions of time."""
    cells = [
        (constants_at(omega), start_of(power, course))
        for omega, power, course in product(OMEGAS, POWERS, COURSES)
    ]
    over = {"omega": OMEGAS, "initial_power": POWERS, "course": COURSES}
    shape = tuple(map(len, over.values()))
    right = [margins(constants, start, constants.gamma) for constants, start in cells]
    wrong = [
        margins(constants_at(constants.omega, 2.0), start, constants.gamma)
        for constants, start in cells
    ]
    numbers = {
        "from_start": [margin["from_start"] for margin in right],
        "steepest": [margin["steepest"] for margin in right],
        "steepest_of_twice_the_drive": [margin["steepest"] for margin in wrong],
        "between_solvers": [between_solvers(*cell) for cell in cells],
    }
    labels = {
        "from_start": "largest P over the bound (19)",
        "steepest": "largest change of log P over 4 gamma times its duration",
        "steepest_of_twice_the_drive": "the same for runs under twice the drive of the bound",
        "between_solvers": "distance between two solvers' solutions, relative to the initial norm",
    }
    ratios, rates = zip(*(dependence(*cell) for cell in cells), strict=True)
    near = {"direction": DIRECTIONS, "perturbation_size": SIZES}
    distances = {
        "distance_ratio": (ratios, "distance between two solutions, divided by its initial value"),
        "rate": (rates, "growth of the log of the distance, divided by (2 gamma + M^2 / 2) tau"),
    }
    data = table(
        f"Solutions from random initial conditions on {SITES} sites, and others close to them",
        over | near,
        **columns(
            over, labels, {name: np.reshape(values, shape) for name, values in numbers.items()}
        ),
        **{
            name: variable(np.reshape(values, (*shape, *ratios[0].shape)), (*over, *near), label)
            for name, (values, label) in distances.items()
        },
    )
    data["attrs"] |= {**controls_of(SOLVER), "end_time": END_TIME, "close_time": CLOSE_TIME}
    return data | {"attrs": data["attrs"] | {"seed": SEED, "gamma": constants_at(0.0).gamma}}
