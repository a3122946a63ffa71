"""A case integrated twice in multiprecision: what both runs agree on is the solution's.

heyoka (Biscani and Izzo, MNRAS 504 (2021) 2614) integrates the equations (4) on half a chain of
even data. It takes expressions, which follow from the traced equations; the numbers come from the
decimals that the configuration prints. A state has the rows Re A, Im A, Re B, Im B on the sites
0..M, and A = B = 0 beyond site M. Two runs of different precision and order share no rounding.
Their common digits, each number rounded once to double, make the dataset of a reference.
"""

from types import ModuleType
from typing import Any, NamedTuple

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.datasets.stated import describe_run, shared_by
from latticode.datasets.trajectories import Contents
from latticode.simulation.lattice import Reduction, unfold
from latticode.simulation.problem import by_site
from latticode.simulation.simulate import IntegrationError

from pendula.many_cases import COMPONENTS
from pendula.models.amplitudes import field
from pendula.problem import Problem

HEYOKA = "heyoka==7.13.2"
LIMIT = 1e-12
"""The largest difference of any norm that two runs may have, at any output time."""
NUMBERS = "the printed decimals"
"""What the parameters mean: 0.1 is one tenth, and not the double beside it."""


class UnverifiedError(RuntimeError):
    """heyoka, which only the reference needs, is missing, or two runs have too few digits."""


def load_heyoka() -> ModuleType:
    """Return the module heyoka; the error names the command that installs it."""
    try:
        import heyoka
    except ImportError:
        text = f"the reference, and nothing else, needs heyoka: pip install {HEYOKA}"
        raise UnverifiedError(text) from None
    return heyoka


# --- The equations (4) ----------------------------------------------------------------------------


class RealConstants(NamedTuple):
    """Coupling, drive and detuning, as multiprecision reals."""

    epsilon: Any
    gamma: Any
    omega: Any


def right_hand_side(heyoka, constants: RealConstants, half_width: int) -> list[tuple]:
    """Return the pairs (variable, its rate of change), in the order of a flattened state."""
    names = [[f"{row}{n}" for n in range(half_width + 1)] for row in ("ra", "ia", "rb", "ib")]
    rows = [[heyoka.make_vars(name) for name in row] for row in names]

    def field_at(component: int, n: int) -> tuple:
        def seen(partner: int, part: int, by: int):
            row, site = rows[2 * (component ^ partner) + part], abs(n + by)  # -1 moves as 1
            return row[site] if site < len(row) else 0.0  # site M + 1 is at rest

        return field(constants, seen)

    pairs = []
    for component in (0, 1):
        fields = [field_at(component, n) for n in range(half_width + 1)]
        re, im = rows[2 * component : 2 * component + 2]
        pairs += [(u, of_im) for u, (_, of_im) in zip(re, fields, strict=True)]
        pairs += [(v, -of_re) for v, (of_re, _) in zip(im, fields, strict=True)]
    return pairs


def norms(states: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the l-infinity and l2 norms, each (component, time), of states (time, row, site)."""
    squares = np.square(states)
    modulus2 = np.stack([squares[:, 0] + squares[:, 1], squares[:, 2] + squares[:, 3]])
    right = np.add.reduce(modulus2[..., 1:], axis=-1)
    whole = modulus2[..., 0] + right + right
    return np.sqrt(np.maximum.reduce(modulus2, axis=2)), np.sqrt(whole)


# --- Two runs -------------------------------------------------------------------------------------


class MultiprecisionRun(NamedTuple):
    """What is kept of a run, in multiprecision; components are A, B and sites 0..M."""

    tau: np.ndarray  # (time,), doubles
    linf: np.ndarray  # (component, time)
    l2: np.ndarray  # (component, time)
    snapshot_tau: np.ndarray  # (snapshot,), doubles
    amplitude: np.ndarray  # (snapshot, row, site), rows Re A, Im A, Re B, Im B
    controls: dict[str, float]


def start(problem: Problem, bits: int) -> np.ndarray:
    """Return the initial state (row, site) of the half chain 0..M, in multiprecision.

    Raises ValueError where the data are not even, or the ends are not at rest.
    """
    if problem.boundary != "dirichlet":
        raise ValueError(f"the reference has Dirichlet ends only, not {problem.boundary}")
    if not np.array_equal(problem.initial, problem.initial[:, ::-1]):
        raise ValueError("the reference integrates half a chain: its data must be even")
    state = exactly(np.zeros((4, problem.half_width + 1)), bits)
    for site, (a, b) in by_site(problem.initial).items():
        parts = [part for z in (complex(a), complex(b)) for part in (z.real, z.imag)]
        state[:, abs(site)] = [printed(part, bits) for part in parts]
    return state


def exactly(values, bits: int) -> np.ndarray:
    """Return an array of doubles as reals."""
    real = load_heyoka().real
    return np.array([real(float(x), bits) for x in np.ravel(values)]).reshape(np.shape(values))


def printed(x: float, bits: int):
    """Return the shortest decimal that names a double, which the configuration prints."""
    return load_heyoka().real(repr(float(x)), bits)


def integrate(problem: Problem, snapshots: list[float], bits: int) -> MultiprecisionRun:
    """Integrate a case with `bits` bits, and a tolerance of 2^-bits.

    The problem's own solver is not used. Outputs are at the doubles `problem.times`; those
    among `snapshots` keep the state. Raises IntegrationError where heyoka does not reach the end,
    ValueError as `start` does.
    """
    heyoka = load_heyoka()
    constants = RealConstants(*(printed(one, bits) for one in problem.constants))
    times = problem.times
    stepper = heyoka.taylor_adaptive(  # it chooses its order from the tolerance
        right_hand_side(heyoka, constants, problem.half_width),
        start(problem, bits).ravel(),
        time=heyoka.real(0.0, bits),
        fp_type=heyoka.real,
        prec=bits,
        tol=heyoka.real(2.0**-bits, bits),
        compact_mode=True,  # else it compiles every site by itself, for minutes
    )
    outcome, _, _, steps, _, states = stepper.propagate_grid(exactly(times, bits))
    if outcome != heyoka.taylor_outcome.time_limit:
        raise IntegrationError(f"heyoka stopped at tau = {float(stepper.time):.6g}: {outcome}")
    states, kept = states.reshape(len(times), 4, -1), np.isin(times, snapshots)
    controls = {"bits": bits, "order": stepper.order, "tolerance": float(stepper.tol)}
    observed = (times, *norms(states), times[kept], states[kept])
    return MultiprecisionRun(*observed, controls | {"steps": steps})


def compare(
    name: str, run: MultiprecisionRun, check: MultiprecisionRun
) -> tuple[np.ndarray, np.ndarray]:
    """Return how far two runs are apart, in doubles: norms (time,) and amplitudes (snapshot,).

    It is the largest difference, taken before any rounding. Raises UnverifiedError where a norm
    differs by LIMIT or more.
    """
    linf, l2 = np.abs(run.linf - check.linf), np.abs(run.l2 - check.l2)
    apart = np.maximum(np.maximum.reduce(linf), np.maximum.reduce(l2)).astype(float)
    if (beyond := np.flatnonzero(~(apart < LIMIT))).size:
        raise UnverifiedError(
            f"{name}: runs of {run.controls['bits']} and {check.controls['bits']} bits differ by "
            f"{LIMIT:g} or more from tau = {run.tau[beyond[0]]:g} on; give the case more bits"
        )
    amplitude = np.maximum.reduce(np.abs(run.amplitude - check.amplitude), axis=(1, 2))
    return apart, amplitude.astype(float)


def reference_contents(
    name: str, problem: Problem, snapshots: list[float], bits: tuple[int, int]
) -> Contents:
    """Return the reference of a case; `bits` are those of the stored run and of the second one.

    States are kept at those of the times `snapshots` that are output times. Times are exact, and
    `amplitude` may start any run as an exact state.
    """
    run, check = (integrate(problem, snapshots, some) for some in bits)
    apart, amplitudes_apart = compare(name, run, check)
    rows = run.amplitude.astype(float).transpose(1, 2, 0)
    mirrored = Reduction(even=True, synchronised=False)
    amplitude = np.stack([unfold(rows[part::2], mirrored) for part in (0, 1)])
    series, reach = ("component", "tau"), problem.half_width
    variables = {
        "tau": Variable(("tau",), run.tau),
        "component": COMPONENTS,
        "linf": Variable(series, run.linf.astype(float)),
        "l2": Variable(series, run.l2.astype(float)),
        "discrepancy": Variable(
            ("tau",), apart, "largest difference of a norm from that of the second run"),
        "part": Variable(("part",), ["re", "im"]),
        "site": Variable(("site",), np.arange(-reach, reach + 1)),
        "snapshot_tau": Variable(("snapshot",), run.snapshot_tau),
        "amplitude": Variable(
            ("part", "component", "site", "snapshot"), amplitude, "amplitude on a site"),
        "amplitude_discrepancy": Variable(
            ("snapshot",), amplitudes_apart, "largest difference from the second run's amplitudes"),
    }  # fmt: skip
    about = describe_run(name, problem, {"name": "heyoka", **run.controls})
    return variables, {
        "title": f"Norms and snapshots of {name} in multiprecision, from {NUMBERS}",
        **shared_by([about], "snapshot_every"),
        **{f"second_run_{key}": value for key, value in check.controls.items()},
        "parameters_mean": NUMBERS,
        "largest_discrepancy": float(apart.max()),
    }
