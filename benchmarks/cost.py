"""The cost of a run against the length of the chain: time per site and unit of tau."""

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.simulation.simulate import simulate
from pendula.problem import Constants, PaperProblem

from .contestants import controls
from .timing import repeat, timed

SITES = (3, 5, 11, 31, 61, 201, 1001, 10_001, 100_001)
SOLVERS = ("dop853", "taylor")
TOLERANCE = 1e-10
WORK = 40_000
"""Number of sites times end time of a run: short chains run long enough to be timed."""
REPEAT = 5

CONSTANTS = Constants(epsilon=1.0, gamma=1.0, omega=0.0)


def measure() -> dict[str, Variable]:
    """Return the variables of the dataset: the median time, (sites, solver)."""
    seconds = np.array([[time_chain(sites, name) for name in SOLVERS] for sites in SITES])
    label = "time a site and unit of slow time"
    return {
        "sites": Variable(("sites",), np.array(SITES)),
        "solver": Variable(("solver",), np.array(SOLVERS)),
        "seconds": Variable(("sites", "solver"), seconds, label, "s"),
    }


def noisy_chain(sites: int, name: str) -> PaperProblem:
    """Return a problem with even amplitudes of order one: every site moves from the start."""
    rng = np.random.default_rng(0)
    half = rng.normal(size=(2, sites // 2 + 1)) + 1j * rng.normal(size=(2, sites // 2 + 1))
    end = min(50.0, max(1.0, WORK / sites))
    return PaperProblem(
        parameters=vars(CONSTANTS),
        half_width=sites // 2,
        boundary="dirichlet",
        initial=np.concatenate([half[:, :0:-1], half], axis=1),
        end_time=end,
        output_step=end,
        solver=controls(name, TOLERANCE),
    )


def time_chain(sites: int, name: str) -> float:
    """Return the time in s per site and unit of tau."""
    problem = noisy_chain(sites, name)
    simulate(problem)  # compiles
    return repeat(lambda: timed(lambda: simulate(problem))[1], REPEAT) / sites / problem.end_time
