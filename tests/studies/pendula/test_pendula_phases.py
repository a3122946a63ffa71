"""The cases of the paper as pendula: envelopes, the chaotic state, passages over the top, films."""

import numpy as np
import pytest
from on_pendula import pendula
from pendula.datasets.netcdf import as_xarray
from pendula.models.pendula import angles_of
from pendula.simulation.simulate import simulate
from pendula.studies.pendula import chaotic_state, figures_phases, phases, runs
from problems import problem_of
from scipy.fft import dst
from scipy.special import ellipk

FAST = {"name": "taylor", "rtol": 1e-8, "atol": 1e-8}


def case(name="fig4_small", **changes):
    return problem_of(name, **{"solver": FAST, "end_time": 2.0, "output_step": 0.25} | changes)


def measured(problems, mus, members=1):
    """Return the phases of cases, and members of the first of them."""
    drawn = next(iter(problems)), 1e-6, members, 1
    return as_xarray(*phases.measure_phases(problems, mus, 4, *drawn))


def test_the_envelope_of_the_start_is_that_of_the_data():
    problem = runs.at_mu(case(initial={0: (1.0 + 2.0j, 0.5j)}), 0.3)
    _, moduli = runs.envelopes(problem)
    assert moduli[:, 30, 0] == pytest.approx([np.sqrt(5.0), 0.5], rel=1e-15)
    assert not moduli[:, :30, 0].any()


def test_the_envelope_tends_to_the_modulus_as_mu_squared():
    problem = case("fig2_large", end_time=1.0)
    limit, *others = (runs.envelopes(runs.at_mu(problem, mu))[1] for mu in (0.0, 0.02, 0.01))
    coarse, fine = (np.abs(one - limit).max() for one in others)
    assert coarse / fine == pytest.approx(4.0, rel=0.15)


def test_phases_are_those_of_each_case_and_mu():
    problems = {name: case(name) for name in ("fig2_large", "fig4_small")}
    data = measured(problems, [0.3, 0.1], members=3)
    run = simulate(problems["fig4_small"])
    assert data["l2"].sel(case="fig4_small", mu=0.0).values == pytest.approx(run.l2, rel=1e-13)
    shown = data["larger_modulus"].sel(case="fig4_small", mu=0.1)
    largest = data["linf"].sel(case="fig4_small", mu=0.1).max("component")[::4].values
    assert shown.max("site").values == pytest.approx(largest, rel=1e-6)
    assert np.isinf(data["theorem_1_power"].sel(case="fig4_small"))
    assert data["member_mu"].values.tolist() == [0.3, 0.3, 0.3]
    one = data.sel(case="fig2_large", mu=0.3)
    ratio = (one["l2"] ** 2).sum("component").max() / one["theorem_1_power"]
    found = data["over_theorem_1"].values
    assert len(set(found)) == 3 and found == pytest.approx(float(ratio), rel=1e-3)


def test_the_bound_of_a_member_follows_from_its_own_energy():
    """In one period hardly anything moves: P and the bound are those of the data, 25 and H / 2."""
    problem = case("fig2_large", initial={0: (5.0, 0.0)}, end_time=0.01, output_step=0.01)
    energy = simulate(problem).energy[0]
    assert phases.over_theorem_1(problem, 0.3) == pytest.approx(25.0 / (energy / 2.0), rel=0.02)


def test_runs_end_where_the_drive_makes_pendula_faster_without_end():
    """Without it this run takes some 1e10 steps to its end."""
    strong = case("fig3_small", gamma=3.0, end_time=50.0)
    data = measured({"fig3_small": strong}, [0.3])
    late = data.isel(case=0).sel(mu=0.3)["l2"]
    assert late.isel(tau=slice(2)).notnull().all() and late.isel(tau=slice(8, None)).isnull().all()
    assert data["l2"].sel(mu=0.0).notnull().all() and data.attrs["comment"] == runs.NOT_KNOWN
    assert data["over_theorem_1"].notnull().all()
    assert figures_phases.gather_phases(data)["l2"].sel(mu=0.3)[0, -1].isnull()
    found = chaotic_state.passage(runs.at_mu(strong, 0.3), 8)
    assert found.time < 2.0 and np.isnan(found.angle[-1]) and found.power > 100.0


def test_the_spectrum_is_that_of_the_sine_transform_and_has_the_mean_square():
    rng = np.random.default_rng(3)
    half = rng.normal(size=(2, 31, 4)) + 1j * rng.normal(size=(2, 31, 4))
    even = np.concatenate([half[:, :0:-1], half], axis=1)
    found = chaotic_state.spectrum(even)
    assert found.mean() == pytest.approx((np.abs(even) ** 2).mean(), rel=1e-12)
    transformed = dst(even, type=1, axis=1, norm="ortho")
    expected = (np.abs(transformed) ** 2).mean(axis=(0, 2))[::2]
    assert found / found.sum() == pytest.approx(expected / expected.sum(), rel=1e-10)


def test_members_of_the_chaotic_state_are_reduced_over_the_window_alone():
    found = chaotic_state.measure_sea(case(end_time=8.0), [0.15], (4.0, 8.0), 1e-3, 2, 1)
    data = as_xarray(*found)
    assert data["modulus_share"].sum("modulus").values == pytest.approx(1.0)
    l2, power = data["l2_level"].values, data["site_power"].values * 61
    assert (l2**2 <= power).all() and (l2**2 > 0.8 * power).all()
    assert data["wave_power"].mean("even_wave").values * 2 * 61 == pytest.approx(power, rel=1e-9)


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


def test_a_passage_is_at_the_first_output_beyond_the_top():
    """With the velocity v at the bottom it is there after (2 / v) K(m), m = (2 / v)^2."""
    moving = one_pendulum(0.0, 2.4, end_time=3.0)
    exact = 2.0 / 2.4 * ellipk((2.0 / 2.4) ** 2) * 0.3**2 / 2.0
    step = runs.period_of(moving) / 16
    assert exact < chaotic_state.passage(moving, 16).time < exact + step


def test_small_mu_stays_below_the_top_and_large_mu_goes_over_it():
    found = chaotic_state.measure_over_the_top(case(end_time=6.0), [0.1, 0.3], 8, 1e-6, 2, 1, 5.0)
    data = as_xarray(*found)
    assert np.isinf(data["passage_time"].sel(mu=0.1)).all()
    assert (data["passage_time"].sel(mu=0.3) < 5.0).all()
    assert data["passed"].isel(tau=-1).values.tolist() == [0.0, 1.0]
    assert data["angle_power"].sel(mu=0.3).min() > data["angle_power"].sel(mu=0.1).max()


@pytest.mark.parametrize(("angle", "velocity"), [(1.0, 0.0), (0.0, 6.0)])
def test_a_film_shows_every_swing_and_leaves_whole_turns_out(angle, velocity):
    moving = one_pendulum(angle, velocity)
    shown = phases.filmed(moving, 0, 4, 12)
    assert shown.shape == (49, 2, 1) and shown.dtype == np.int8
    period = runs.period_of(moving)
    times = {"end_time": 4 * period, "output_step": period / 12, "snapshot_every": 1}
    exact = simulate(moving.changed(**times)).snapshots[0][0, 0]
    off = np.exp(1j * np.pi / 127 * shown[:, 0, 0]) - np.exp(1j * exact)
    assert np.abs(off).max() < 0.5 * np.pi / 126
