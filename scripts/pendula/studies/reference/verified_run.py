"""A case integrated twice in multiprecision: what both runs agree on is the solution's.

Two runs of different precision and order share no rounding. Their common digits, each number
rounded once to double, make the dataset of a reference.
"""

from typing import NamedTuple

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.datasets.stated import describe_run, shared_by
from latticode.datasets.trajectories import Contents
from latticode.simulation.lattice import Reduction, unfold
from latticode.simulation.problem import by_site
from latticode.simulation.simulate import IntegrationError

from pendula.many_cases import COMPONENTS
from pendula.problem import Problem

from .multiprecision import Numbers, RealConstants, energy, norms, right_hand_side


class Run(NamedTuple):
    """What is kept of a run, in multiprecision; components are A, B and sites 0..M."""

    tau: np.ndarray  # (time,), doubles
    linf: np.ndarray  # (component, time)
    l2: np.ndarray  # (component, time)
    energy: np.ndarray  # (time,)
    snapshot_tau: np.ndarray  # (snapshot,), doubles
    amplitude: np.ndarray  # (snapshot, row, site), rows Re A, Im A, Re B, Im B
    bits: int
    order: int
    tolerance: float
    steps: int


def start(problem: Problem, numbers: Numbers) -> np.ndarray:
    """Return the initial state (row, site) of the half chain 0..M, in multiprecision.

    Raises ValueError where the data are not even, or the ends are not at rest.
    """
    if problem.boundary != "dirichlet":
        raise ValueError(f"the reference has Dirichlet ends only, not {problem.boundary}")
    if not np.array_equal(problem.initial, problem.initial[:, ::-1]):
        raise ValueError("the reference integrates half a chain: its data must be even")
    state = numbers.exactly(np.zeros((4, problem.half_width + 1)))
    for site, (a, b) in by_site(problem.initial).items():
        parts = [part for z in (complex(a), complex(b)) for part in (z.real, z.imag)]
        for row, part in enumerate(parts):
            state[row, abs(site)] = numbers.given(part)
    return state


def integrate(problem: Problem, snapshots: list[float], bits: int, decimal: bool = True) -> Run:
    """Integrate a case with `bits` bits, and a tolerance of 2^-bits.

    The problem's own solver is not used. Outputs are at the doubles `problem.times`; those
    among `snapshots` keep the state. `decimal` is explained by Numbers. Raises IntegrationError
    where heyoka does not reach the end, ValueError as `start` does.
    """
    numbers = Numbers(bits, decimal)
    constants = RealConstants(*map(numbers.given, problem.constants))
    times, tolerance = problem.times, 2.0**-bits
    stepper = numbers.heyoka.taylor_adaptive(  # it chooses its order from the tolerance
        right_hand_side(numbers.heyoka, constants, problem.half_width),
        start(problem, numbers).ravel(),
        time=numbers.exact(0.0),
        fp_type=numbers.heyoka.real,
        prec=bits,
        tol=numbers.exact(tolerance),
        compact_mode=True,  # else it compiles every site by itself, for minutes
    )
    outcome, _, _, steps, _, states = stepper.propagate_grid(numbers.exactly(times))
    if outcome != numbers.heyoka.taylor_outcome.time_limit:
        raise IntegrationError(f"heyoka stopped at tau = {float(stepper.time):.6g}: {outcome}")
    states, kept = states.reshape(len(times), 4, -1), np.isin(times, snapshots)
    energies = energy(constants, states)
    observed = (times, *norms(states), energies, times[kept], states[kept])
    return Run(*observed, bits, stepper.order, float(stepper.tol), steps)


LIMIT = 1e-12
"""The largest difference of any norm that two runs may have, at any output time."""


class UnverifiedError(RuntimeError):
    """Two multiprecision runs that differ too much: neither has digits enough."""


class Discrepancy(NamedTuple):
    """How far two runs of a case are apart, in doubles."""

    norms: np.ndarray  # (time,), the largest over both norms and components
    amplitude: np.ndarray  # (snapshot,), the largest over parts, components and sites
    energy_drift: float  # max |H - H(0)| of the first run


def compare(run: Run, check: Run) -> Discrepancy:
    """Return how far two runs are apart, the difference taken before any rounding to double."""
    linf, l2 = np.abs(run.linf - check.linf), np.abs(run.l2 - check.l2)
    apart = np.maximum(np.maximum.reduce(linf), np.maximum.reduce(l2))
    amplitude = np.maximum.reduce(np.abs(run.amplitude - check.amplitude), axis=(1, 2))
    drift = np.maximum.reduce(np.abs(run.energy - run.energy[0]))
    return Discrepancy(apart.astype(float), amplitude.astype(float), float(drift))


def require_agreement(name: str, run: Run, check: Run, discrepancy: Discrepancy) -> None:
    """Raise UnverifiedError where a norm of the two runs differs by LIMIT or more."""
    apart = np.flatnonzero(~(discrepancy.norms < LIMIT))
    if apart.size:
        raise UnverifiedError(
            f"{name}: runs of {run.bits} and {check.bits} bits differ by {LIMIT:g} or more "
            f"from tau = {run.tau[apart[0]]:g} on; give the case more bits"
        )


def as_variables(run: Run, apart: Discrepancy) -> dict[str, Variable]:
    """Return the variables; times are exact, `amplitude` may start any run as an exact state."""
    series, reach = ("component", "tau"), run.amplitude.shape[2] - 1
    mirrored = Reduction(even=True, synchronised=False)
    rows = run.amplitude.astype(float).transpose(1, 2, 0)
    amplitude = np.stack([unfold(rows[part::2], mirrored) for part in (0, 1)])
    grid = ("part", "component", "site", "snapshot")
    norm_apart = "largest difference of a norm from that of the second run"
    amplitude_apart = "largest difference from the second run's amplitudes"
    return {
        "tau": Variable(("tau",), run.tau),
        "component": COMPONENTS,
        "linf": Variable(series, run.linf.astype(float)),
        "l2": Variable(series, run.l2.astype(float)),
        "energy": Variable(("tau",), run.energy.astype(float)),
        "discrepancy": Variable(("tau",), apart.norms, norm_apart),
        "part": Variable(("part",), ["re", "im"]),
        "site": Variable(("site",), np.arange(-reach, reach + 1)),
        "snapshot_tau": Variable(("snapshot",), run.snapshot_tau),
        "amplitude": Variable(grid, amplitude, "amplitude on a site"),
        "amplitude_discrepancy": Variable(("snapshot",), apart.amplitude, amplitude_apart),
    }


def reference_contents(
    name: str, problem: Problem, snapshots: list[float], bits: tuple[int, int], decimal: bool
) -> Contents:
    """Return the reference of a case; `bits` are those of the stored run and of the second one.

    States are kept at those of the times `snapshots` that are output times. Where `decimal` is
    false, the parameters and data are the doubles nearest to the decimals.
    """
    run, check = (integrate(problem, snapshots, some, decimal) for some in bits)
    apart = compare(run, check)
    for one in (run, check):
        print(f"{name}: {one.bits} bits, order {one.order}, {one.steps} steps")
    print(f"{name}: the norms differ by {apart.norms.max():.1e}, H drifts {apart.energy_drift:.1e}")
    require_agreement(name, run, check, apart)
    controls, others = (
        {key: getattr(one, key) for key in ("bits", "order", "tolerance", "steps")}
        for one in (run, check)
    )
    numbers = "the printed decimals" if decimal else "the doubles nearest to them"
    about = describe_run(name, problem, {"name": "heyoka", **controls})
    return as_variables(run, apart), {
        "title": f"Norms, energy and snapshots of {name} in multiprecision, from {numbers}",
        **shared_by([about], "snapshot_every"),
        **{f"second_run_{key}": value for key, value in others.items()},
        "parameters_mean": numbers,
        "energy_drift": apart.energy_drift,
        "largest_discrepancy": float(apart.norms.max()),
    }
