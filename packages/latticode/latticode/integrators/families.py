"""Two methods of different families, and the difference of their runs of one problem.

A method that is compared with itself at another tolerance agrees with itself, right or wrong. So a
run is judged by another method with error control, that of the highest order: power series
(`taylor`) by Runge-Kutta (`dop853`), and all others by one of these two. Series continue the traced
equations by rules of their own, and an error in these rules shows, because Runge-Kutta evaluates
the equations themselves.

Equations without a power series leave `dop853` and `ode45`. Both are embedded Runge-Kutta pairs;
their coefficients, orders, error estimates and interpolation have nothing in common. The implicit
`crank_nicolson` would be farther from both, but at order two it needs 10^5 steps a unit of time for
an error of 1e-9, and does not take driven equations; `kahan_li` takes few equations.
"""

from collections.abc import Collection, Mapping
from typing import Any, NamedTuple

import numpy as np

from latticode.measures.difference import field_difference, first_above, norm_difference
from latticode.numerics.elementary import complex_of

from .methods import METHODS


def judges_among(names: Collection[str]) -> list[str]:
    """Return those of the methods that control their error, of the highest order first."""
    return [
        name for name, method in METHODS.items() if name in names and method.tightest is not None
    ]


def other_family(solver: str, names: Collection[str]) -> str:
    """Return the method that judges a run by `solver`, of `names`, which integrate the equations.

    A run by "auto" is made by the first judge, and judged by the second.
    """
    judges = judges_among(names)
    return judges[1] if solver == "auto" else next(name for name in judges if name != solver)


COARSEST, FINEST, REFINEMENT = 1e-4, 1e-15, 0.1
"""The coarsest and the finest tolerance of `auto`, and the largest factor between two of them."""
MARGIN_OF_START, PER_RADIAN, MOST_ADDED = 20.0, 0.2, 1e4
"""Errors at the end of a run over the tolerance of a step: of any run, and of a radian more."""


def pair_of(names: Collection[str]) -> tuple[str, ...]:
    """Return two methods of different families, the first of which makes the run of `auto`."""
    return tuple(judges_among(names)[:2])


def third_of(pair: Collection[str], names: Collection[str]) -> str | None:
    """Return the method of `names` that decides between a pair, None where none is left."""
    return next((name for name in judges_among(names) if name not in pair), None)


def first_tolerance(error: float, angle: float) -> float:
    """Return the tolerance at which `auto` begins, for data that turn by `angle` radians.

    Errors of regular motion add up over the run. They were measured on several lattices: at this
    tolerance they are some tenths of `error` after 50 to 500 units of time.
    """
    sums = MARGIN_OF_START + min(MOST_ADDED, PER_RADIAN * angle)
    return min(COARSEST, max(FINEST, error / sums))


def next_tolerance(tolerance: float, missing: float) -> float:
    """Return a finer tolerance, where errors must become smaller by the factor `missing`."""
    return max(FINEST, tolerance * min(REFINEMENT, 0.2 * missing))


def instead_of_taylor(solver: Mapping[str, Any]) -> dict[str, Any]:
    """Return the controls of dop853 that take the place of those of `taylor`, ten times as large.

    So are those by default.
    """
    return {"name": "dop853", "rtol": 10.0 * solver["rtol"], "atol": 10.0 * solver["atol"]}


def remark_on(solver: Mapping[str, Any]) -> str:
    """Return a sentence on a run whose method is not the one that was expected, else nothing."""
    if why := solver.get("instead_of_taylor"):
        return f"the run is by {solver['name']} in place of taylor, the default: {why}"
    if why := solver.get("disagreement"):
        return f"the run is by {solver['name']}: {why}"
    return ""


class Agreement(NamedTuple):
    """How far two runs of a problem are apart, as parts of full scale."""

    tau: np.ndarray  # (time,), all outputs
    norms: np.ndarray  # (time,), the largest difference of a norm
    kept_tau: np.ndarray  # (kept,), the times of snapshots and the end time
    fields: np.ndarray  # (kept,), the largest difference of a field at a site

    @property
    def largest(self) -> float:
        """The largest difference at any time."""
        return float(max(self.norms.max(), self.fields.max()))

    def first_above(self, level: float) -> float:
        """Return the first time at which norms or fields differ by more; infinite if they do not.

        Fields are compared at fewer times.
        """
        series = (self.tau, self.norms), (self.kept_tau, self.fields)
        return float(min(first_above(tau, values, level) for tau, values in series))


def compare(run, second_run) -> Agreement:
    """Return how far two trajectories of one problem are apart, with snapshots at the same times.

    Complex fields differ in modulus and phase. Real ones are compared in their values and in their
    rates; a rate counts relative to the largest value where no rate is larger. Where snapshots hold
    moduli alone, these are compared, and phases only at the end time.
    """
    norms = norm_difference(run.linf, run.l2, second_run.linf, second_run.l2)
    sizes = np.maximum(run.linf.max(axis=1), second_run.linf.max(axis=1))  # (component,)
    pairs = zip(_fields_of(run), _fields_of(second_run), strict=True)
    at_snapshots, at_end = (field_difference(one, other, sizes) for one, other in pairs)
    kept_tau = run.snapshot_tau
    if kept_tau.size and kept_tau[-1] == run.tau[-1]:
        return Agreement(
            run.tau, norms, kept_tau, np.append(at_snapshots[:-1], max(at_snapshots[-1], at_end[0]))
        )
    fields = np.append(at_snapshots, at_end)
    return Agreement(run.tau, norms, np.append(kept_tau, run.tau[-1]), fields)


def _fields_of(run) -> list[np.ndarray]:
    """Return the fields at the snapshots and at the end, each (curve, site, time)."""
    real, at_end = run.final.ndim == 3, run.final[..., None]
    state = run.state if real or run.state is None else complex_of(*run.state)
    at_snapshots = run.modulus if state is None else state
    return [one.reshape(-1, *one.shape[-2:]) for one in (at_snapshots, at_end)]
