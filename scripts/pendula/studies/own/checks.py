"""All checks of one case in one dataset."""

import xarray as xr

from pendula.problem import Problem

from . import second_run, sensitivity, statements


def check_run(problem: Problem, run: xr.Dataset) -> xr.Dataset:
    """Return every number that is known of a case besides its run, with the case's attributes.

    `run` is the trajectory that `simulate` made of `problem`.
    """
    again = second_run.run_again(problem, run)
    solver = {
        key.removeprefix("second_"): again.attrs[key]
        for key in ("second_name", "second_rtol", "second_atol")
    }
    parts = [again, sensitivity.measure(problem), statements.gather(problem, run, solver)]
    data = xr.merge(parts, combine_attrs="drop_conflicts")
    return data.assign_attrs({**run.attrs, **data.attrs})
