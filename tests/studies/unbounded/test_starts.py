"""Initial conditions other than the paper's that grow on the infinite chain."""

import numpy as np
import pytest
import yaml
from helpers import ROOT
from oracle import slope
from pendula.studies.unbounded.active_sites import run_long
from problems import problem_of
from scipy.integrate import solve_ivp

STARTS = yaml.safe_load((ROOT / "config/unbounded.yaml").read_text())["unbounded"]["starts"]


@pytest.mark.parametrize("pair", STARTS["values"])
def test_scipy_sees_the_same_norm_until_chaos_and_growth_afterwards(pair):
    """SciPy's DOP853 on plain NumPy follows 201 pairs, whose ends the front has not reached."""
    start, times = np.zeros((2, 201), complex), np.array([0.0, 5.0, 40.0])
    start[:, 100] = pair
    run = solve_ivp(
        lambda _, y: slope(y.reshape(2, 201), (1.0, 1.0, -4.0), "dirichlet").ravel(),
        (0.0, 40.0),
        start.ravel(),
        "DOP853",
        times,
        rtol=1e-8,
        atol=1e-8,
    )
    by_scipy = np.sqrt((np.abs(run.y) ** 2).sum(axis=0))
    case = problem_of(
        "fig3_large",
        half_width=None,
        initial={0: pair},
        end_time=40.0,
        output_step=1.0,
        solver={"name": "dop853", "rtol": 1e-8, "atol": 1e-8},
    )
    ours = run_long(case, 1e-20)["l2"]
    assert ours[5] == pytest.approx(by_scipy[1], rel=1e-4)
    for norms in (by_scipy, ours):
        assert norms[-1] > 2.0 * norms[0]
