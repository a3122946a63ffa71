"""Runs of the paper's studies in any number of parts have the same bits as in one."""

from functools import partial

import numpy as np
import pytest
from latticode.simulation.runs import join_chunks, run_chunk
from pendula.studies.breathers.fates import map_fates
from pendula.studies.chaos.ensembles import measure_ensembles
from pendula.studies.paper.runs import run_sweep
from pendula.studies.unbounded.long_runs import spread_case
from problems import problem_of

FAST = {"name": "dop853", "rtol": 1e-6, "atol": 1e-6}
CASE = problem_of("fig4_small", half_width=6, end_time=3.0, output_step=0.25, solver=FAST)
ENDLESS = [CASE.changed(half_width=None, end_time=end, omega=0.5) for end in (40.0,)] * 2
WINDOWS = [(1.0, 2.0)]


def maps():
    return map_fates({-4: CASE, 8: CASE}, [1.0, 3.0])


def ensembles():
    swept = {"problem": CASE.plain(), "half_widths": [5, 8], "members": 2, "windows": 2 * WINDOWS}
    return measure_ensembles({"one": swept}, 1e-3, 1)


def sweeps():
    """Of these chains all from M = 25 on stand for each other."""
    return run_sweep("one", CASE, [4, 25, 30, 40, 6], WINDOWS)


def endless():
    """The fronts of members differ, and so does the number of cells that each has."""
    return spread_case("one", ENDLESS, 1e-20, 3, 0.5, 1)


def in_chunks(count, problems, make):
    return join_chunks([run_chunk(problems, make, chunk, count) for chunk in range(count)])


@pytest.mark.parametrize("study", [maps, ensembles, sweeps, endless])
def test_the_number_of_parts_changes_no_bit(study):
    results = (study().make(partial(in_chunks, count)) for count in (1, 3, 8))
    unsplit, *split = (result[0] if isinstance(result, tuple) else result for result in results)
    for name, variable in unsplit.items():
        for joined_result in split:
            computed, expected = (
                getattr(values, "values", values) for values in (joined_result[name], variable)
            )
            np.testing.assert_array_equal(computed, expected, err_msg=name)
