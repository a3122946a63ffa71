"""The energy's drift and the agreement of the solvers."""

import numpy as np
import pytest
from pendula.drawing import style
from pendula.studies.paper import solver_figures


def test_drift_is_measured_from_the_start(trajectories, gathered):
    drift = gathered["drift"]["drift"]
    for (case, solver), trajectory in trajectories.items():
        expected = np.abs(trajectory["energy"].values - 7.0)
        assert np.allclose(drift.sel(case=case, solver=solver), expected, rtol=1e-12, atol=0)


def test_the_papers_claim_depends_on_the_size_of_the_data(gathered):
    assert gathered["drift"]["claim"].values.tolist() == [1e-6, 1e-4]


def test_energy_panels_draw_each_solver_and_the_claim(gathered):
    figure = solver_figures.draw_drift(gathered["drift"])
    for axes, claim in zip(figure.axes, [1e-6, 1e-4], strict=True):
        *curves, line = axes.get_lines()
        assert axes.get_yscale() == "log"
        drawn = [style.SOLVER_NAMES[name] for name in gathered["drift"]["solver"].values]
        assert sorted(curve.get_label() for curve in curves) == sorted(drawn)
        assert set(line.get_ydata()) == {claim}


@pytest.mark.parametrize(
    ("pair", "expected"),
    [
        ("ode45 - crank_nicolson", 0.019 / 1.02),
        ("crank_nicolson - dop853", 0.02 / 1.02),
        ("ode45 - dop853", 0.001 / 1.001),
    ],
)
def test_differences_are_relative_to_the_largest_value(gathered, pair, expected):
    # A of the made-up norms is largest at tau = 0, where it alone sets the difference
    difference = gathered["agreement"]["difference"].sel(pair=pair, tau=0.0)
    assert np.allclose(difference, expected, rtol=1e-12)


def test_the_largest_of_the_four_differences_counts(trajectories):
    changed = dict(trajectories)
    other = changed["fig2_small", "dop853"].copy(deep=True)
    other["l2"][1, 7] += 3.0
    changed["fig2_small", "dop853"] = other
    difference = solver_figures.gather_agreement(changed)["difference"].sel(case="fig2_small")
    scale = float(max(other["l2"].sel(component="B").max(), 3 * 2 * 1.001))
    here = difference.sel(pair="ode45 - dop853").isel(tau=7)
    mine = trajectories["fig2_small", "ode45"]["l2"][1, 7]
    assert np.isclose(here, abs(mine - other["l2"][1, 7]) / scale)


def test_the_divergence_time_is_the_first_visible_difference(gathered):
    time = gathered["agreement"]["divergence_time"]
    assert (time.sel(pair="ode45 - crank_nicolson") == 0).all()
    assert (time.sel(pair="ode45 - dop853") == np.inf).all()


def test_agreement_panels_draw_each_pair_and_what_is_visible(gathered):
    for axes in solver_figures.draw_agreement(gathered["agreement"]).axes:
        lines = axes.get_lines()
        assert len([line for line in lines if " / " in line.get_label()]) == 3
        assert set(lines[-1].get_ydata()) == {solver_figures.VISIBLE}
