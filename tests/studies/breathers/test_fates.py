"""Fates of data on one pair, which of them spread, and the symmetry of the map."""

import numpy as np
import pytest
from pendula.problem import Constants, Problem
from pendula.simulation.simulate import simulate
from pendula.studies.breathers.fates import (
    BREATHER,
    DISPERSES,
    MOVES,
    SPREADS,
    fate,
    fate_of,
    folded_power,
    largest_linear_gain,
    map_of_fates,
)
from pendula.studies.breathers.sensitivity import has_spread, largest_l2, scan, shares


def pair_problem(omega, a, b, end_time=30.0):
    return Problem(
        constants=Constants(epsilon=1.0, gamma=1.0, omega=omega), half_width=30,
        boundary="dirichlet", initial=np.array([[a], [b]], complex), end_time=end_time,
        output_step=end_time, solver={"name": "taylor", "rtol": 1e-8, "atol": 1e-8},
    )  # fmt: skip


def moduli(power: dict[int, float], half_width=3) -> np.ndarray:
    found = np.zeros((2, 2 * half_width + 1))
    for site, value in power.items():
        found[0, half_width + site] = value**0.5
    return found


@pytest.mark.parametrize(
    ("power", "expected"),
    [
        ({0: 6, 1: 2, -1: 2}, BREATHER),
        ({2: 3, -2: 3, 0: 1}, MOVES),  # neither of the two holds half by itself
        ({0: 5, 1: 2.5, -1: 2.5}, DISPERSES),  # exactly half is no majority
        ({0: 14, 1: 7, -1: 7, 2: 2}, DISPERSES),  # P has grown from 10 to 30, as waves can
        ({0: 14, 1: 7, -1: 7, 2: 2.1}, SPREADS),
    ],
)
def test_what_the_end_of_a_run_shows(power, expected):
    assert fate_of(moduli(power), 10.0, 3.0) == expected


def test_pairs_are_counted_with_their_mirror_images():
    assert folded_power(moduli({-2: 1, 2: 2, 0: 5, -1: 3})).tolist() == pytest.approx([5, 3, 3, 0])


@pytest.mark.parametrize(
    ("omega", "gain"), [(-4.0, 3.0), (8.0, 3.0), (10.0, 2.0), (0.0, 1.0), (-2.0, 1.0), (5.0, 1.0)]
)
def test_linear_waves_gain_so_much_at_most(omega, gain):
    assert largest_linear_gain(Constants(epsilon=1.0, gamma=1.0, omega=omega)) == gain


def test_linear_waves_stay_below_their_bound_and_come_near_it():
    """One pair at |kappa| = 4: P oscillates between its start and three times as much."""
    constants = Constants(epsilon=0.0, gamma=1.0, omega=-4.0)
    grown = []
    for start in (1e-6, 1e-6j):
        problem = Problem(
            constants=constants, half_width=1, boundary="dirichlet",
            initial=np.array([[start], [-start]]), end_time=4.0, output_step=0.01,
            solver={"name": "taylor", "rtol": 1e-12, "atol": 1e-24},
        )  # fmt: skip
        power = (simulate(problem).l2 ** 2).sum(axis=0)
        grown.append(float((power / power[0]).max()))
    assert max(grown) == pytest.approx(largest_linear_gain(constants), rel=1e-4)


@pytest.mark.parametrize(
    ("omega", "a", "b", "expected"),
    [(8.0, 5.0, 1.0, BREATHER), (8.0, 1.0, 0.1, DISPERSES), (-4.0, 1.0, 0.1, DISPERSES),
     (0.0, 5.0, 1.0, SPREADS), (0.0, 1.0, 1.0, DISPERSES)],
)  # fmt: skip
def test_fates_of_the_papers_data(omega, a, b, expected):
    assert fate(pair_problem(omega, a, b, 70.0))[0] == expected


def test_exchanging_the_components_changes_no_fate():
    one, other = (fate(pair_problem(-4.0, *pair))[1] for pair in ((4.0, 2.5), (2.5, 4.0)))
    assert np.array_equal(one.final, other.final[::-1])
    found = map_of_fates(pair_problem(-4.0, 1.0, 1.0), np.array([1.0, 3.0, 5.0]))
    assert np.array_equal(found, found.T)
    assert found[0, 0] == DISPERSES
    assert found[2, 2] == BREATHER


def test_a_run_spreads_where_nobody_holds_most_of_it():
    spread, kept = simulate(pair_problem(0.0, 1.0, 0.1, 50.0)), simulate(pair_problem(8.0, 5, 1))
    assert has_spread(spread)
    assert not has_spread(kept)
    assert largest_l2(kept) ** 2 == pytest.approx((kept.l2**2).sum(axis=0).max())


def test_shares_have_exact_limits_and_draws_of_their_own():
    none = shares(pair_problem(8.0, 5.0, 1.0, 5.0), [1e-3, 1e-1], 5, seed=1)
    assert none.value.tolist() == [0.0, 0.0]
    assert none.high == pytest.approx(1.0 - 0.025**0.2, abs=1e-6)
    assert none.low.tolist() == [0.0, 0.0]


def test_a_scan_starts_from_each_amplitude():
    largest, spread = scan(pair_problem(8.0, 5.0, 1.0, 1e-3), np.array([1.0, 5.0]), 0.2)
    assert largest == pytest.approx(np.sqrt(1.04) * np.array([1.0, 5.0]), rel=1e-2)
    assert not spread.any()
