"""How a breather swings, and how far it is from families, on breathers that are known."""

import numpy as np
import pytest
import xarray as xr
from pendula.problem import Constants, Problem
from pendula.simulation.simulate import simulate
from pendula.studies.breathers.fates import BREATHER, ends
from pendula.studies.breathers.nearest import Families, Follower, distances, swing
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
    assert found.fate[0] == BREATHER != found.fate[1]
    assert found.frequency[0] == pytest.approx(12.0, rel=1e-3)
    assert found.nearest.tolist() == [1, 0]
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
