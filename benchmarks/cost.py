"""The cost of a run against the length of the chain: time per site and step, and peers."""

from itertools import product

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.simulation.simulate import simulate
from pendula.problem import Constants, PaperProblem

from .contestants import PEERS, controls
from .timing import in_turns, timed

SITES = (3, 11, 61, 121, 241, 401, 1001, 10_001, 100_001, 1_000_001)
SOLVERS = ("dop853", "taylor")
TOLERANCE = 1e-10
WORK = 40_000
"""Number of sites times end time of a run: short chains run long enough to be timed."""
SHORTEST = 1.5
"""Least end time of a run: so many steps that its preparation hardly counts."""
ROUNDS = 7
"""Rounds over all chains: processors change their speed within seconds, and a median over rounds
does not depend on when that happens."""

PEERS_OF_ONE_PAIR = ("heyoka_half", "cpp_taylor_eight", "cpp_taylor_eight_rest")
LENGTHS = (61, 241, 401, 1001)
"""Numbers of sites on which peers run from one excited pair."""
PEERS_END, TURNS, BLOCK = 10.0, 7, 0.02
"""End time of these runs, number of pairs, and shortest time in s of one side of a pair."""

CONSTANTS = Constants(epsilon=1.0, gamma=1.0, omega=0.0)


def measure() -> dict[str, Variable]:
    """Return the variables of the dataset: the median time over (start, sites, solver)."""
    chains = product(STARTS.values(), SITES, SOLVERS)
    problems = [start(sites, solver) for start, sites, solver in chains]
    steps = [simulate(problem).outcome.steps for problem in problems]  # compiles
    rounds = [[timed(lambda p=p: simulate(p))[1] for p in problems] for _ in range(ROUNDS)]
    counts = np.array(steps) * [problem.sites for problem in problems]
    seconds = np.median(rounds, axis=0) / counts
    seconds = seconds.reshape(len(STARTS), len(SITES), len(SOLVERS))
    return {
        "start": Variable(("start",), np.array(list(STARTS)), "which sites move from the start"),
        "sites": Variable(("sites",), np.array(SITES)),
        "solver": Variable(("solver",), np.array(SOLVERS)),
        "seconds": Variable(("start", "sites", "solver"), seconds, "time per site and step", "s"),
        **measure_peers(),
    }


def measure_peers() -> dict[str, Variable]:
    """Return the time of installed peers over that of `taylor`, (peer, length), from one pair."""
    names = [name for name in PEERS_OF_ONE_PAIR if not PEERS[name].why_absent()]
    titles = [PEERS[name].title for name in names]
    ratios = [[time_ratio(name, sites) for sites in LENGTHS] for name in names]
    shape = len(names), len(LENGTHS)
    return {
        "peer": Variable(("peer",), np.array(names, str), "integrator by others"),
        "length": Variable(("length",), np.array(LENGTHS), "number of sites"),
        "title": Variable(("peer",), np.array(titles, str), "name of the peer"),
        "ratio": Variable(
            ("peer", "length"), np.reshape(ratios, shape), "time of the peer over that of taylor"
        ),
    }


def time_ratio(peer: str, sites: int) -> float:
    """Return the time of a peer over that of `taylor` at the same tolerance, from one pair."""
    problem = quiet_chain(sites, "taylor").changed(end_time=PEERS_END, output_step=PEERS_END)
    solve = PEERS[peer].prepare(problem)
    ratios = in_turns(
        lambda: solve(TOLERANCE)[1], lambda: timed(lambda: simulate(problem))[1], TURNS, BLOCK
    )
    return float(np.median(ratios))


def noisy_chain(sites: int, name: str) -> PaperProblem:
    """Return a problem with even amplitudes of order one: every site moves from the start."""
    rng = np.random.default_rng(0)
    half = rng.normal(size=(2, sites // 2 + 1)) + 1j * rng.normal(size=(2, sites // 2 + 1))
    end = min(50.0, max(SHORTEST, WORK / sites))
    return PaperProblem(
        parameters=vars(CONSTANTS),
        half_width=sites // 2,
        boundary="dirichlet",
        initial=np.concatenate([half[:, :0:-1], half], axis=1),
        end_time=end,
        output_step=end,
        solver=controls(name, TOLERANCE),
    )


def quiet_chain(sites: int, name: str) -> PaperProblem:
    """Return the problem with one excited pair: amplitudes ahead of its motion are tiny."""
    problem = noisy_chain(sites, name)
    initial = np.zeros_like(problem.initial)
    initial[:, sites // 2] = 1.0, 0.1
    return problem.changed(initial=initial)


STARTS = {"all": noisy_chain, "one": quiet_chain}
