"""Growth of small perturbations of a solution of any traced model, for Lyapunov exponents.

Solution and tangent vectors are integrated together, with the derivative of the traced equations
(see `bundles`).
"""

from functools import cache
from types import ModuleType
from typing import NamedTuple

import numpy as np

from latticode.equations.initial_values import output_times
from latticode.equations.model import Model
from latticode.generation.modules import load_text, tangents_module_text
from latticode.integrators import DONE, FAULTS, dop853
from latticode.numerics.draws import complex_normal
from latticode.numerics.elementary import log
from latticode.simulation.interrupts import interruptible
from latticode.simulation.lattice import Reduction, aligned, pack
from latticode.simulation.problem import Problem
from latticode.simulation.progress import follow
from latticode.simulation.simulate import IntegrationError
from latticode.simulation.traced import make_system

from .bundles import orthonormalise, size_of_solution

STEP = 0.25
"""Default time between orthonormalisations, suitable for growth rates of order 1."""
TOLERANCE = 1e-9
CARRY = """
from {home} import bundles
carry_bundle = bundles.build(bundle_rates{time})
@kernel
def carry(system, bundle, times, controls, work, record, lengths, sizes, stop):
    return carry_bundle(system, bundle, times, controls, work, record, lengths, sizes, stop)
"""


class TangentGrowth(NamedTuple):
    """Growth of tangent vectors, as natural logarithms."""

    tau: np.ndarray  # (time,)
    log_growth: np.ndarray  # (vector, time), relative to the length at the start
    size: np.ndarray  # (time,), l2 norm of the solution


@cache
def kernels_of_tangents(model: Model, site_dependent: frozenset[str]) -> ModuleType:
    """Return the generated module; its `carry` integrates a solution with tangent vectors."""
    carry = CARRY.format(home=__name__.rpartition(".")[0], time=", at_time" if model.driven else "")
    return load_text(tangents_module_text(model.tangent(), site_dependent) + carry)


def random_tangent(
    sites: int, rng: np.random.Generator, even: bool = False, fields: int = 2
) -> np.ndarray:
    """Return complex Gaussian fields (field, site); with `even` they are exactly even in n."""
    z = complex_normal(rng, (fields, sites))
    return z + z[:, ::-1] if even else z


def grow(
    problem: Problem,
    tangents: np.ndarray,
    end_time: float,
    even: bool = False,
    step: float = STEP,
    tolerance: float = TOLERANCE,
) -> TangentGrowth:
    """Return the growth of `tangents` (vector, field, site), perturbations of a problem's data.

    `tangents` must be linearly independent. Their imaginary parts perturb the imaginary parts of
    complex fields, or the rates of real fields. With `even` only half of the chain is integrated;
    solution and tangent vectors must then be even. `end_time` counts from the start of the problem,
    and `step` is the time between orthonormalisations. Raises IntegrationError if dop853 cannot
    finish the run.
    """
    cut, count = Reduction(even, synchronised=False), len(tangents)
    if problem.model.form == "dt":  # the second row of a field is zero
        tangents = tangents.real
    at_rest = np.zeros((2 * tangents.shape[1], problem.initial.shape[1]))
    model = problem.model.tangent()
    system = make_system(problem.changed(model=model, initial=at_rest), cut)
    start = problem.equations.start(cut)
    bundle = np.concatenate([start, *(pack(vector, cut) for vector in tangents)])
    tau = output_times(end_time, step)
    times = problem.start_time + tau
    lengths, sizes = np.empty((tau.size, count)), np.empty(tau.size)
    orthonormalise(system, bundle, lengths[0])
    lengths[0], sizes[0] = 1.0, size_of_solution(system, bundle, count)
    carry = kernels_of_tangents(problem.model, problem.site_dependent).carry
    follow(lengths[:, 0], "a tangent vector")
    lengths[0] = 1.0
    workspace = (tolerance, tolerance), aligned((dop853.WORK, *bundle.shape)), np.empty(0)
    status = interruptible(carry, system, bundle, times, *workspace, lengths[1:], sizes[1:])
    if status != DONE:
        raise IntegrationError(
            f"dop853 stopped while integrating tangent vectors: {FAULTS[status]}"
        )
    return TangentGrowth(tau, log(lengths).cumsum(axis=0).T, sizes)
