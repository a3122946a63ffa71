"""Periodic breathers: periods by an independent solver, multipliers, laws, and what has none."""

from pathlib import Path

import numpy as np
import pytest
import yaml
from pendula.problem import Constants, Problem
from pendula.simulation.simulate import simulate
from pendula.studies.breathers import multipliers, periodic
from pendula.studies.breathers.multipliers import PARITIES, growth, half_traces
from pendula.studies.breathers.periodic import (
    FAMILIES,
    Breather,
    family_of,
    least_power,
    power_at,
    shoot,
    single_site,
)
from pendula.studies.breathers.steady import NotFoundError
from pendula.studies.breathers.waves import bands, distance_from_bands, free_intervals

BELOW = Constants(epsilon=1.0, gamma=1.0, omega=-4.0)
ABOVE = Constants(epsilon=1.0, gamma=1.0, omega=8.0)
M = 20
CONFIG = Path(__file__).resolve().parents[3] / "config"


@pytest.fixture(scope="module")
def found():
    """Return a breather of each family at the frequency 12, by detuning and family."""
    return {
        (constants.omega, family): shoot(constants, 12.0, single_site(constants, 12.0, family, M))
        for constants in (BELOW, ABOVE)
        for family in FAMILIES
    }


def problem_of(breather: Breather, end_time: float, change=0.0) -> Problem:
    half = breather.data + change
    whole = np.concatenate([half[:, :0:-1], half], axis=1).astype(complex)
    solver = {"name": "taylor", "rtol": 1e-15, "atol": 1e-15}
    return Problem(
        constants=breather.constants, half_width=half.shape[1] - 1, boundary="dirichlet",
        initial=whole, end_time=end_time, output_step=end_time, solver=solver,
    )  # fmt: skip


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("omega", [-4.0, 8.0])
def test_the_period_closes_by_the_taylor_method(found, omega, family):
    breather = found[omega, family]
    period = 4.0 * breather.quarter
    run = simulate(problem_of(breather, period))
    start = np.concatenate([breather.data[:, :0:-1], breather.data], axis=1)
    assert np.abs(run.final - start).max() < 1e-11


@pytest.mark.parametrize("omega", [-4.0, 8.0])
def test_the_ends_of_a_family_close_as_well_as_the_study_needs(omega):
    """The slowest breather has the longest tails, the fastest one the largest amplitude."""
    given = yaml.safe_load((CONFIG / "breathers.yaml").read_text())["breathers"]
    widths, constants = given["periodic"]["half_widths"], {-4.0: BELOW, 8.0: ABOVE}[omega]
    for breather in family_of(constants, "A = -B", [8.1, 20.0], widths):
        run = simulate(problem_of(breather, 4.0 * breather.quarter))
        sites = breather.data.shape[1]
        missed = np.abs(run.final[:, sites - 1 :] - breather.data).max()
        assert missed < given["needs"]["periodic"] * np.abs(breather.data).max()


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("omega", [-4.0, 8.0])
def test_p_falls_from_the_real_instant_to_the_imaginary_one(found, omega, family):
    breather = found[omega, family]
    problem = problem_of(breather, breather.quarter).changed(output_step=breather.quarter / 40)
    power = simulate(problem).l2 ** 2
    assert power[:, 0] == pytest.approx(power_at(breather, "both real"), rel=1e-12)
    assert power[:, -1] == pytest.approx(power_at(breather, "both imaginary"), rel=1e-10)
    assert (np.diff(power.sum(axis=0)) < 1e-11 * power.max()).all()


@pytest.mark.parametrize(("instant", "lowest"), [("both real", 36.29), ("both imaginary", 30.25)])
def test_the_least_p_of_a_family_lies_between_the_frequencies_of_a_grid(instant, lowest):
    coarse = list(family_of(BELOW, "A only", [8.1, 8.5, 9.0, 10.0], {"least": 8, "most": 48}))
    frequency, least = least_power(coarse, instant)
    assert least == pytest.approx(lowest, abs=5e-3)
    assert 8.7 < frequency < 8.85
    fine = np.arange(frequency - 0.05, frequency + 0.051, 0.01)
    powers = [power_at(one, instant).sum() for one in
              family_of(BELOW, "A only", fine, {"least": 8, "most": 48})]  # fmt: skip
    assert least == pytest.approx(min(powers), rel=1e-8) and powers[0] > least < powers[-1]


def test_where_p_falls_to_the_end_of_a_family_its_least_is_there():
    falling = list(family_of(BELOW, "A = -B", [8.1, 9.0, 10.0], {"least": 8, "most": 48}))
    assert least_power(falling, "both real") == (8.1, power_at(falling[-1], "both real").sum())


def test_half_a_period_turns_the_sign(found):
    breather = found[-4.0, "A only"]
    run = simulate(problem_of(breather, 2.0 * breather.quarter))
    assert np.abs(run.final[:, M:] + breather.data).max() < 1e-11


@pytest.mark.parametrize("omega", [-4.0, 8.0])
def test_families_keep_their_symmetries(found, omega):
    for family, sign in (("A = B", 1.0), ("A = -B", -1.0)):
        a, b = found[omega, family].data
        assert np.abs(a - sign * b).max() < 1e-12
    a, b = found[omega, "A only"].data
    assert 0.0 < np.abs(b).max() < 0.3 * np.abs(a).max()


def test_equal_amplitudes_do_not_feel_the_drive(found):
    free = Constants(epsilon=1.0, gamma=0.0, omega=-4.0)
    alone = shoot(free, 12.0, single_site(free, 12.0, "A = B", M))
    assert np.abs(alone.data - found[-4.0, "A = B"].data).max() < 1e-12


def test_one_pair_without_drive_has_the_closed_form():
    pair = Constants(epsilon=0.0, gamma=0.0, omega=-4.0)
    data = shoot(pair, 12.0, single_site(pair, 12.0, "A = B", 2)).data
    assert data[:, 0] == pytest.approx(np.sqrt(2.0 * 16.0), abs=1e-12)


def multipliers_by_differences(breather: Breather, size=1e-6) -> np.ndarray:
    """Return the multipliers over a period from runs with changed data: even perturbations."""
    sites = breather.data.shape[1]
    columns = []
    for index in range(4 * sites):
        ends = []
        for sign in (1.0, -1.0):
            change = np.zeros((2, 2, sites))
            change.reshape(-1)[index] = sign * size
            run = simulate(problem_of(breather, 4.0 * breather.quarter, change[0] + 1j * change[1]))
            ends.append(run.final[:, M:])
        moved = (ends[0] - ends[1]) / (2.0 * size)
        columns.append(np.stack([moved.real, moved.imag]).ravel())
    return np.linalg.eigvals(np.array(columns).T)


def test_multipliers_are_those_of_the_flow():
    """All even multipliers of an unstable breather, from differences of the nonlinear flow."""
    short = Constants(epsilon=0.3, gamma=1.0, omega=8.0)
    breather = shoot(short, 10.0, single_site(short, 10.0, "A = B", M))
    rate = growth(10.0, half_traces(breather, "even"))
    slow = np.abs(multipliers_by_differences(breather)).max()
    assert rate > 0.3
    assert np.log(slow) / (4.0 * breather.quarter) == pytest.approx(rate, rel=1e-6)


def test_a_growing_perturbation_grows_in_the_nonlinear_flow_at_the_rate_of_floquet(found):
    breather = found[-4.0, "A = B"]
    rate = growth(12.0, half_traces(breather, "even"))
    change = np.zeros((2, M + 1))
    change[:, 0] = (1e-9, -1e-9)  # out of A = B, where the drive acts
    sizes = []
    for periods in (8, 16):
        run = simulate(problem_of(breather, periods * 4.0 * breather.quarter, change))
        sizes.append(np.abs(run.final[0] - run.final[1]).max())
    measured = np.log(sizes[1] / sizes[0]) / (8 * 4.0 * breather.quarter)
    assert measured == pytest.approx(rate, rel=1e-3)


@pytest.mark.parametrize("family", ["A only", "A = -B"])
def test_a_stable_breather_stays_for_a_long_time(found, family):
    """A change of the data by 1e-3 of themselves stays as small for almost two thousand periods.

    The phase drifts in proportion to time, so that P on the central pair is watched, which swings
    within each period: its least and its largest value are.
    """
    breather = found[-4.0, family]
    assert [growth(12.0, half_traces(breather, parity)) for parity in PARITIES] == [0.0, 0.0]
    long = problem_of(breather, 1e3, 1e-3 * breather.data[:, :1]).changed(
        output_step=0.5, snapshot_every=1, solver={"name": "taylor", "rtol": 1e-10, "atol": 1e-10}
    )
    centre = (simulate(long).modulus[:, M] ** 2).sum(axis=0)
    early, late = centre[:1000], centre[-1000:]
    assert late.max() == pytest.approx(early.max(), rel=1e-3)
    assert late.min() == pytest.approx(early.min(), rel=1e-3)


def test_an_unstable_breather_does_not_stay(found):
    breather = found[-4.0, "A = B"]
    change = np.zeros((2, M + 1))
    change[0, 0] = 1e-3 * breather.data[0, 0]
    run = problem_of(breather, 20.0, change).changed(output_step=0.5, snapshot_every=1)
    centre = (simulate(run).modulus[:, M] ** 2).sum(axis=0)
    assert centre.max() > 1.1 * centre[0]  # it leaves, and comes back


def test_the_shift_in_time_has_the_multiplier_one(found):
    for breather in found.values():
        nearest = np.abs(half_traces(breather, "even") - 1.0).min()
        assert nearest == 0.0


@pytest.mark.parametrize(
    ("constants", "expected"),
    [
        (BELOW, [(4.0, 8.0), (12.0**0.5, 60.0**0.5)]),
        (ABOVE, [(4.0, 8.0), (12.0**0.5, 60.0**0.5)]),
        (Constants(epsilon=1.0, gamma=1.0, omega=1.0), [(0.0, 3.0), (0.0, 5.0**0.5)]),
    ],
)
def test_bands_of_linear_waves(constants, expected):
    assert np.array(bands(constants)) == pytest.approx(np.array(expected))


@pytest.mark.parametrize(("frequency", "distance"), [
    (8.5, 0.5), (12.0, 4.0), (5.0, 0.0), (2.0, 0.0), (2.8, 0.4), (1.0, 0.0),
])  # fmt: skip
def test_odd_multiples_may_meet_a_band(frequency, distance):
    """2.8 lies below the band, 8.4 above it; 3 times 2 lies within, as does 5 times 1."""
    assert distance_from_bands(BELOW, frequency) == pytest.approx(distance)


@pytest.mark.parametrize("omega", [-4.0, 0.0, 1.0, 20.0])
def test_free_intervals_are_where_no_odd_multiple_meets_a_band(omega):
    constants = Constants(epsilon=1.0, gamma=1.0, omega=omega)
    free = free_intervals(constants)
    for frequency in np.linspace(0.05, 30.0, 1201):
        inside = any(low < frequency < high for low, high in free)
        assert inside == (distance_from_bands(constants, frequency) > 0.0)


def test_a_family_below_which_waves_lie_ends_there():
    found = family_of(BELOW, "A = -B", [3.0, 12.0], {"least": 8, "most": 20})
    assert [one.frequency for one in found] == [12.0]  # 3 lies in a lower free interval


def test_a_alone_ends_where_it_has_become_a_equal_to_b():
    widths = {"least": 8, "most": 40}
    alone = list(family_of(ABOVE, "A only", [8.07, 8.1, 9.0], widths))
    assert [one.frequency for one in alone] == [9.0, 8.1]
    equal = list(family_of(ABOVE, "A = B", [8.07, 8.1, 9.0], widths))
    assert [one.frequency for one in equal] == [9.0, 8.1, 8.07]
    for one in equal:
        assert np.array_equal(one.data[0], one.data[1])


def test_more_steps_change_nothing(monkeypatch):
    """Neither of the solution nor of its perturbations."""
    for constants, family in ((BELOW, "A = -B"), (ABOVE, "A only")):
        coarse = shoot(constants, 9.0, single_site(constants, 9.0, family, M))
        traces = half_traces(coarse, "even")
        with monkeypatch.context() as finer:
            finer.setattr(periodic, "FINE_STEPS", 2 * periodic.FINE_STEPS)
            finer.setattr(multipliers, "STEPS", 2 * multipliers.STEPS)
            fine = shoot(constants, 9.0, coarse.data)
            assert np.abs(fine.data - coarse.data).max() < 1e-13
            changed = half_traces(coarse, "even")
        assert 0.0 < np.abs(np.sort(changed) - np.sort(traces)).max() < 1e-10


def test_a_frequency_below_the_chain_has_no_single_site():
    with pytest.raises(NotFoundError):
        single_site(ABOVE, 5.0, "A only", M)


def test_a_family_is_followed_from_far_away_down_to_the_band():
    found = list(family_of(BELOW, "A only", [5.0, 10.0, 20.0], {"least": 8, "most": 24}))
    assert [one.frequency for one in found] == [20.0, 10.0]
    near = shoot(BELOW, 10.0, single_site(BELOW, 10.0, "A only", 24))
    width = found[1].data.shape[1]
    off = np.abs(found[1].data - near.data[:, :width])
    assert off[:, 0].max() < 1e-12
    assert off.max() < 1e-7  # the end of a shorter chain cuts off as much of the tails


def test_shooting_from_nowhere_is_refused():
    with pytest.raises(NotFoundError):
        shoot(BELOW, 12.0, np.full((2, M + 1), 30.0))
