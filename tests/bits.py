"""Hashes of runs, to compare their bits; a program, run for each kind of code generation.

    python bits.py [threads [solvers]]

prints as JSON the family of the processor, the hash of each run, and how often each kernel was read
from the cache.
"""

import hashlib
import json
import platform
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from latticode.kernels.simd import LANES
from latticode.simulation.lattice import Reduction
from latticode.simulation.simulate import Trajectory, simulate
from latticode.simulation.survey_runs import norms_in_batches
from pendula.models.amplitude_batches import run_batch
from pendula.models.solvers import SOLVERS
from pendula.problem import PaperProblem

TIGHT = {"taylor": 1e-14, "dop853": 1e-12, "ode45": 1e-9}
ITERATED = {"step": 0.0025, "tolerance": 1e-13, "iterations": 50}
CONTROLS = {
    **{name: {"rtol": value, "atol": value} for name, value in TIGHT.items()},
    "crank_nicolson": ITERATED,
    "delfour_fortin_payre": ITERATED,
    **{f"pendula.{name}": {"rtol": value, "atol": value} for name, value in TIGHT.items()},
    "pendula.kahan_li": {"step": 0.25},
    "long.taylor": {"rtol": TIGHT["taylor"], "atol": TIGHT["taylor"]},
    "batch.taylor": {"rtol": TIGHT["taylor"], "atol": TIGHT["taylor"]},
}
RUNS = [(name, even) for name in CONTROLS for even in (True, False)]
HALF_WIDTHS, LONG = (30, 200), (8200,)
"""The motion reaches the ends of the shortest chain. In the next one most sites are still at rest,
and numbers near the smallest ones are set to zero (`integrators/rest.py`). Even half of the LONG
chain is integrated by `long_taylor`."""


def digest(trajectories: list[Trajectory]) -> str:
    """Return a hash of the final amplitudes, the norms and the energy at every output."""
    digest = hashlib.sha256()
    for trajectory in trajectories:
        energy = trajectory.conserved.get("energy", np.empty(0))
        for values in (trajectory.final, trajectory.linf, trajectory.l2, energy):
            digest.update((values + 0.0).tobytes())  # turns -0 into 0
    return digest.hexdigest()[:16]


def of_model(name: str) -> tuple[str, str]:
    """Return model and solver from the name of a run; the model is amplitudes by default."""
    model, _, solver = name.rpartition(".")
    return model if model == "pendula" else "amplitudes", solver


def run(name: str, even: bool) -> str:
    """Return the hash of Fig 4, large data, to tau = 3, by half of each chain or the whole."""
    reduction = Reduction(even=even, synchronised=False)
    if name.startswith("batch."):
        return digest(runs_of_batch())
    half_widths = LONG if name.startswith("long.") else HALF_WIDTHS
    return digest([simulate(problem(name, half_width), reduction) for half_width in half_widths])


def runs_of_batch() -> list[Trajectory]:
    """Return the norms of a batch of runs with other Omega; half of each chain is integrated."""
    problems = [problem("batch.taylor", 5).changed(omega=0.5 * n - 2.0) for n in range(LANES)]
    [(_, norms)] = norms_in_batches(problems)
    return [norms.of_run(n) for n in range(LANES)]


def problem(name: str, half_width: int) -> PaperProblem:
    model, solver = of_model(name)
    entries = {
        "epsilon": 1.0,
        "gamma": 1.0,
        "omega": 0.0,
        "half_width": half_width,
        "boundary": "dirichlet",
        "initial": {0: (5.0, 1.0)},
        "end_time": 3.0,
        "output_step": 0.1,
        "solver": {"name": solver, **CONTROLS[name]},
        **({"model": model, "mu": 0.1} if model == "pendula" else {}),
    }
    return PaperProblem.of(entries)


def hits(name: str) -> int:
    """Return how often the kernel of a run was read from the cache."""
    model, solver = of_model(name)
    if name.startswith("batch."):
        return sum(run_batch.stats.cache_hits.values())
    method = SOLVERS[model][solver]
    kernel = method.load_long() if name.startswith("long.") else method.run
    return sum(kernel.stats.cache_hits.values())


def main(threads: int, names: list[str]) -> dict:
    runs = [(name, even) for name, even in RUNS if name in names] * threads
    with ThreadPoolExecutor(threads) as pool:
        hashes = list(pool.map(lambda task: run(*task), runs))
    cached = {name: hits(name) for name in names}
    digests = {name: set() for name in names}
    for (name, _), value in zip(runs, hashes, strict=True):
        digests[name].add(value)
    hashes = {name: sorted(values) for name, values in digests.items()}
    return {"machine": platform.machine(), "hashes": hashes, "cached": cached}


if __name__ == "__main__":
    np.seterr(all="raise")
    print(json.dumps(main(int((sys.argv[1:] or [1])[0]), sys.argv[2:] or [*CONTROLS])))
