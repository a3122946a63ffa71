"""The transition by two clocks: when P has half of its final value, and the centre its share."""

import numpy as np
import pytest
import xarray as xr
from accepted import dataset
from latticode.datasets.netcdf import as_xarray
from latticode.simulation.simulate import simulate
from matplotlib.markers import CARETUPBASE
from oracle import slope
from pendula.studies.chaos import clocks, figures, lifetimes
from problems import problem_of
from scipy.integrate import solve_ivp

SOLVER = {"name": "taylor", "rtol": 1e-8, "atol": 1e-8}
WINDOW = (15.0, 20.0)


def problem(case="fig4_small", a0=1.0, **changes):
    settings = {
        "solver": SOLVER,
        "end_time": 20.0,
        "output_step": 0.1,
        "initial": {0: (a0, 0.2 * a0)},
    }
    return problem_of(case, **settings | changes)


@pytest.mark.parametrize("a0", [1.0, 9.0])
def test_scipy_sees_the_transition_at_the_same_time(a0):
    """On plain NumPy by SciPy's DOP853, at a quarter of the final P, which chaos moves a little."""
    start = np.zeros((2, 61), complex)
    start[:, 30] = a0, 0.2 * a0
    tau = np.linspace(0.0, 20.0, 201)
    run = solve_ivp(
        lambda _, y: slope(y.reshape(2, 61), (1.0, 1.0, 0.0), "dirichlet").ravel(),
        (0.0, 20.0),
        start.ravel(),
        "DOP853",
        tau,
        rtol=1e-9,
        atol=1e-9,
    )
    power = (np.abs(run.y) ** 2).sum(axis=0)
    first = tau[np.argmax(power >= 0.25 * power[tau >= WINDOW[0]].mean())]
    computed = lifetimes.follow(problem(a0=a0), WINDOW, 0.25)
    assert computed["transition"] == pytest.approx(first, abs=0.3) and 3.0 < first < 5.0
    assert computed["l2"] == pytest.approx(np.sqrt(power[tau >= WINDOW[0]]).mean(), rel=0.05)


def test_a_life_is_the_same_in_pieces_as_in_one_run():
    """The window ends before the life does, which a second piece follows."""
    case = problem(a0=5.0)
    full_run = simulate(case.changed(snapshot_every=1))
    first = np.flatnonzero(lifetimes.centre_is_average(full_run.modulus))[0]
    time = lifetimes.follow(case, (3.0, 4.0), 0.5)["life"]
    assert time == pytest.approx(full_run.tau[first]) and 4.0 < time < 14.0


def test_a_centre_outlives_the_transition_from_a_large_amplitude_and_not_from_a_small_one():
    small, large = (lifetimes.follow(problem(a0=a0), WINDOW, 0.5) for a0 in (2.0, 10.0))
    assert small["life"] < 10.0 and large["life"] == np.inf
    assert large["transition"] == pytest.approx(small["transition"], rel=0.3)
    assert large["centre_share"] > 3.0 * small["centre_share"]


def test_in_a_stable_case_nothing_is_outlived():
    """At Omega = 8 the large oscillation stays at the centre: P has its final value at once."""
    computed = lifetimes.follow(problem("fig2_large", 5.0), WINDOW, 0.5)
    assert (
        computed["life"] == np.inf
        and computed["transition"] == 0.0
        and computed["centre_share"] > 0.5
    )


def test_the_centre_shares_alike_from_the_mean_over_all_pairs_on():
    modulus = np.ones((2, 5, 3))
    modulus[:, 2] = [1.5, 1.0, 0.5]
    assert lifetimes.centre_is_average(modulus).tolist() == [False, True, True]
    assert lifetimes.centre_is_average(modulus, 2.0).tolist() == [True, True, True]
    assert lifetimes.centre_is_average(modulus, 0.5).tolist() == [False, False, True]


def test_limits_are_medians_of_times_and_means_of_the_rest():
    """Of eleven lives 1 to 10 and one without an end, the median is the sixth."""
    lives = np.append(np.arange(1.0, 11.0), np.inf)[None, ::-1]
    over = ("start_amplitude", "member")
    names = dict.fromkeys(clocks.NUMBERS, (over, lives.clip(max=20.0)))
    computed = clocks.limits_of(xr.Dataset(names).assign(life=(over, lives)))
    assert [float(limit[0]) for limit in computed["life"]] == [6.0, 2.0, 10.0]
    assert computed["l2"].value == pytest.approx(75.0 / 11.0)


def test_members_of_the_long_study_are_measured_with_each_choice_changed():
    chosen = {"tolerance": 1e-7, "output_step": 0.1, "size": 0.01, "seed": 3}
    chosen |= {"window": (10.0, 12.0), "level": 0.5, "multiple": 1.0}
    case, changes = problem(end_time=12.0), {"level": [0.25], "seed": [4]}
    data = lifetimes.vary_lifetimes(case, [2.0, 9.0], 0.2, 6, chosen, changes)
    recomputed = as_xarray(
        *lifetimes.measure_lifetimes(
            case, [2.0, 9.0], 0.2, 0.01, 6, 4, (10.0, 12.0), 0.5, 1.0
        ).make()
    )
    assert data["variation"].values.tolist() == ["seed = 4", "level = 0.25"]
    expected = np.median(recomputed["transition"], axis=1)
    np.testing.assert_allclose(data["transition_varied"].sel(variation="seed = 4"), expected)
    assert (data["transition_varied"].sel(variation="level = 0.25") < data["transition"]).all()


def test_an_upper_limit_that_no_run_reached_is_an_arrow_and_no_end_of_a_bar():
    """Of eleven lives from three amplitudes three, none and seven outlast the runs."""
    lives = np.tile(np.arange(1.0, 12.0), (3, 1))
    lives[0, 8:] = lives[2, 4:] = np.inf
    over = ("start_amplitude", "member")
    data = xr.Dataset(dict.fromkeys(clocks.NUMBERS, (over, lives.clip(max=9.0))))
    attributes = dict.fromkeys(
        ("omega", "ratio", "window_start", "window_end", "perturbation"), 1.0
    )
    data = data.assign(life=(over, lives)).assign_coords(start_amplitude=[1.0, 2.0, 3.0])
    data = data.assign_attrs(attributes, members=11, end_time=20.0, half_width=30)
    drawn = figures.gather_lifetimes(data)
    assert drawn["life_open"].values == pytest.approx([20.0, np.nan, np.nan], nan_ok=True)
    assert drawn["life_later"].values == pytest.approx([np.nan, np.nan, 20.0], nan_ok=True)
    left, _ = figures.draw_lifetimes(drawn).axes
    arrows = [line for line in left.lines if line.get_marker() == CARETUPBASE]
    assert [y for line in arrows for y in line.get_ydata() if np.isfinite(y)] == [20.0]
    ends = [line.get_ydata() for line in left.lines if line.get_marker() == "_"]
    assert ends and all(np.nanmax(y) < 20.0 for y in ends)


def test_the_accepted_life_of_the_centre_is_varied_by_the_power_that_ends_it():
    """Half of the mean power ends a life later, and twice the mean power earlier."""
    quoted = dataset("quoted/chaos").sel(start_amplitude=slice(3.0, 7.0))
    lives = quoted["life_varied"]
    later, earlier = (lives.sel(variation=f"multiple = {multiple}") for multiple in ("0.5", "2"))
    assert (earlier < quoted["life"]).all() and (quoted["life"] < later).all()
    assert (quoted["life_low"] <= earlier).all() and (later <= quoted["life_high"]).all()
