"""The difference of two runs and the time at which they diverge, defined once for all uses.

A run has four curves: the l2 and l-infinity norms of A and of B. The full scale of a curve is its
largest value in either run over the common time span. The difference of two runs at a time is the
largest of abs(difference) / full scale over the four curves.

- A small component that is entirely wrong counts as much as a large one.
- Neither the amplitude of the data nor the axes of a figure matter.
- Exchanging the two runs changes nothing.

The divergence time is the first output time at which the difference exceeds a level, by default the
visible fraction. Datasets and texts distinguish three cases:

- a finite number if the runs diverge;
- infinity if they do not diverge by the end of the shorter run (see `known_until`);
- NaN if it is unknown, because a run is missing or solves another problem.
"""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from latticode.numerics.elementary import modulus

if TYPE_CHECKING:
    import xarray as xr

VISIBLE = 0.01
"""ASSUME: the fraction of full scale at which a reader sees two curves instead of one."""

NORMS = ("linf", "l2")
PARAMETERS = ("epsilon", "gamma", "omega", "half_width", "boundary", "initial", "output_step")

ABSENT = "infinite: at no common tau; NaN: unknown"
"""The meaning of times that are not finite, for the long names of variables."""


def norm_difference(
    linf_a: ArrayLike, l2_a: ArrayLike, linf_b: ArrayLike, l2_b: ArrayLike
) -> np.ndarray:
    """Return the difference (time,) of the norms of two runs as a fraction of full scale.

    All arguments are (component, time), at the same times. A curve that is zero in both runs has
    the difference 0.
    """
    return np.max([_curve_difference(linf_a, linf_b), _curve_difference(l2_a, l2_b)], axis=(0, 1))


def _curve_difference(a: ArrayLike, b: ArrayLike) -> np.ndarray:
    a, b = np.asarray(a, float), np.asarray(b, float)
    scale = np.maximum(a.max(axis=-1), b.max(axis=-1))[..., None]
    return np.abs(a - b) / np.where(scale == 0.0, 1.0, scale)


def field_difference(first: ArrayLike, second: ArrayLike, sizes: ArrayLike) -> np.ndarray:
    """Return the largest difference (time,) of two runs at any site, relative to full scale.

    `first` and `second` are (curve, site, time), complex or real, at the same times. The curves are
    the values of all fields, followed by their rates if the equations are of second order. The full
    scale of a curve is its largest modulus in either run, but at least the value for its field in
    `sizes` (field,). A field at rest in both runs has the difference 0.
    """
    first, second = np.asarray(first), np.asarray(second)
    if not first.shape[-1]:
        return np.zeros(0)
    largest = np.maximum(modulus(first), modulus(second)).max(axis=(1, 2))
    scale = np.maximum(largest, np.tile(sizes, len(first) // len(sizes)))
    separation = modulus(first - second).max(axis=1)
    return (separation / np.where(scale == 0.0, 1.0, scale)[:, None]).max(axis=0)


def first_above(tau: ArrayLike, values: ArrayLike, level: float) -> np.ndarray | float:
    """Return the first of the times `tau` (time,) at which `values` (..., time) exceed `level`.

    The result (...) is infinite where no value exceeds it, and NaN where all values are NaN.
    """
    tau, values = np.asarray(tau, float), np.asarray(values, float)
    above = values > level
    first = np.where(above.any(axis=-1), tau[above.argmax(axis=-1)], np.inf)
    return np.where(np.isnan(values).all(axis=-1), np.nan, first)[()]


def difference(first: "xr.Dataset", second: "xr.Dataset") -> "xr.DataArray":
    """Return the difference (tau) of two stored trajectories at the times that both have.

    The result has the name and the attributes of a variable of a dataset.
    """
    import xarray as xr  # imported here, because it is slow and not every caller needs it

    second = at_times(second, first["tau"]).dropna("tau")
    tau = second["tau"]
    first = first.sel(tau=tau)
    norms = (run[name].transpose(..., "tau").values for run in (first, second) for name in NORMS)
    long_name = "largest difference of the norms relative to their scale"
    attributes = {"long_name": long_name, "units": "1"}
    return xr.DataArray(norm_difference(*norms), {"tau": tau}, ("tau",), "difference", attributes)


def at_times(trajectory: "xr.Dataset", tau: "xr.DataArray") -> "xr.Dataset":
    """Return the norms at the times `tau`, matched to 1e-9; NaN at times without norms."""
    return trajectory[list(NORMS)].reindex(tau=tau, method="nearest", tolerance=1e-9)


def divergence_time(difference: "xr.DataArray", level: float = VISIBLE) -> "xr.DataArray":
    """Return the first tau at which a `difference` (..., tau) exceeds `level`, shape (...).

    It is infinite if the difference never exceeds the level, and NaN if no difference is known.
    """
    values = difference.transpose(..., "tau")
    times = difference.isel(tau=0, drop=True).copy(data=first_above(values["tau"], values, level))
    long_name = f"first tau at which two runs differ by {100 * level:.3g} % of full scale, {ABSENT}"
    times.attrs = {"long_name": long_name, "units": "1"}
    return times.rename("divergence_time")


def known_until(difference: "xr.DataArray") -> "xr.DataArray":
    """Return the last tau at which a `difference` (..., tau) is known, NaN if it is never known."""
    return difference["tau"].where(difference.notnull()).max("tau")


def is_of_same_case(trajectory: "xr.Dataset", reference: "xr.Dataset") -> bool:
    """Return whether two stored trajectories solve the same problem, except for the end time."""
    return all(trajectory.attrs[key] == reference.attrs[key] for key in PARAMETERS)


def state_error(computed: np.ndarray, exact: np.ndarray) -> float:
    """Return the largest error of a state at any site, relative to the largest modulus of `exact`.

    Both states have the same shape. Unlike `norm_difference`, this error compares site by site.
    """
    return float(modulus(computed - exact).max() / modulus(exact).max())
