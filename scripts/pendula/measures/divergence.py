"""Until when a trajectory can be trusted: how far its norms are from the true ones, and when.

The true ones are the multiprecision reference of the same case. Differences are measured where a
reader measures them, in parts of the full scale of a curve.
"""

import numpy as np
import xarray as xr

LEVELS = {"line": 0.0067, "visible": 0.01}
"""Parts of the full scale: the width of a line in Figs 2-4 (0.7 pt in 104 pt), and what a reader
sees as another curve."""

PARAMETERS = ("epsilon", "gamma", "omega", "half_width", "boundary", "initial", "output_step")


def difference(one: xr.Dataset, other: xr.Dataset) -> xr.DataArray:
    """Return by how much the norms of two trajectories differ, over the tau that both have.

    It is the largest difference among the four curves (two norms of A and of B), each relative to
    the largest value that its curve takes.
    """
    other = at_times(other, one["tau"]).dropna("tau")
    one = one[["linf", "l2"]].sel(tau=other["tau"])
    each = [
        abs(one[norm] - other[norm]) / one[norm].max("tau").clip(min=other[norm].max("tau"))
        for norm in ("linf", "l2")
    ]
    largest = xr.concat(each, "norm").max(["norm", "component"]).rename("difference")
    return largest.assign_attrs(
        long_name="largest difference of the norms relative to their scale", units="1"
    )


def at_times(trajectory: xr.Dataset, tau: xr.DataArray) -> xr.Dataset:
    """Return the norms at these times, NaN where there are none; times may differ by rounding."""
    return trajectory[["linf", "l2"]].reindex(tau=tau, method="nearest", tolerance=1e-9)


def first_above(difference: xr.DataArray, level: float) -> xr.DataArray:
    """Return the first tau at which the difference is above `level`, NaN where it never is."""
    return difference["tau"].where(difference > level).min("tau")


def is_of_same_case(trajectory: xr.Dataset, reference: xr.Dataset) -> bool:
    """Return whether both solve the same problem; their end times may differ."""
    return all(trajectory.attrs[key] == reference.attrs[key] for key in PARAMETERS)


def horizons(trajectories: dict[str, xr.Dataset], reference: xr.Dataset) -> xr.Dataset:
    """Return the difference from the reference of each solver's run, and when it is lost."""
    solver = xr.Variable("solver", list(trajectories), {"long_name": "solver", "units": "1"})
    curves = [
        difference(run, reference)
        if is_of_same_case(run, reference)
        else xr.full_like(run["energy"], np.nan).rename("difference")  # not the reference's case
        for run in trajectories.values()
    ]
    data = xr.concat(curves, solver).to_dataset()
    level = xr.Variable("level", list(LEVELS), {"long_name": "when curves are apart", "units": "1"})
    lost = [first_above(data["difference"], value) for value in LEVELS.values()]
    data["horizon"] = xr.concat(lost, level).assign_attrs(
        long_name="first tau at which a norm is off by the level", units="1"
    )
    data["size"] = ("level", list(LEVELS.values()), {"long_name": "size of the level"})
    data["size"].attrs["units"] = "1"
    return data


def write_table(data: xr.Dataset) -> str:
    """Return a Markdown table of `horizons` by case: a row a solver, a column a level."""
    levels = [f"off by {float(size):.2%}" for size in data["size"]]
    lines = [
        "# Until when the solvers can be trusted",
        "",
        "The first tau at which a norm is off by a part of its full scale (0.67 % is the width of "
        "a line in Figs 2 to 4), against the multiprecision references.",
        "",
        f"| case | solver | {' | '.join(levels)} |",
        f"| --- | --- |{' --- |' * len(levels)}",
    ]
    for case in data["case"].values:
        for solver in data["solver"].values:
            lost = data["horizon"].sel(case=case, solver=solver).values
            times = [f"{tau:.4g}" if np.isfinite(tau) else "never" for tau in lost]
            lines.append(f"| {case} | {solver} | {' | '.join(times)} |")
    return "\n".join(lines) + "\n"
