"""How far trajectories are from the reference, and until when they are proved."""

import numpy as np
import pytest
from latticode.measures.difference import VISIBLE
from pendula.studies.paper.solvers import trust_solvers
from two_norms import run


def test_each_solver_has_its_horizon():
    bad = run(changes={("l2", 1, 2): 1.008, ("l2", 1, 6): 1.02})
    runs = {"case": {"good": run(), "bad": bad, "other": run(omega=7.0)}}
    found = trust_solvers(runs, {"case": run()}).sel(case="case")
    horizons = found["horizon"]
    assert horizons.sel(solver="bad") == 3.0
    assert (horizons.sel(solver="good") == np.inf).all()
    assert horizons.sel(solver="other").isnull().all()
    assert found["visible"] == VISIBLE


@pytest.mark.parametrize(
    ("omega", "end", "slope", "until"),
    [(8.0, 5.0, 0.002, 5.0), (8.0, 3.0, 0.008, 1.0), (7.0, 5.0, 0.002, np.nan)],
)
def test_a_curve_is_proved_as_long_as_its_bound_is_not_visible(omega, end, slope, until):
    """The bound is a part of the smallest full scale, that of B, which is 1 in l-infinity."""
    proved = run(omega=omega).sel(tau=slice(end))
    proved = proved.assign(bound=slope * proved["tau"], l2=2.0 * proved["l2"])
    found = trust_solvers({"case": {"run": run()}}, {"case": run()}, {"case": proved})
    bound = found["proven_bound"].sel(case="case")
    expected = slope * bound["tau"] if omega == 8.0 else np.nan * bound
    np.testing.assert_allclose(bound, expected.where(bound["tau"] <= end))
    np.testing.assert_array_equal(found["proved_until"], [until])
