"""How far two runs differ, and from when on: one definition for every sentence about it.

The difference of two runs at a time is the largest, over the four curves (l2 and l-infinity of A
and of B), of abs(difference) relative to the full scale of that curve: the largest value that it
takes in either run over the time that both have.

- It is strict: a small component that is wholly wrong does not hide behind a large one.
- It does not depend on the scale of the data, nor on which curves share an axis of a figure.
- It does not depend on which of the two runs is named first.

The divergence time is the first output time at which the difference exceeds a level, as a rule the
visible fraction. Three things must not be taken for each other, in datasets and in words alike:

- a time that comes is a number;
- a time that never comes, as long as both runs are known, is infinite. Where one of them ends
  first, nothing is said of the time after that: `known_until` tells when;
- a time that is not known, since a run is absent or of another problem, is NaN.
"""

import numpy as np

from latticode.numerics.elementary import modulus

VISIBLE = 0.01
"""ASSUME: the part of full scale from which on a reader sees another curve."""

NORMS = ("linf", "l2")
PARAMETERS = ("epsilon", "gamma", "omega", "half_width", "boundary", "initial", "output_step")


ABSENT = "infinite: at no tau that both have; NaN: not known"
"""What a time stands for that is no number, for the long names of such times."""


def norm_difference(linf_a, l2_a, linf_b, l2_b) -> np.ndarray:
    """Return the difference of the norms of two runs at each time, (time,), as parts of one.

    All arguments are (component, time), at the same times. A curve that is zero in both runs does
    not differ.
    """
    return np.max([_curve_difference(linf_a, linf_b), _curve_difference(l2_a, l2_b)], axis=(0, 1))


def _curve_difference(a, b) -> np.ndarray:
    a, b = np.asarray(a, float), np.asarray(b, float)
    scale = np.maximum(a.max(axis=-1), b.max(axis=-1))[..., None]
    return np.abs(a - b) / np.where(scale == 0.0, 1.0, scale)


def field_difference(first, second, sizes) -> np.ndarray:
    """Return the largest difference of fields at a site over full scale, (time,).

    `first` and `second` are (curve, site, time), complex or real, at the same times. The full scale
    of a curve is its largest modulus in either, and at least that of its field in `sizes` (field,).
    Curves are the values of all fields, then their rates if there are any. A field at rest in both
    does not differ.
    """
    first, second = np.asarray(first), np.asarray(second)
    if not first.shape[-1]:
        return np.zeros(0)
    largest = np.maximum(modulus(first), modulus(second)).max(axis=(1, 2))
    scale = np.maximum(largest, np.tile(sizes, len(first) // len(sizes)))
    separation = modulus(first - second).max(axis=1)
    return (separation / np.where(scale == 0.0, 1.0, scale)[:, None]).max(axis=0)


def first_above(tau, values, level):
    """Return the first of the times `tau` at which `values` (..., time) are above `level`.

    It is infinite where they never are, and NaN where no value is known.
    """
    tau, values = np.asarray(tau, float), np.asarray(values, float)
    above = values > level
    first = np.where(above.any(axis=-1), tau[above.argmax(axis=-1)], np.inf)
    return np.where(np.isnan(values).all(axis=-1), np.nan, first)[()]


def difference(first, second):
    """Return the difference of two trajectories, datasets as they are stored, (tau).

    It is taken over the times that both have, and named and described as a variable of a dataset.
    """
    import xarray as xr  # here, so that the kernels' callers do without it

    second = at_times(second, first["tau"]).dropna("tau")
    tau = second["tau"]
    first = first.sel(tau=tau)
    norms = (run[name].transpose(..., "tau").values for run in (first, second) for name in NORMS)
    attributes = {
        "long_name": "largest difference of the norms relative to their scale",
        "units": "1",
    }
    return xr.DataArray(norm_difference(*norms), {"tau": tau}, ("tau",), "difference", attributes)


def at_times(trajectory, tau):
    """Return the norms at these times, NaN where there are none; times may differ by rounding."""
    return trajectory[list(NORMS)].reindex(tau=tau, method="nearest", tolerance=1e-9)


def divergence_time(difference, level: float = VISIBLE):
    """Return the first tau at which a `difference` over "tau" is above `level`.

    It is infinite where the runs never differ so much, and NaN where no difference is known.
    """
    values = difference.transpose(..., "tau")
    times = difference.isel(tau=0, drop=True).copy(data=first_above(values["tau"], values, level))
    long_name = f"first tau at which two runs differ by {100 * level:.3g} % of full scale, {ABSENT}"
    times.attrs = {"long_name": long_name, "units": "1"}
    return times.rename("divergence_time")


def known_until(difference):
    """Return the last tau at which a `difference` is known, NaN where it is known at none."""
    return difference["tau"].where(difference.notnull()).max("tau")


def is_of_same_case(trajectory, reference) -> bool:
    """Return whether both solve the same problem; their end times may differ."""
    return all(trajectory.attrs[key] == reference.attrs[key] for key in PARAMETERS)


def state_error(computed: np.ndarray, exact: np.ndarray) -> float:
    """Return the largest error of a component of a state over the largest component.

    It compares two states site by site, where `norm_difference` compares curves of norms.
    """
    return float(modulus(computed - exact).max() / modulus(exact).max())
