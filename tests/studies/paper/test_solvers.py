"""What is measured of the solvers, and the tables that are made of it."""

import numpy as np
import pytest
from pendula.studies.paper.solvers import compare_solvers, trust_solvers
from pendula.studies.paper.tables import agreement_part, energy_part, sweep_part, trust_part


@pytest.fixture(scope="module")
def compared(trajectories, swept_pairs):
    return compare_solvers(trajectories, *swept_pairs)


def test_drift_is_measured_from_the_start(trajectories, compared):
    for name, trajectory in trajectories.items():
        case, solver = name.split(".")
        expected = np.abs(trajectory["energy"].values - 7.0)
        drift = compared["drift"].sel(case=case, solver=solver)
        assert np.allclose(drift, expected, rtol=1e-12, atol=0)


def test_a_drift_is_kept_up_to_twice_the_stated_order(trajectories, swept_pairs):
    changed = dict(trajectories)
    for solver, drift in (("ode45", 1.9e-6), ("dop853", 2.1e-6)):
        run = trajectories[f"fig2_small.{solver}"]
        changed[f"fig2_small.{solver}"] = run.assign(energy=7.0 + drift * (run["tau"] == 5.0))
    found = compare_solvers(changed, *swept_pairs).sel(case="fig2_small")
    assert found["kept"].sel(solver="ode45").values.tolist() == [1, 1]
    assert found["kept"].sel(solver="dop853").values.tolist() == [0, 0]


@pytest.mark.parametrize(
    ("pair", "expected"),
    [
        ("ode45 - crank_nicolson", 0.019 / 1.02),
        ("ode45 - delfour_fortin_payre", 0.019 / 1.02),
        ("ode45 - dop853", 0.001 / 1.001),
    ],
)
def test_differences_are_relative_to_the_largest_value(compared, pair, expected):
    # A of the made-up norms is largest at tau = 0, where it alone sets the difference
    difference = compared["difference"].sel(pair=pair, tau=0.0)
    assert np.allclose(difference, expected, rtol=1e-12)


def test_the_largest_of_the_four_differences_counts(trajectories, swept_pairs):
    changed = dict(trajectories)
    other = changed["fig2_small.dop853"].copy(deep=True)
    other["l2"][1, 7] += 3.0
    changed["fig2_small.dop853"] = other
    difference = compare_solvers(changed, *swept_pairs)["difference"].sel(case="fig2_small")
    scale = float(max(other["l2"].sel(component="B").max(), 3 * 2 * 1.001))
    here = difference.sel(pair="ode45 - dop853").isel(tau=7)
    mine = trajectories["fig2_small.ode45"]["l2"][1, 7]
    assert np.isclose(here, abs(mine - other["l2"][1, 7]) / scale)


def test_the_divergence_time_is_the_first_visible_difference(compared):
    time = compared["divergence_time"]
    assert (time.sel(pair="ode45 - crank_nicolson") == 0).all()
    assert (time.sel(pair="ode45 - dop853") == np.inf).all()


def test_tables_quote_what_was_measured(trajectories, compared, make_trajectory):
    *_, energy = energy_part(compared)
    assert "| fig2_small | 1e-06 |" in energy and "early, to the end" in energy
    *_, agreement = agreement_part(compared)
    assert "0.0 (" in agreement and "never (" in agreement
    *_, sweeps = sweep_part(compared)
    assert "| fig5_left | [10, 50] |" in sweeps and "0.0e+00 / 0.0e+00" in sweeps
    true = dict.fromkeys(("fig2_small", "fig2_large"), make_trajectory(scale=1.02))
    *_, horizons = trust_part(trust_solvers(trajectories, true))
    assert "| fig2_small | crank_nicolson | never | never |" in horizons
    assert "| fig2_small | ode45 | 0 | 0 |" in horizons
