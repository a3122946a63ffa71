"""References: each case integrated twice in multiprecision, which must agree to 1e-12.

heyoka (Biscani and Izzo, MNRAS 504 (2021) 2614) integrates equations (4) on half a chain, which
needs even initial data. Its expressions are built from the traced equations, and its constants from
the decimals in the configuration. A state has the rows Re A, Im A, Re B, Im B on the sites 0..M,
and A = B = 0 beyond site M. The two runs differ in precision and order, so they share no rounding
errors. The dataset of a reference holds the first run, each number rounded once to double.
"""

from types import ModuleType
from typing import Any, NamedTuple

import numpy as np
from latticode.datasets.netcdf import Variable
from latticode.datasets.stated import describe_run, shared_by
from latticode.datasets.trajectories import Contents
from latticode.equations.initial_values import by_site
from latticode.simulation.lattice import Reduction, unfold
from latticode.simulation.simulate import IntegrationError
from numpy.typing import ArrayLike

from pendula.many_cases import COMPONENTS
from pendula.models.amplitudes import field
from pendula.problem import PaperProblem

HEYOKA = "heyoka==7.13.2"
LARGEST_DISCREPANCY = 1e-12
"""The norms of the two runs must differ by less than this at every output time."""
MEANING_OF_PARAMETERS = "the printed decimals"
"""The parameter 0.1 means one tenth, not the nearest double."""


class UnverifiedError(RuntimeError):
    """The reference cannot be made: heyoka is missing, or the two runs disagree."""


def load_heyoka() -> ModuleType:
    """Return the module heyoka. Raises UnverifiedError with the command that installs it."""
    try:
        import heyoka
    except ImportError:
        raise UnverifiedError(f"references require heyoka: pip install {HEYOKA}") from None
    return heyoka


# --- The equations (4) ----------------------------------------------------------------------------


class RealConstants(NamedTuple):
    """Coupling, drive and detuning as multiprecision reals."""

    epsilon: Any
    gamma: Any
    omega: Any


def right_hand_side(
    heyoka: ModuleType, constants: RealConstants, half_width: int
) -> list[tuple[Any, Any]]:
    """Return heyoka's pairs (variable, rate of change), in the order of a flat state."""
    names = [[f"{row}{n}" for n in range(half_width + 1)] for row in ("ra", "ia", "rb", "ib")]
    rows = [[heyoka.make_vars(name) for name in row] for row in names]

    def field_at(component: int, n: int) -> tuple:
        def unknown_at(partner: int, re_or_im: int, shift: int) -> Any:
            row, site = rows[2 * (component ^ partner) + re_or_im], abs(n + shift)  # -1 mirrors 1
            return row[site] if site < len(row) else 0.0  # site M + 1 is at rest

        return field(constants, unknown_at)

    pairs = []
    for component in (0, 1):
        fields = [field_at(component, n) for n in range(half_width + 1)]
        re, im = rows[2 * component : 2 * component + 2]
        pairs += [(u, of_im) for u, (_, of_im) in zip(re, fields, strict=True)]
        pairs += [(v, -of_re) for v, (of_re, _) in zip(im, fields, strict=True)]
    return pairs


def compute_norms(states: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the l-infinity and l2 norms, each (component, time), of states (time, row, site)."""
    squares = np.square(states)
    modulus2 = np.stack([squares[:, 0] + squares[:, 1], squares[:, 2] + squares[:, 3]])
    right = np.add.reduce(modulus2[..., 1:], axis=-1)
    square_sum = modulus2[..., 0] + right + right
    return np.sqrt(np.maximum.reduce(modulus2, axis=2)), np.sqrt(square_sum)


# --- Two runs -------------------------------------------------------------------------------------


class MultiprecisionRun(NamedTuple):
    """Norms, snapshots and controls of a run in multiprecision; components A, B, sites 0..M."""

    tau: np.ndarray  # (time,), doubles
    linf: np.ndarray  # (component, time)
    l2: np.ndarray  # (component, time)
    snapshot_tau: np.ndarray  # (snapshot,), doubles
    amplitude: np.ndarray  # (snapshot, row, site), rows Re A, Im A, Re B, Im B
    controls: dict[str, float]


def make_initial_state(problem: PaperProblem, bits: int) -> np.ndarray:
    """Return the initial state (row, site) of the half chain 0..M in multiprecision.

    Raises ValueError if the initial data are not even, or the boundary is not Dirichlet.
    """
    if problem.boundary != "dirichlet":
        raise ValueError(f"references require boundary: dirichlet, not {problem.boundary}")
    if not np.array_equal(problem.initial, problem.initial[:, ::-1]):
        raise ValueError("references integrate half a chain: the initial data must be even in n")
    state = as_reals(np.zeros((4, problem.half_width + 1)), bits)
    for site, (a, b) in by_site(problem.initial).items():
        numbers = [number for z in (complex(a), complex(b)) for number in (z.real, z.imag)]
        state[:, abs(site)] = [decimal_as_real(number, bits) for number in numbers]
    return state


def as_reals(values: ArrayLike, bits: int) -> np.ndarray:
    """Return an array of multiprecision reals that equal the doubles `values`."""
    real = load_heyoka().real
    return np.array([real(float(x), bits) for x in np.ravel(values)]).reshape(np.shape(values))


def decimal_as_real(x: float, bits: int) -> Any:
    """Return the multiprecision real of the shortest decimal that prints as the double `x`."""
    return load_heyoka().real(repr(float(x)), bits)


def integrate(problem: PaperProblem, snapshots: list[float], bits: int) -> MultiprecisionRun:
    """Return a run of a case by heyoka with `bits` bits and the tolerance 2^-bits.

    The solver of the problem is not used. Norms are stored at the doubles `problem.times`, states
    only at the times in `snapshots`. Raises IntegrationError if heyoka stops before the end, and
    ValueError as `make_initial_state` does.
    """
    heyoka = load_heyoka()
    constants = RealConstants(*(decimal_as_real(constant, bits) for constant in problem.constants))
    times = problem.times
    stepper = heyoka.taylor_adaptive(  # it chooses its order from the tolerance
        right_hand_side(heyoka, constants, problem.half_width),
        make_initial_state(problem, bits).ravel(),
        time=heyoka.real(0.0, bits),
        fp_type=heyoka.real,
        prec=bits,
        tol=heyoka.real(2.0**-bits, bits),
        compact_mode=True,  # otherwise it compiles each site separately, which takes minutes
    )
    outcome, _, _, steps, _, states = stepper.propagate_grid(as_reals(times, bits))
    if outcome != heyoka.taylor_outcome.time_limit:
        raise IntegrationError(f"heyoka stopped at tau = {float(stepper.time):.6g}: {outcome}")
    states, is_snapshot = states.reshape(len(times), 4, -1), np.isin(times, snapshots)
    controls = {"bits": bits, "order": stepper.order, "tolerance": float(stepper.tol)}
    observed = (times, *compute_norms(states), times[is_snapshot], states[is_snapshot])
    return MultiprecisionRun(*observed, controls | {"steps": steps})


def measure_discrepancy(
    name: str, run: MultiprecisionRun, check: MultiprecisionRun
) -> tuple[np.ndarray, np.ndarray]:
    """Return the largest differences of two runs: of norms (time,) and amplitudes (snapshot,).

    Differences are computed before rounding to doubles. Raises UnverifiedError if a norm differs by
    LARGEST_DISCREPANCY or more.
    """
    linf, l2 = np.abs(run.linf - check.linf), np.abs(run.l2 - check.l2)
    discrepancy = np.maximum(np.maximum.reduce(linf), np.maximum.reduce(l2)).astype(float)
    if (beyond := np.flatnonzero(~(discrepancy < LARGEST_DISCREPANCY))).size:
        raise UnverifiedError(
            f"{name}: runs of {run.controls['bits']} and {check.controls['bits']} bits differ by "
            f"{LARGEST_DISCREPANCY:g} or more from tau = {run.tau[beyond[0]]:g} on; "
            "give the case more bits"
        )
    amplitude = np.maximum.reduce(np.abs(run.amplitude - check.amplitude), axis=(1, 2))
    return discrepancy, amplitude.astype(float)


def make_reference(
    name: str, problem: PaperProblem, snapshots: list[float], bits: tuple[int, int]
) -> Contents:
    """Return the dataset of a reference; `bits` is the precision of the stored and the second run.

    States are stored at the output times in `snapshots`. Times are exact, so that `amplitude` can
    be the initial state of another run.
    """
    run, check = (integrate(problem, snapshots, precision) for precision in bits)
    discrepancy, amplitude_discrepancy = measure_discrepancy(name, run, check)
    rows = run.amplitude.astype(float).transpose(1, 2, 0)
    mirrored = Reduction(even=True, synchronised=False)
    amplitude = np.stack([unfold(rows[re_or_im::2], mirrored) for re_or_im in (0, 1)])
    series, reach = ("component", "tau"), problem.half_width
    variables = {
        "tau": Variable(("tau",), run.tau),
        "component": COMPONENTS,
        "linf": Variable(series, run.linf.astype(float)),
        "l2": Variable(series, run.l2.astype(float)),
        "discrepancy": Variable(
            ("tau",), discrepancy, "largest difference of a norm from that of the second run"
        ),
        "part": Variable(("part",), ["re", "im"]),
        "site": Variable(("site",), np.arange(-reach, reach + 1)),
        "snapshot_tau": Variable(("snapshot",), run.snapshot_tau),
        "amplitude": Variable(
            ("part", "component", "site", "snapshot"), amplitude, "amplitude on a site"
        ),
        "amplitude_discrepancy": Variable(
            ("snapshot",),
            amplitude_discrepancy,
            "largest difference from the second run's amplitudes",
        ),
    }
    attributes = describe_run(name, problem, {"name": "heyoka", **run.controls})
    return variables, {
        "title": f"Norms and snapshots of {name} in multiprecision, from {MEANING_OF_PARAMETERS}",
        **shared_by([attributes], "snapshot_every"),
        **{f"second_run_{key}": value for key, value in check.controls.items()},
        "parameters_mean": MEANING_OF_PARAMETERS,
        "largest_discrepancy": float(discrepancy.max()),
    }
