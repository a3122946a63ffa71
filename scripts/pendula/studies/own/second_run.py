"""The same case by another method at tight tolerances: how far two runs agree.

Their difference is the error of the worse one, made by steps and rounding of its own; where a case
was run by the default solver at its default tolerances, it is that of double precision.
"""

import numpy as np
import xarray as xr

from pendula.datasets.netcdf import as_xarray
from pendula.datasets.trajectories import trajectory_contents
from pendula.measures.difference import at_times, difference, divergence_time
from pendula.problem import Problem
from pendula.simulation.simulate import IntegrationError, simulate

TIGHTEST = {"taylor": 1e-14, "dop853": 1e-13}


def choose_solver(name: str, peak: float) -> dict:
    """Return the controls of another method than `name`, for data whose largest part is `peak`.

    Data below one need a smaller absolute tolerance.
    """
    other = "dop853" if name == "taylor" else "taylor"
    rtol = TIGHTEST[other]
    return {"name": other, "rtol": rtol, "atol": rtol * (peak if 0 < peak < 1 else 1.0)}


def run_again(problem: Problem, run: xr.Dataset) -> xr.Dataset:
    """Return the second run's norms and its difference from `run`, NaN where it was refused.

    `run` is the trajectory that `simulate` made of `problem`.
    """
    peak = float(np.abs(problem.initial).max())
    solver = choose_solver(str(run.attrs["solver"]), peak)
    again = problem.changed(solver=solver, snapshot_every=0)
    said = {f"second_{key}": value for key, value in solver.items()}
    try:
        second = as_xarray(*trajectory_contents("second run", again, simulate(again)))
        apart = difference(run, second).reindex(tau=run["tau"])
    except IntegrationError as error:
        second, apart = run[["linf", "l2"]] * np.nan, xr.full_like(run["energy"], np.nan)
        said["second_refusal"] = str(error)
    return _compared(run, second, apart).assign_attrs(said)


def _compared(run: xr.Dataset, second: xr.Dataset, apart: xr.DataArray) -> xr.Dataset:
    norms = at_times(second, run["tau"])
    data = xr.Dataset(
        {
            f"second_{norm}": norms[norm].assign_attrs(
                long_name=f"{run[norm].attrs['long_name']}, by another method", units="1"
            )
            for norm in ("linf", "l2")
        }
    )
    data["difference"] = apart.assign_attrs(
        long_name="largest difference of the norms of two runs, of full scale", units="1"
    )
    data["largest_difference"] = apart.max().assign_attrs(
        long_name="its largest value: the error of the worse run", units="1"
    )
    data["divergence_time"] = divergence_time(apart)
    return data
