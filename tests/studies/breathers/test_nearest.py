"""How a breather swings, and how far it is from families, on breathers that are known."""

import numpy as np
import pytest
import xarray as xr
from pendula.problem import Constants, Problem
from pendula.simulation.simulate import simulate
from pendula.studies.breathers.fates import STAYS, ends, on_one_pair
from pendula.studies.breathers.nearest import (
    HALF_PERIODS,
    INSTANTS,
    WAVES,
    Families,
    Follower,
    Swing,
    distances,
    swing,
    unreturned,
)
from pendula.studies.breathers.periodic import FAMILIES, family_of

WIDTHS = {"least": 8, "most": 30}
KNOWN = [9.0, 10.0, 12.0, 15.0, 20.0]


def constants(omega=-4.0):
    return Constants(epsilon=1.0, gamma=1.0, omega=omega)


def breather(family, frequency, omega=-4.0):
    (found,) = family_of(constants(omega), family, [frequency], WIDTHS)
    return found


def whole(data):
    """Return even data on the sites 0..M on the whole chain."""
    return np.concatenate([data[:, :0:-1], data], axis=1).astype(complex)


def problem_of(state, omega=-4.0, end_time=5.0):
    return Problem(
        constants=constants(omega), half_width=state.shape[1] // 2, boundary="dirichlet",
        initial=state, end_time=end_time, output_step=end_time,
        solver={"name": "taylor", "rtol": 1e-10, "atol": 1e-10},
    )  # fmt: skip


def swing_of(state, guess, omega=-4.0):
    stop = np.zeros(1, np.bool_)
    return swing(Follower(problem_of(state, omega), state, stop), guess)


@pytest.fixture(scope="module")
def periodic():
    """Return the pairs at the centre of the families as the dataset has them."""
    pairs = np.zeros((2, 2, 3, 1, len(KNOWN)))
    for i, family in enumerate(FAMILIES):
        found = family_of(constants(), family, KNOWN, WIDTHS)
        for one in found:
            pairs[0, :, i, 0, KNOWN.index(one.frequency)] = one.data[:, 0]
    dimensions = ("part", "component", "family", "omega", "frequency")
    return xr.Dataset(
        {"amplitude": (dimensions, pairs)},
        {"part": ["re", "im"], "component": ["A", "B"], "family": list(FAMILIES),
         "omega": [-4.0], "frequency": KNOWN},
    )  # fmt: skip


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("frequency", [9.5, 17.0, 30.0])
def test_a_breather_is_at_no_distance_from_its_own_family(periodic, family, frequency):
    families = Families.of(periodic, -4.0)
    found = swing_of(whole(breather(family, frequency).data), 1.1 * frequency)
    assert found.frequency == pytest.approx(frequency, rel=1e-3)
    off = distances(found, families)
    own = FAMILIES.index(family)
    assert off[own] < 1e-2  # what interpolation and the steps to the instants leave
    assert np.delete(off, own).min() > 0.3
    assert unreturned(found, 0.0) < 0.1  # its instants are more exact than they need to be


def test_the_component_that_leads_is_compared_with_the_one_that_leads(periodic):
    state = whole(breather("A only", 12.0).data)[::-1]
    off = distances(swing_of(state, 12.0), Families.of(periodic, -4.0))
    assert off[0] < 5e-3


def test_the_distance_is_that_of_the_other_amplitude(periodic):
    """With A as it is and B times 1 + d, it is d |b| / |(a, b)|, also for -B and for phases."""
    families, one = Families.of(periodic, -4.0), breather("A only", 12.0)
    found = swing_of(whole(one.data), 12.0)
    a, b = one.data[:, 0]
    for factor in (1.3, -1.0, 1.0 + 0.2j):
        pairs = found.pairs * np.array([1.0, factor])
        expected = abs(factor - 1.0) * abs(b) / np.hypot(a, b)
        assert distances(found._replace(pairs=pairs), families)[0] == pytest.approx(
            expected, abs=5e-3
        )


def test_no_family_is_named_where_none_is_known(periodic):
    slow = swing_of(whole(breather("A only", 8.5).data), 8.5)
    assert slow.frequency == pytest.approx(8.5, rel=1e-3)
    assert np.isnan(distances(slow, Families.of(periodic, -4.0))).all()
    fast = slow._replace(frequency=45.0)
    assert np.isnan(distances(fast, Families.of(periodic, -4.0))).all()
    assert np.isnan(distances(slow, Families.of(periodic, 8.0))).all()


def test_a_state_that_turns_the_other_way_or_stays_has_no_frequency():
    """A = B at Omega = -20 is slower than the frame that turns; A = B = sqrt(40) stays in it."""
    for size in (3.0, 40.0**0.5):
        state = np.zeros((2, 17), complex)
        state[:, 8] = size
        stop = np.zeros(1, np.bool_)
        problem = problem_of(state, -20.0).changed(epsilon=1e-9)
        assert swing(Follower(problem, state, stop), 5.0) is None


def test_ends_tell_how_the_run_swings(periodic):
    state, families = whole(breather("A only", 12.0).data), Families.of(periodic, -4.0)
    dispersed = np.zeros_like(state)
    dispersed[0, state.shape[1] // 2] = 0.5
    found = ends([problem_of(state), problem_of(dispersed, end_time=40.0)], families)
    assert found.fate[0] == STAYS != found.fate[1]
    assert found.frequency[0] == pytest.approx(12.0, rel=1e-3)
    assert found.family.tolist() == [1, 0]
    assert found.periodic.tolist() == [1, -1]
    assert found.distance[0] < 5e-3
    assert np.isnan(found.frequency[1]) and np.isnan(found.distance[1])


def rates_of(a, b):
    """Return how fast the phases of A and B fall at the end of a run at Omega = 8."""
    problem = problem_of(np.pad([[a], [b]], ((0, 0), (30, 30))).astype(complex), 8.0, 40.0)
    follower, pairs = Follower(problem, simulate(problem).final, np.zeros(1, np.bool_)), []
    for _ in range(600):
        follower.go(0.01)
        pairs.append(follower.pair())
    phases = np.unwrap(np.angle(pairs), axis=0)
    return (phases[0] - phases[-1]) / (599 * 0.01)


def test_b_follows_near_the_family_and_has_a_frequency_of_its_own_far_from_it():
    near, far = rates_of(7.0, 0.2), rates_of(6.0, 4.0)
    assert near[1] == pytest.approx(-near[0], rel=0.01)  # the image of A, by the drive
    assert 0.3 * far[0] < far[1] < 0.8 * far[0]


def test_what_stays_is_periodic_only_if_it_returns(periodic):
    """At Omega = 8 B follows A if it starts small, and has a frequency of its own if it is large.

    At Omega = -4 the second motion belongs to no family, and is at no distance from any.
    """
    one = problem_of(np.zeros((2, 61), complex), 8.0, 70.0)
    runs = [on_one_pair(one, *pair) for pair in ((7.0, 0.2), (5.0, 1.0), (6.0, 4.0), (4.0, 3.3))]
    found = ends(runs, Families.of(periodic, 8.0))
    assert (found.fate == STAYS).all()
    assert found.periodic.tolist() == [1, 1, 0, 0]
    other = on_one_pair(problem_of(np.zeros((2, 61), complex), -4.0, 70.0), 6.65, 5.25)
    irregular = ends([other], Families.of(periodic, -4.0))
    assert [irregular.fate[0], irregular.periodic[0], irregular.family[0]] == [STAYS, 0, 0]
    assert np.isnan([irregular.distance[0], irregular.frequency[0]]).all()


def test_a_breather_is_held_against_the_family_of_its_symmetry_alone(periodic):
    """At a frequency where only A = B is known, A = -B is at an unknown distance."""
    known = periodic["amplitude"].where(periodic["family"] == "A = B")
    families = Families.of(periodic.assign(amplitude=known), -4.0)
    states = [whole(breather(family, 12.0).data) for family in FAMILIES]
    found = ends([problem_of(state) for state in states], families)
    assert found.family.tolist() == [1 + FAMILIES.index(family) for family in FAMILIES]
    assert found.periodic.tolist() == [1, 1, 1]
    own = [family == "A = B" for family in FAMILIES]
    assert np.isfinite(found.distance).tolist() == own


def made_up_swing(b):
    """Return instants at which A is 5 and B takes these values."""
    return Swing(12.0, np.stack([np.full(len(b), 5.0 + 0.0j), b], axis=1))


def test_waves_may_move_the_pair_and_a_second_frequency_may_not():
    """Even waves have P of 2 w^2 at the centre; a B with a phase of its own keeps its modulus."""
    rng, waves = np.random.default_rng(2), 0.01
    limit = WAVES * waves + INSTANTS**2 * 25.0
    left = []
    for _ in range(100):
        noise = rng.normal(size=(HALF_PERIODS + 1, 4)) @ np.array(
            [[1, 0], [1j, 0], [0, 1], [0, 1j]]
        )
        moved = made_up_swing(np.full(HALF_PERIODS + 1, -0.3 + 0.0j))
        left.append(
            unreturned(moved._replace(pairs=moved.pairs + noise * (waves / 2) ** 0.5), waves)
        )
    assert max(left) < 1.0 and np.mean(left) > 0.3
    turning = np.exp(2j * np.pi * np.arange(HALF_PERIODS) / HALF_PERIODS)
    for factor in (0.9, 1.1):
        found = unreturned(made_up_swing(factor * limit**0.5 * turning), waves)
        assert found == pytest.approx(factor**2)
    assert unreturned(made_up_swing(np.full(9, 0.5j)), 0.0) == 0.0
