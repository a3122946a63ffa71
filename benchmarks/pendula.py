"""Speed against error for Newton's equations: every solver that takes them, and peers.

The peers are SciPy's DOP853, with a right-hand side in NumPy or compiled by this project, and
heyoka's Taylor method, which is given the equations with the drive as a function of time. All
follow the paper's regular cases to one t, and are compared at equal error.
"""

from collections.abc import Callable, Mapping
from functools import partial

import numpy as np
from pendula.compiled import kernel
from pendula.datasets.netcdf import Variable
from pendula.models.pendula import at_time, frequency, make_pendula, rates, times_of
from pendula.problem import Problem
from pendula.simulation.lattice import WHOLE, Reduction, choose_ends, unfold
from pendula.simulation.models import MODELS
from pendula.simulation.simulate import simulate

from .contestants import OURS, TOLERANCES, Contestant
from .peer import HALF, Peer, Solve, check
from .peers_in_python import final, needs
from .points import compare, measure_points
from .problems import error_of, until
from .timing import timed

MU, END_TIME, TARGET = 0.1, 1.0, 1e-10
"""Of the comparison: the small parameter, the slow time at the end, and the error in rad."""
AGREED = 1e-12
"""Rad by which two methods at their tightest may differ: so exact is what errors are taken from."""
STEPS = 1.6 / 2.0 ** np.arange(6)


def start_of(problem: Problem, reduction: Reduction) -> np.ndarray:
    """Return the initial state (row, 1 + site), ghosts and all."""
    return MODELS["pendula"].start(problem, reduction)


def final_of(y: np.ndarray, reduction: Reduction) -> np.ndarray:
    """Return angles and velocities (part, component, site) of a state."""
    return np.array([unfold(y[part::2, 1:-1], reduction) for part in (0, 1)])


# --- Peers ----------------------------------------------------------------------------------------


def plain_rates(t, u, coupling, strength, twice_omega):
    """Equations (1) of the vector (x, y, x', y') as most people would write them in NumPy."""
    x, y, _, _ = np.split(u, 4)
    drive = strength * np.cos(twice_omega * t)

    def force(own, other):
        wide = np.concatenate([[0], own, [0]])
        bonds = coupling * (wide[2:] - 2 * own + wide[:-2])
        return bonds + drive * (other - own) - np.sin(own)

    return np.concatenate([u[len(u) // 2 :], force(x, y), force(y, x)])


def prepare_plain(problem: Problem) -> Solve:
    """Return SciPy's DOP853 on those."""
    check(problem)
    square = problem.mu * problem.mu
    coupling, gamma = problem.constants.epsilon * square, problem.constants.gamma
    omega = frequency(problem.constants.omega, problem.mu)
    right = partial(
        plain_rates, coupling=coupling, strength=2 * gamma * square, twice_omega=2 * omega
    )
    begin = final_of(start_of(problem, WHOLE), WHOLE)
    end = float(times_of(problem.end_time, problem.mu))

    def solve(rtol):
        u, seconds = final(right, begin.ravel(), end, "DOP853", 1.0, rtol)
        return u.reshape(begin.shape), seconds

    return solve


@kernel
def flat_rates(pendula, t, flat, slope):
    """Write the right-hand side of a vector with ghosts, which stand still."""
    y, dy = flat.reshape(4, -1), slope.reshape(4, -1)
    rates(at_time(pendula, t), y, dy)
    for row in range(4):
        dy[row, 0] = dy[row, dy.shape[1] - 1] = 0.0


def prepare_compiled(problem: Problem) -> Solve:
    """Return SciPy's DOP853 on the library's state of the whole chain and its kernel."""
    check(problem)
    system = make_pendula(problem.constants, problem.mu, choose_ends("dirichlet", WHOLE))
    begin = start_of(problem, WHOLE)
    end = float(times_of(problem.end_time, problem.mu))

    def right(t, u):
        slope = np.empty_like(u)
        flat_rates(system, t, u, slope)
        return slope

    right(0.0, begin.ravel())

    def solve(rtol):
        u, seconds = final(right, begin.ravel(), end, "DOP853", 1.0, rtol)
        return final_of(u.reshape(begin.shape), WHOLE), seconds

    return solve


def equations(problem: Problem, n: int, even: bool):
    """Return [(variable, rate)] for heyoka, in the order of the rows x, x', y, y' of n sites."""
    import heyoka

    square, sin, cos = problem.mu * problem.mu, heyoka.sin, heyoka.cos
    coupling = problem.constants.epsilon * square
    phase = 2 * frequency(problem.constants.omega, problem.mu) * heyoka.time
    drive = 2 * problem.constants.gamma * square * cos(phase)
    names = [f"{row}_{site}" for row in ("x", "u", "y", "v") for site in range(n)]
    rows = np.array(heyoka.make_vars(*names), dtype=object).reshape(4, n)

    def force(x, other, j):
        before = [x[j - 1]] if j > 0 else [x[1]] if even else []
        after = [x[j + 1]] if j + 1 < n else []
        bonds = coupling * (sum(after + before) - 2.0 * x[j])
        return bonds + drive * (other[j] - x[j]) - sin(x[j])

    found = []
    for row in (0, 2):
        found += [(rows[row, j], rows[row + 1, j]) for j in range(n)]
        found += [(rows[row + 1, j], force(rows[row], rows[2 - row], j)) for j in range(n)]
    return found


def prepare_heyoka(problem: Problem, reduction: Reduction) -> Solve:
    """Return heyoka's integrator, one compiled for each tolerance outside of the measured time."""
    check(problem, reduction)
    import heyoka

    begin = start_of(problem, reduction)[:, 1:-1]
    system = equations(problem, begin.shape[1], reduction.even)
    end, compiled = float(times_of(problem.end_time, problem.mu)), {}

    def solve(rtol):
        if rtol not in compiled:
            compiled[rtol] = heyoka.taylor_adaptive(
                system, begin.ravel(), tol=rtol, compact_mode=True
            )
        integrator = compiled[rtol]
        integrator.time = 0.0
        integrator.state[:] = begin.ravel()
        outcome, seconds = timed(lambda: integrator.propagate_until(end))
        if outcome[0] != heyoka.taylor_outcome.time_limit:
            raise RuntimeError(f"heyoka gave up: {outcome[0]}")
        y = np.zeros((4, begin.shape[1] + 2))
        y[:, 1:-1] = integrator.state.reshape(4, -1)
        return final_of(y, reduction), seconds

    return solve


PEERS = {
    "scipy_dop853_numpy": Peer("SciPy DOP853, NumPy", lambda: None, prepare_plain),
    "scipy_dop853": Peer("SciPy DOP853, compiled", lambda: None, prepare_compiled),
    "heyoka_full": Peer(
        "heyoka, whole chain", needs("heyoka", "heyoka"), partial(prepare_heyoka, reduction=WHOLE)
    ),
    "heyoka_half": Peer(
        "heyoka, half chain", needs("heyoka", "heyoka"), partial(prepare_heyoka, reduction=HALF)
    ),
}


# --- The measurements -----------------------------------------------------------------------------


def prepare_kahan_li(problem: Problem) -> Solve:
    """Return the symplectic composition, by its step."""

    def solve(step):
        given = problem.changed(solver={"name": "kahan_li", "step": float(step)})
        run, seconds = timed(lambda: simulate(given))
        return run.final, seconds

    return solve


OWN = {
    **{name: OURS[name] for name in ("taylor", "dop853", "ode45")},
    "kahan_li": Contestant("kahan_li", STEPS, prepare_kahan_li),
}


def as_pendula(problem: Problem) -> Problem:
    """Return the pendula of a case of the amplitudes, up to the end of the comparison."""
    return until(problem, END_TIME, model="pendula", mu=MU)


def exact_state(problem: Problem) -> np.ndarray:
    """Return angles and velocities at the end, on which two methods agree.

    Raises RuntimeError where they do not.
    """
    tight = {"name": "taylor", "rtol": 1e-15, "atol": 1e-15}
    found = [
        simulate(problem.changed(solver=solver)).final
        for solver in (tight, {"name": "kahan_li", "step": 0.05})
    ]
    if not error_of(*found) < AGREED:
        raise RuntimeError(f"two methods differ by {error_of(*found):.1e} rad: nothing is exact")
    return found[0]


def absent() -> dict[str, str]:
    """Return why each peer that is not installed is missing."""
    return {name: reason for name, peer in PEERS.items() if (reason := peer.why_absent())}


def measure(problems: Mapping[str, Problem], say: Callable[[str], None]) -> dict[str, Variable]:
    """Return the variables of the dataset on these cases, which are of the amplitudes."""
    peers = {
        name: Contestant(peer.title, TOLERANCES, peer.prepare)
        for name, peer in PEERS.items()
        if name not in absent()
    }
    contestants, found, pairs = {**OWN, **peers}, {}, {}
    for case, given in problems.items():
        problem = as_pendula(given)
        exact = exact_state(problem)
        for contestant in OWN.values():  # what compiles now is not timed
            contestant.prepare(until(problem, 1e-3))(contestant.accuracies[0])
        for name, contestant in contestants.items():
            say(f"{case}: {contestant.title}")
            goal = 0.0 if name in OWN else 0.3 * TARGET
            found[case, name] = measure_points(contestant, problem, exact, goal)
        own = {name: (contestant, found[case, name]) for name, contestant in OWN.items()}
        for name, peer in peers.items():
            pairs[case, name] = compare(problem, TARGET, (peer, found[case, name]), own)
    return {
        "case": Variable(("case",), list(problems)),
        "contestant": Variable(("contestant",), list(contestants), "solver or peer"),
        "title": Variable(
            ("contestant",), [one.title for one in contestants.values()], "its name in tables"
        ),
        "peer": Variable(("peer",), list(peers), "peer"),
        **_by_point(found, list(problems), list(contestants)),
        **_by_pair(pairs, list(problems), list(peers)),
    }


def _by_point(found, cases: list[str], names: list[str]) -> dict[str, Variable]:
    most = max(map(len, found.values()))
    table = np.full((len(cases), len(names), most, 3), np.nan)
    for i, case in enumerate(cases):
        for j, name in enumerate(names):
            for k, point in enumerate(found[case, name]):
                table[i, j, k] = point.accuracy, point.seconds, point.error
    grid = ("case", "contestant", "point")
    return {
        "accuracy": Variable(grid, table[..., 0], "tolerance or step that was asked for"),
        "seconds": Variable(grid, table[..., 1], "median time of a run without outputs", "s"),
        "error": Variable(
            grid, table[..., 2], "error of an angle or a velocity, the largest", "rad"
        ),
    }


def _by_pair(pairs, cases: list[str], peers: list[str]) -> dict[str, Variable]:
    table = np.full((len(cases), len(peers), 3), np.nan)
    for i, case in enumerate(cases):
        for j, name in enumerate(peers):
            pair = pairs[case, name]
            if pair is not None:
                table[i, j] = np.median(pair.ratios), pair.ratios.min(), pair.ratios.max()
    grid, ratio = ("case", "peer"), "time of the peer over that of our best solver"
    return {
        "ratio": Variable(grid, table[..., 0], f"{ratio}, median of pairs"),
        "ratio_least": Variable(grid, table[..., 1], "least ratio of a pair"),
        "ratio_most": Variable(grid, table[..., 2], "largest ratio of a pair"),
    }
