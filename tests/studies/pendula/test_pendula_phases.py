"""The paper's phases in the real pendula: envelopes, the sea, passages over the top, and films."""

import numpy as np
import pytest
from on_pendula import load_with, pendula
from pendula.configuration.files import ConfigurationError
from pendula.configuration.paper import paper
from pendula.datasets.netcdf import as_xarray
from pendula.drawing import style
from pendula.models.pendula import angles_of
from pendula.numerics.elementary import modulus
from pendula.problem import Constants
from pendula.simulation.simulate import simulate
from pendula.studies.pendula import envelope, film, over_the_top, phases, phases_figure, sea
from pendula.studies.pendula.followed import NOT_KNOWN
from pendula.studies.pendula.mathieu import strings_grow
from problems import problem_of
from scipy.fft import dst
from scipy.special import ellipk

FAST = {"name": "taylor", "rtol": 1e-8, "atol": 1e-8}
DRAWN = ("fig3_small", 1e-6, 2, 1)


def case(name="fig4_small", **changes):
    return problem_of(name, **{"solver": FAST, "end_time": 2.0, "output_step": 0.25} | changes)


def test_the_envelope_of_the_start_is_that_of_the_data():
    problem = envelope.at_mu(case(initial={0: (1.0 + 2.0j, 0.5j)}), 0.3)
    _, moduli = envelope.envelopes(problem)
    assert moduli[:, 30, 0] == pytest.approx([np.sqrt(5.0), 0.5], rel=1e-15)
    assert not moduli[:, :30, 0].any()


def test_the_envelope_tends_to_the_modulus_as_mu_squared():
    problem = case("fig2_large", end_time=1.0)
    _, limit = envelope.envelopes(problem)
    off = [
        np.abs(envelope.envelopes(envelope.at_mu(problem, mu))[1] - limit).max()
        for mu in (0.02, 0.01)
    ]
    assert off[0] / off[1] == pytest.approx(4.0, rel=0.15)


def test_states_of_the_amplitudes_have_the_moduli_of_one_run():
    problem = case()
    times, amplitudes = envelope.states(problem)
    run, moduli = envelope.envelopes(problem)
    assert times.tolist() == run.tau.tolist()
    assert modulus(amplitudes) == pytest.approx(moduli, abs=1e-6)


def test_norms_of_all_cases_stand_by_mu_with_the_amplitudes_first():
    problems = {name: case(name) for name in ("fig2_small", "fig4_small")}
    data = as_xarray(*phases.measure_phases(problems, [0.1, 0.3], 4, "fig2_small", 1e-6, 1, 1))
    assert data["mu"].values.tolist() == [0.0, 0.1, 0.3]
    run = simulate(problems["fig4_small"])
    assert data["l2"].sel(case="fig4_small", mu=0.0).values == pytest.approx(run.l2, rel=1e-13)
    shown = data["larger_modulus"].sel(case="fig4_small", mu=0.1)
    assert shown.shape == (61, 3)
    largest = data["linf"].sel(case="fig4_small", mu=0.1).max("component")[::4].values
    assert shown.max("site").values == pytest.approx(largest, rel=1e-6)
    assert np.isinf(data["theorem_1_power"].sel(case="fig4_small"))
    assert (data["theorem_3_power"] > 100.0).all()


def test_members_are_held_to_the_bound_at_the_largest_mu_by_their_own_data():
    problems = {"fig2_large": case("fig2_large")}
    drawn = ("fig2_large", 1e-6, 3, 1)
    data = as_xarray(*phases.measure_phases(problems, [0.3, 0.1], 4, *drawn))
    assert data["member_mu"].values.tolist() == [0.3, 0.3, 0.3]
    one = data.sel(case="fig2_large", mu=0.3)
    ratio = (one["l2"] ** 2).sum("component").max() / one["theorem_1_power"]
    found = data["over_theorem_1"].values
    assert len(set(found)) == 3 and found == pytest.approx(float(ratio), rel=1e-3)


def test_what_a_member_may_reach_is_asked_of_its_own_energy():
    """In one period hardly anything moves: P and the bound are those of the data, 25 and H / 2."""
    problem = case("fig2_large", initial={0: (5.0, 0.0)}, end_time=0.01, output_step=0.01)
    energy = simulate(problem).energy[0]
    assert phases.over_theorem_1(problem, 0.3) == pytest.approx(25.0 / (energy / 2.0), rel=0.02)


def test_the_spectrum_is_that_of_the_sine_transform_and_has_the_mean_square():
    waves, rng = sea.Waves(61), np.random.default_rng(3)
    half = rng.normal(size=(2, 31, 4)) + 1j * rng.normal(size=(2, 31, 4))
    even = np.concatenate([half[:, :0:-1], half], axis=1)
    found = waves.spectrum(even)
    assert found.mean() == pytest.approx((np.abs(even) ** 2).mean(), rel=1e-12)
    transformed = dst(even, type=1, axis=1, norm="ortho")
    expected = (np.abs(transformed) ** 2).mean(axis=(0, 2))[::2]
    assert found / found.sum() == pytest.approx(expected / expected.sum(), rel=1e-10)


def test_members_of_the_sea_are_reduced_over_the_window_alone():
    data = as_xarray(*sea.measure_sea(case(end_time=8.0), [0.15], (4.0, 8.0), 1e-3, 2, 1))
    assert dict(data["site_power"].sizes) == {"mu": 2, "member": 2}
    assert data["modulus_share"].sum("modulus").values == pytest.approx(1.0)
    l2, power = data["l2_level"].values, data["site_power"].values * 61
    assert (l2**2 <= power).all() and (l2**2 > 0.8 * power).all()
    assert data["wave_power"].mean("even_wave").values * 2 * 61 == pytest.approx(power, rel=1e-9)


def test_runs_end_where_the_drive_makes_pendula_faster_without_end():
    """Without it this run takes some 1e10 steps to its end."""
    strong = {"gamma": 3.0, "end_time": 50.0}
    data = as_xarray(
        *phases.measure_phases({"fig3_small": case("fig3_small", **strong)}, [0.3], 4, *DRAWN)
    ).isel(case=0)
    late = data.sel(mu=0.3)["l2"]
    assert late.isel(tau=slice(2)).notnull().all() and late.isel(tau=slice(8, None)).isnull().all()
    assert data.sel(mu=0.0)["l2"].notnull().all() and data.attrs["comment"] == NOT_KNOWN
    assert data["over_theorem_1"].notnull().all()
    assert phases_figure.gather_phases(data.expand_dims("case"))["l2"].sel(mu=0.3)[0, -1].isnull()
    found = over_the_top.passage(envelope.at_mu(case("fig3_small", **strong), 0.3), 8)
    assert found.time < 2.0 and np.isnan(found.angle[-1]) and found.power > 100.0


def test_the_note_on_edited_cases_covers_no_panel(tmp_path):
    problems = {"fig3_small": case("fig3_small")}
    data = phases_figure.gather_phases(
        as_xarray(*phases.measure_phases(problems, [0.3], 4, *DRAWN))
    )
    figure = phases_figure.draw_phases(data)
    files = [tmp_path / f"a.{kind}" for kind in ("png", "pdf", "nc", "json")]
    style.save(figure, data, *files, 8 * ["fig2_small.end_time (4 in place of 50)"])
    note = next(one for one in figure.texts if one.get_text().startswith("Not the paper's"))
    assert not any(one.get_tightbbox().overlaps(note.get_window_extent()) for one in figure.axes)


def test_only_a_drive_that_beats_the_strings_loses_pendula():
    """By Mathieu's equation: a <= 4 epsilon mu^2 / omega^2 is stable up to q = b_1(a)."""
    of_paper = [Constants.of(one) for one in paper()["cases"].values()]
    assert not any(strings_grow(one, mu) for one in of_paper for mu in (0.05, 0.15, 0.3))
    plain = {"epsilon": 1.0, "gamma": 1.0, "omega": -4.0}
    for changes in ({"gamma": 3.0}, {"epsilon": 2.0}, {"epsilon": -0.1, "gamma": 0.0}):
        assert strings_grow(Constants(**plain | changes), 0.3)
    free = Constants(epsilon=0.0, gamma=1.0, omega=0.0)
    assert not strings_grow(free, np.sqrt(0.9 / 2.0)) and strings_grow(free, np.sqrt(0.91 / 2.0))


@pytest.mark.parametrize(
    ("topic", "change", "says"),
    [
        ("film", {"mu": 0.4}, r"pendula\.film\.mu: has 0\.4, .* fig3_large .*ever faster"),
        ("phases", {"mus": [0.495]}, r"pendula\.phases\.mus: has 0\.495, .* too strong"),
    ],
)
def test_a_drive_without_bounds_is_refused_where_no_run_can_follow_it(topic, change, says):
    with pytest.raises(ConfigurationError, match=says):
        load_with(topic, change)


def one_pendulum(angle: float, **changes):
    """Return a pair that moves as one, which is a pendulum without a drive."""
    start = {0: (angle / 0.6, angle / 0.6)}
    return pendula(half_width=0, epsilon=0.0, mu=0.3, omega=0.0, initial=start, **changes)


def test_a_period_is_that_of_small_swings():
    problem = one_pendulum(1e-4, end_time=1.0)
    period = over_the_top.period_of(problem)
    run = simulate(problem.changed(end_time=period, output_step=period, snapshot_every=1))
    assert run.snapshots[0][0, 0, -1] == pytest.approx(1e-4, rel=1e-6)


@pytest.mark.parametrize(("share", "goes"), [(0.999, False), (1.001, True)])
def test_a_pendulum_goes_over_the_top_with_more_energy_than_there(share, goes):
    """From below with the velocity v it comes to the top if v^2 / 2 > 2."""
    velocity = -2.0j * share / 0.6
    moving = one_pendulum(0.0, end_time=3.0).changed(initial=np.full((2, 1), velocity))
    assert angles_of(moving.initial, 0.0, 0.3)[1, 0, 0] == pytest.approx(2.0 * share)
    found = over_the_top.passage(moving, 16)
    assert np.isfinite(found.time) == goes
    assert (found.angle[-1] > np.pi) == goes and (np.diff(found.angle) >= 0.0).all()


def test_a_passage_is_at_the_first_output_beyond_the_top():
    """With the velocity v at the bottom it is there after (2 / v) K(m), m = (2 / v)^2."""
    velocity = 2.4
    moving = one_pendulum(0.0, end_time=3.0).changed(initial=np.full((2, 1), -1.2j / 0.3))
    assert angles_of(moving.initial, 0.0, 0.3)[1, 0, 0] == pytest.approx(velocity)
    exact = 2.0 / velocity * ellipk((2.0 / velocity) ** 2) * 0.3**2 / 2.0
    step = over_the_top.period_of(moving) / 16
    assert exact < over_the_top.passage(moving, 16).time < exact + step


def test_shares_and_rates_count_who_was_waiting():
    times = np.array([5.0, 12.0, 15.0, np.inf])
    share = over_the_top.passed_by(times, np.array([4.0, 5.0, 14.0, 50.0]))
    assert share.value.tolist() == [0.0, 0.25, 0.5, 0.75]
    assert (share.low <= share.value).all() and (share.high >= share.value).all()
    rate = over_the_top.event_rate(times, 10.0, 50.0)
    assert rate.value == pytest.approx(2.0 / (2.0 + 5.0 + 40.0)) and rate.low < rate.value
    assert np.isnan(over_the_top.event_rate(times[:1], 10.0, 50.0).value)


def test_the_rate_of_an_exponential_law_is_found():
    draws = 10.0 + np.random.default_rng(0).exponential(20.0, 4000)
    times = np.where(draws > 50.0, np.inf, draws)
    rate = over_the_top.event_rate(times, 10.0, 50.0)
    assert rate.low < 0.05 < rate.high and rate.high < 1.1 * rate.low


def test_small_mu_stays_below_the_top_and_large_mu_goes_over_it():
    problem = case(end_time=6.0)
    data = as_xarray(
        *over_the_top.measure_over_the_top(problem, [0.1, 0.3], 8, 1e-6, 2, 1, settled=5.0)
    )
    assert np.isinf(data["passage_time"].sel(mu=0.1)).all()
    assert (data["passage_time"].sel(mu=0.3) < 5.0).all()
    assert data["passed"].isel(tau=-1).values.tolist() == [0.0, 1.0]
    assert data["angle_power"].sel(mu=0.3).min() > data["angle_power"].sel(mu=0.1).max()


def test_a_film_shows_every_swing_and_leaves_whole_turns_out():
    swinging = film.filmed(one_pendulum(1.0), 0, 4, 12)
    assert swinging.shape == (49, 2, 1) and swinging.dtype == np.int8
    exact = simulate(one_pendulum(1.0).changed(
        end_time=4 * over_the_top.period_of(one_pendulum(1.0)),
        output_step=over_the_top.period_of(one_pendulum(1.0)) / 12, snapshot_every=1,
    )).snapshots[0][0, 0]  # fmt: skip
    assert swinging[:, 0, 0] * (np.pi / 127) == pytest.approx(exact, abs=0.5 * np.pi / 126)
    turning = film.filmed(one_pendulum(0.0).changed(initial=np.full((2, 1), -10.0j)), 0, 3, 12)
    assert np.abs(turning.astype(int)).max() <= 127 and (turning < 0).any() and (turning > 0).any()


def test_films_of_all_cases_have_as_many_periods():
    problems = {
        name: case(name).changed(model="pendula", mu=0.2) for name in ("fig2_large", "fig3_large")
    }
    data = as_xarray(*film.film_pendula(problems, 3, 2, 6))
    assert dict(data["angle_step"].sizes) == {"case": 2, "picture": 13, "component": 2, "site": 7}
    assert data["site"].values.tolist() == list(range(-3, 4))
    assert data["angle_step"].values[:, 0, 0, 3].tolist() == [round(2.0 * 127 / np.pi)] * 2
    lengths = data["tau_of_period"] * data["pendulum_frequency"]
    assert lengths.values == pytest.approx(np.pi * 0.04)
