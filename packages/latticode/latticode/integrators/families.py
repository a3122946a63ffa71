"""Choice of two methods from different families, and the difference of their runs of a problem.

A method agrees with itself at another tolerance even if it is wrong. A run is therefore checked by
another method with error control, of the highest order available. Runge-Kutta (`dop853`) checks
power series (`taylor`), and one of these two checks all other methods. This detects errors in the
rules for power series, because Runge-Kutta evaluates the equations directly.

For equations without a power series the two methods are `dop853` and `ode45`, Runge-Kutta pairs
with different coefficients, error estimates and interpolants. The implicit `crank_nicolson`
would differ more from both. But at order two it needs 10^5 steps per unit of time for an error of
1e-9, and it cannot integrate driven equations. `kahan_li` applies to few equations.
"""

from collections.abc import Collection, Mapping
from typing import Any, NamedTuple

import numpy as np

from latticode.measures.difference import field_difference, first_above, norm_difference
from latticode.numerics.elementary import complex_of

from .methods import METHODS


def judges_among(names: Collection[str]) -> list[str]:
    """Return the methods among `names` that control their error, the highest order first."""
    return [
        name for name, method in METHODS.items() if name in names and method.tightest is not None
    ]


def other_family(solver: str, names: Collection[str]) -> str:
    """Return the method among `names` that checks a run by `solver`.

    `names` are the methods that integrate the equations. "auto" runs the first of `judges_among`
    and is checked by the second.
    """
    judges = judges_among(names)
    return judges[1] if solver == "auto" else next(name for name in judges if name != solver)


COARSEST, FINEST, REFINEMENT = 1e-4, 1e-15, 0.1
"""Coarsest and finest tolerance of `auto`, and the largest ratio of successive tolerances."""
MARGIN_OF_START, PER_RADIAN, MOST_ADDED = 20.0, 0.2, 1e4
"""Ratio of final error to tolerance in short runs, its increase per radian and largest increase."""


def pair_of(names: Collection[str]) -> tuple[str, ...]:
    """Return the two methods that `auto` compares; the first one gives its result."""
    return tuple(judges_among(names)[:2])


def third_of(pair: Collection[str], names: Collection[str]) -> str | None:
    """Return the method that decides if a pair disagrees, None if `names` has no third one."""
    return next((name for name in judges_among(names) if name not in pair), None)


def first_tolerance(error: float, angle: float) -> float:
    """Return the first tolerance of `auto`, for a run in which phases advance by `angle` radians.

    In regular motion errors accumulate over the run. On several lattices the measured error at this
    tolerance is a few tenths of `error` after 50 to 500 units of time.
    """
    sums = MARGIN_OF_START + min(MOST_ADDED, PER_RADIAN * angle)
    return min(COARSEST, max(FINEST, error / sums))


def next_tolerance(tolerance: float, missing: float) -> float:
    """Return a smaller tolerance, so that errors shrink at least by the factor `missing` < 1."""
    return max(FINEST, tolerance * min(REFINEMENT, 0.2 * missing))


def instead_of_taylor(solver: Mapping[str, Any]) -> dict[str, Any]:
    """Return the controls of dop853 that replace those of `taylor`.

    Tolerances are multiplied by ten, the ratio of the two methods' default tolerances.
    """
    return {"name": "dop853", "rtol": 10.0 * solver["rtol"], "atol": 10.0 * solver["atol"]}


def remark_on(solver: Mapping[str, Any]) -> str:
    """Return a remark if a run used another method than expected, else ""."""
    if why := solver.get("instead_of_taylor"):
        return f"the run uses {solver['name']} instead of taylor, the default: {why}"
    if why := solver.get("disagreement"):
        return f"the run uses {solver['name']}: {why}"
    return ""


class Agreement(NamedTuple):
    """Differences of two runs of a problem, as fractions of full scale."""

    tau: np.ndarray  # (time,), all outputs
    norms: np.ndarray  # (time,), largest difference of the norms
    kept_tau: np.ndarray  # (snapshot,), times of the snapshots, and the end time
    fields: np.ndarray  # (snapshot,), largest difference of a field at any site

    @property
    def largest(self) -> float:
        """The largest difference of norms and fields over all times."""
        return float(max(self.norms.max(), self.fields.max()))

    def first_above(self, level: float) -> float:
        """Return the first time at which norms or fields differ by more than `level`, or inf.

        Fields are known only at `kept_tau`.
        """
        series = (self.tau, self.norms), (self.kept_tau, self.fields)
        return float(min(first_above(tau, values, level) for tau, values in series))


def compare(run: Any, second_run: Any) -> Agreement:
    """Return the differences of two trajectories of a problem, with snapshots at the same times.

    Complex fields are compared as complex numbers, real ones by their values and rates. The full
    scale of a rate is its largest value, but at least that of the field. If the snapshots hold only
    moduli, phases are compared only at the end time.
    """
    norms = norm_difference(run.linf, run.l2, second_run.linf, second_run.l2)
    sizes = np.maximum(run.linf.max(axis=1), second_run.linf.max(axis=1))  # (component,)
    pairs = zip(_fields_of(run), _fields_of(second_run), strict=True)
    at_snapshots, at_end = (field_difference(first, second, sizes) for first, second in pairs)
    kept_tau = run.snapshot_tau
    if kept_tau.size and kept_tau[-1] == run.tau[-1]:
        return Agreement(
            run.tau, norms, kept_tau, np.append(at_snapshots[:-1], max(at_snapshots[-1], at_end[0]))
        )
    fields = np.append(at_snapshots, at_end)
    return Agreement(run.tau, norms, np.append(kept_tau, run.tau[-1]), fields)


def _fields_of(run: Any) -> list[np.ndarray]:
    """Return the fields at the snapshots and at the end, each (curve, site, time)."""
    real, at_end = run.final.ndim == 3, run.final[..., None]
    state = run.state if real or run.state is None else complex_of(*run.state)
    at_snapshots = run.modulus if state is None else state
    return [fields.reshape(-1, *fields.shape[-2:]) for fields in (at_snapshots, at_end)]
