"""What is measured of the solvers, and the tables that are made of it."""

import numpy as np
import pytest
from pendula.studies.paper.solvers import compare, trust
from pendula.studies.paper.tables import agreement_part, energy_part, sweep_part, trust_part


@pytest.fixture
def references(make_trajectory):
    true = make_trajectory(scale=1.02)
    return {"fig2_small": true, "fig2_large": true}


def test_drift_is_measured_from_the_start(trajectories, swept_pairs):
    drift = compare(trajectories, swept_pairs)["drift"]
    for (case, solver), trajectory in trajectories.items():
        expected = np.abs(trajectory["energy"].values - 7.0)
        assert np.allclose(drift.sel(case=case, solver=solver), expected, rtol=1e-12, atol=0)


def test_the_stated_drift_depends_on_the_size_of_the_data(gathered):
    assert gathered["drift"]["stated_drift"].values.tolist() == [1e-6, 1e-4]


@pytest.mark.parametrize(
    ("pair", "expected"),
    [
        ("ode45 - crank_nicolson", 0.019 / 1.02),
        ("ode45 - delfour_fortin_payre", 0.019 / 1.02),
        ("ode45 - dop853", 0.001 / 1.001),
    ],
)
def test_differences_are_relative_to_the_largest_value(gathered, pair, expected):
    # A of the made-up norms is largest at tau = 0, where it alone sets the difference
    difference = gathered["agreement"]["largest_so_far"].sel(pair=pair, tau=0.0)
    assert np.allclose(difference, expected, rtol=1e-12)


def test_the_largest_of_the_four_differences_counts(trajectories, swept_pairs):
    changed = dict(trajectories)
    other = changed["fig2_small", "dop853"].copy(deep=True)
    other["l2"][1, 7] += 3.0
    changed["fig2_small", "dop853"] = other
    difference = compare(changed, swept_pairs)["difference"].sel(case="fig2_small")
    scale = float(max(other["l2"].sel(component="B").max(), 3 * 2 * 1.001))
    here = difference.sel(pair="ode45 - dop853").isel(tau=7)
    mine = trajectories["fig2_small", "ode45"]["l2"][1, 7]
    assert np.isclose(here, abs(mine - other["l2"][1, 7]) / scale)


def test_the_divergence_time_is_the_first_visible_difference(gathered):
    time = gathered["agreement"]["divergence_time"]
    assert (time.sel(pair="ode45 - crank_nicolson") == 0).all()
    assert (time.sel(pair="ode45 - dop853") == np.inf).all()


def test_tables_quote_what_was_measured(trajectories, swept_pairs, references):
    data = compare(trajectories, swept_pairs)
    *_, energy = energy_part(data)
    assert "| fig2_small | 1e-06 |" in energy and "early, to the end" in energy
    *_, agreement = agreement_part(data)
    assert "0.0 (" in agreement and "never (" in agreement
    *_, sweeps = sweep_part(data)
    assert "| fig5_left | [10, 50] |" in sweeps and "0.0e+00 / 0.0e+00" in sweeps
    *_, horizons = trust_part(trust(trajectories, references))
    assert "| fig2_small | crank_nicolson | never | never |" in horizons
    assert "| fig2_small | ode45 | 0 | 0 |" in horizons
