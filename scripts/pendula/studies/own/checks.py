"""All checks of one case in one dataset."""

import xarray as xr

from . import second_run, sensitivity, statements


def check_run(problem: dict, run: xr.Dataset) -> xr.Dataset:
    """Return every number that is known of a case besides its run, with the case's attributes.

    `problem` holds the arguments of `simulate`, `run` is the trajectory that they gave.
    """
    again = second_run.run_again(problem, run)
    solver = {
        key.removeprefix("second_"): again.attrs[key]
        for key in ("second_name", "second_rtol", "second_atol")
    }
    parts = [again, sensitivity.measure(problem), statements.gather(problem, run, solver)]
    data = xr.merge(parts, combine_attrs="drop_conflicts")
    return data.assign_attrs({**run.attrs, **data.attrs})
