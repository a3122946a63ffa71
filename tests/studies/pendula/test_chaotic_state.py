"""The chaotic state of the pendula, and passages over the top."""

import numpy as np
import pytest
from latticode.datasets.netcdf import as_xarray
from on_pendula import pendula
from pendula.models.pendula import angles_of
from pendula.studies.pendula import chaotic_state, runs
from problems import problem_of

FAST = {"name": "taylor", "rtol": 1e-8, "atol": 1e-8}


def case(name="fig4_small", **changes):
    return problem_of(name, **{"solver": FAST, "end_time": 2.0, "output_step": 0.25} | changes)


def test_runs_end_where_the_drive_makes_pendula_faster_without_end():
    """Without it this run takes some 1e10 steps to its end."""
    strong = case("fig3_small", gamma=3.0, end_time=50.0)
    found = chaotic_state.passage(runs.at_mu(strong, 0.3), 8)
    assert found.time < 2.0 and np.isnan(found.angle[-1]) and found.power > 100.0


def test_members_of_the_chaotic_state_are_reduced_over_the_window_alone():
    found = chaotic_state.measure_sea(case(end_time=8.0), [0.15], (4.0, 8.0), 1e-3, 2, 1)
    data = as_xarray(*found)
    assert data["modulus_share"].sum("modulus").values == pytest.approx(1.0)


def one_pendulum(angle: float, velocity: float = 0.0, **changes):
    """Return a pair that moves as one, which is a pendulum without a drive; mu = 0.3."""
    start = {0: ((angle - 1j * velocity) / 0.6,) * 2}
    return pendula(half_width=0, epsilon=0.0, mu=0.3, omega=0.0, initial=start, **changes)


@pytest.mark.parametrize(("share", "goes"), [(0.999, False), (1.001, True)])
def test_a_pendulum_goes_over_the_top_with_more_energy_than_there(share, goes):
    """From below with the velocity v it comes to the top if v^2 / 2 > 2."""
    moving = one_pendulum(0.0, 2.0 * share, end_time=3.0)
    assert angles_of(moving.initial, 0.0, 0.3)[1, 0, 0] == pytest.approx(2.0 * share)
    found = chaotic_state.passage(moving, 16)
    assert np.isfinite(found.time) == goes
    assert (found.angle[-1] > np.pi) == goes and (np.diff(found.angle) >= 0.0).all()


def test_small_mu_stays_below_the_top_and_large_mu_goes_over_it():
    found = chaotic_state.measure_over_the_top(case(end_time=6.0), [0.1, 0.3], 8, 1e-6, 2, 1, 5.0)
    data = as_xarray(*found)
    assert np.isinf(data["passage_time"].sel(mu=0.1)).all()
    assert (data["passage_time"].sel(mu=0.3) < 5.0).all()
    assert data["passed"].isel(tau=-1).values.tolist() == [0.0, 1.0]
    assert data["angle_power"].sel(mu=0.3).min() > data["angle_power"].sel(mu=0.1).max()
    # C_N = 4 N (c + sqrt(c^2 + H / (2 N))) with c = 2 + 4 and the energy of (1, 0.1) at Omega = 0
    energy = 0.25 * (1.0 + 1e-4) - 2.0 * 1.01 - 0.9**2
    allowed = 4.0 * 61 * (6.0 + np.sqrt(36.0 + energy / 122.0))
    assert data["theorem_3_power"].values == pytest.approx(allowed, rel=1e-6)
