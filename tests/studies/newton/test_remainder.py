"""The error of the expansion: its order, and what a wrong slow time does."""

import numpy as np
import pytest
from latticode.datasets.netcdf import as_xarray
from pendula.studies.newton import remainder
from problems import problem_of

TIGHT = {"name": "taylor", "rtol": 1e-14, "atol": 1e-14}
MUS = (0.1, 0.05, 0.025)


@pytest.mark.parametrize("case", ["fig2_small", "fig3_small"])
def test_the_error_is_of_the_third_order_and_with_a_wrong_slow_time_of_the_first(case):
    changes = {"half_width": 6, "end_time": 0.5, "output_step": 0.01, "solver": TIGHT}
    contents = remainder.measure_remainder({case: problem_of(case, **changes)}, MUS)
    error = as_xarray(*contents)["error"].sel(case=case).transpose("slow_time", "mu").values
    orders = np.log2(error[:, :-1] / error[:, 1:])
    assert orders[:, -1] == pytest.approx([3.0, 1.0], abs=0.15)


def test_amplitudes_are_those_of_one_run():
    problem = problem_of(end_time=0.4, output_step=0.1, solver=TIGHT, half_width=5)
    amplitudes = remainder.integrate_amplitudes(problem)
    run = remainder.simulate(problem)
    np.testing.assert_allclose(amplitudes[-1], run.final, rtol=0, atol=1e-13)
    np.testing.assert_allclose(np.abs(amplitudes).max(axis=2).T, run.linf, rtol=0, atol=1e-13)
