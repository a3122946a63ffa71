"""Whether a motion is periodic, and how far it is from families, on breathers that are known."""

import numpy as np
import pytest
from accepted import dataset
from on_breathers import BELOW, members
from pendula.problem import Constants
from pendula.studies.breathers import nearest
from pendula.studies.breathers.fates import STAYS, ends, on_one_pair
from pendula.studies.breathers.periodic import FAMILIES, problem_from, unfolded


def breather(family, frequency):
    """Return a breather of a family at Omega = -4 on the whole chain."""
    (found,) = members(BELOW, family, frequency, most=30)
    return unfolded(found.data).astype(complex)


def problem_of(state, omega=-4.0, end_time=5.0):
    constants = Constants(epsilon=1.0, gamma=1.0, omega=omega)
    return problem_from(constants, state, end_time, end_time, 1e-10)


def crossings_of(problem, guess):
    return nearest.crossings(
        nearest.Follower(problem, problem.initial, np.zeros(1, np.bool_)), guess
    )


PERIODIC = dataset("breathers/periodic")
BREATHERS = nearest.Families.of(PERIODIC, -4.0)


@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("frequency", [9.5, 17.0, 30.0])
def test_a_breather_is_at_no_distance_from_its_own_family(family, frequency):
    found = crossings_of(problem_of(breather(family, frequency)), 1.1 * frequency)
    assert found.frequency == pytest.approx(frequency, rel=1e-3)
    off, own = nearest.distances(found, BREATHERS), FAMILIES.index(family)
    assert off[own] < 1e-2  # what interpolation and the steps to the instants leave
    assert np.delete(off, own).min() > 0.3
    assert nearest.unreturned(found, 0.0) < 0.1  # its instants are more exact than they need to be


def test_the_component_that_leads_is_compared_with_the_one_that_leads():
    found = crossings_of(problem_of(breather("A only", 12.0)[::-1]), 12.0)
    assert nearest.distances(found, BREATHERS)[0] < 5e-3


def test_the_distance_is_the_largest_of_all_instants():
    """With A as it is and B times 1 + d, it is d |b| / |(a, b)|, also for -B and for phases."""
    state = breather("A only", 12.0)
    found = crossings_of(problem_of(state), 12.0)
    a, b = state[:, state.shape[1] // 2].real
    for factor in (1.3, -1.0, 1.0 + 0.2j):
        pairs = found.pairs.copy()
        pairs[3, 1] *= factor
        expected = abs(factor - 1.0) * abs(b) / np.hypot(a, b)
        off = nearest.distances(found._replace(pairs=pairs), BREATHERS)[0]
        assert off == pytest.approx(expected, abs=5e-3)


def test_no_family_is_named_where_none_is_known():
    found = crossings_of(problem_of(breather("A only", 8.5)), 8.5)
    for frequency in (4.9, 45.0):
        assert np.isnan(nearest.distances(found._replace(frequency=frequency), BREATHERS)).all()
    assert np.isnan(nearest.distances(found, nearest.Families.of(PERIODIC, 7.0))).all()


def test_a_state_that_turns_the_other_way_or_stays_has_no_frequency():
    """A = B at Omega = -20 is slower than the frame that turns; A = B = sqrt(40) stays in it."""
    for size in (3.0, 40.0**0.5):
        state = np.zeros((2, 17), complex)
        state[:, 8] = size
        assert crossings_of(problem_of(state, -20.0).changed(epsilon=1e-9), 5.0) is None


def test_what_stays_is_periodic_only_if_it_returns():
    """At Omega = 8 B follows A if it starts small, and has a frequency of its own if it is large.

    At Omega = -4 the second motion belongs to no family, and is at no distance from any.
    """
    one = problem_of(np.zeros((2, 61), complex), 8.0, 70.0)
    runs = [on_one_pair(one, *pair) for pair in ((7.0, 0.2), (5.0, 1.0), (6.0, 4.0), (4.0, 3.3))]
    found = ends(runs, nearest.Families.of(PERIODIC, 7.0))
    assert (found.fate == STAYS).all()
    assert found.periodic.tolist() == [1, 1, 0, 0]
    irregular = ends([on_one_pair(one.changed(omega=-4.0), 6.65, 5.25)], BREATHERS)
    assert [irregular.fate[0], irregular.periodic[0], irregular.family[0]] == [STAYS, 0, 0]
    assert np.isnan([irregular.distance[0], irregular.frequency[0]]).all()


def test_an_end_is_compared_with_the_family_of_its_symmetry_alone():
    """At a frequency where only A = B is known, A = -B is at an unknown distance."""
    known = PERIODIC["amplitude"].where(PERIODIC["family"] == "A = B")
    families = nearest.Families.of(PERIODIC.assign(amplitude=known), -4.0)
    dispersed = problem_of(np.pad([[0.5], [0.0]], ((0, 0), (12, 12))), end_time=40.0)
    found = ends([*(problem_of(breather(one, 12.0)) for one in FAMILIES), dispersed], families)
    assert (found.fate == STAYS).tolist() == [True, True, True, False]
    assert found.frequency == pytest.approx([12.0, 12.0, 12.0, np.nan], rel=1e-3, nan_ok=True)
    assert found.family.tolist() == [1, 2, 3, 0]
    assert found.periodic.tolist() == [1, 1, 1, -1]
    assert np.isfinite(found.distance).tolist() == [False, False, True, False]


def test_waves_may_move_the_pair_and_a_second_frequency_may_not():
    """Even waves have P of 2 w^2 at the centre; a B with a phase of its own keeps its modulus."""

    def left(pairs, waves):
        return nearest.unreturned(nearest.Crossings(12.0, pairs + np.array([5.0, 0.0])), waves)

    rng, waves, count = np.random.default_rng(2), 0.01, nearest.HALF_PERIODS + 1
    draws = (waves / 2) ** 0.5 * rng.normal(size=(100, count, 2, 2))
    moved = [left(np.array([0.0, -0.3]) + draw @ [1, 1j], waves) for draw in draws]
    assert max(moved) < 1.0 and np.mean(moved) > 0.3
    turning = np.exp(2j * np.pi * np.arange(nearest.HALF_PERIODS) / nearest.HALF_PERIODS)[
        :, None
    ] * [0.0, 1.0]
    limit = nearest.WAVES * waves + nearest.INSTANTS**2 * 25.0
    for factor in (0.9, 1.1):
        assert left(factor * limit**0.5 * turning, waves) == pytest.approx(factor**2)
    assert left(np.full((9, 2), [0.0, 0.5j]), 0.0) == 0.0
