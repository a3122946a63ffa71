"""Active sites: the numbers are those of the whole chain, and sites are added before the front."""

import numpy as np
import pytest
from pendula.problem import on_sites
from pendula.simulation.lattice import WHOLE
from pendula.simulation.simulate import simulate
from pendula.studies.unbounded.active_sites import (
    BLOCK,
    GUARD,
    LEVELS,
    advance,
    begin,
    find_front,
    run_chains,
    run_long,
    site_powers,
    widen,
)
from problems import constants_of, problem_of

TIGHT = {"name": "dop853", "rtol": 1e-14, "atol": 1e-14}
LOOSE = {"name": "dop853", "rtol": 1e-8, "atol": 1e-8}
REST = 1e-20
LOPSIDED = {-2: (1.0, 0.1), 0: (0.0, 0.5j)}


def problem(case="fig3_small", **changes):
    chosen = {"half_width": None, "end_time": 40.0, "output_step": 0.5, "solver": TIGHT}
    return problem_of(case, **chosen | changes)


@pytest.mark.parametrize(
    ("half_width", "changes"),
    [
        *((width, {}) for width in (None, 30, 70, 150)),
        (None, {"initial": {0: (1.0, 1.0)}}),  # A = B, and both components are kept
        *((width, {"initial": LOPSIDED}) for width in (70, 150)),
    ],
)
def test_the_norms_of_a_regular_case_are_those_of_the_whole_chain(half_width, changes):
    windowed = problem(half_width=half_width, **changes)
    whole = simulate(windowed.changed(half_width=half_width or 150), WHOLE)
    one = run_long(windowed, REST)
    np.testing.assert_allclose(one.tau, whole.tau, rtol=1e-14)
    np.testing.assert_allclose(one.l2, np.hypot(*whole.l2), rtol=1e-12)
    np.testing.assert_allclose(one.linf, whole.linf.max(axis=0), atol=1e-12)
    np.testing.assert_allclose(one.energy, whole.energy, rtol=1e-12)
    centre = whole.final.shape[1] // 2
    amplitudes = one.sites[0::2] + 1j * one.sites[1::2]
    shared = min(centre, one.width[-1]) + 1
    right = whole.final[:, centre : centre + shared]
    np.testing.assert_allclose(amplitudes[:, :shared], right, atol=1e-10)
    assert one.front[-1, 0] == find_front(one.sites)[0]
    ((_, l2, _),) = run_chains(windowed, REST, [half_width or 2000])
    np.testing.assert_allclose(l2, one.l2, rtol=1e-12)


def test_a_chaotic_case_is_the_same_while_doubles_follow_it():
    windowed = problem("fig4_small", end_time=8.0)
    one, whole = run_long(windowed, REST), simulate(windowed.changed(half_width=150), WHOLE)
    assert one.width[-1] == 2 * BLOCK
    right = whole.final[:, 150 : 151 + 2 * BLOCK]
    np.testing.assert_allclose(one.sites[0::2] + 1j * one.sites[1::2], right, atol=1e-10)


def test_sites_are_added_by_blocks_and_never_beyond_the_chain():
    free = run_long(problem(end_time=60.0, solver=LOOSE), REST)
    assert not (np.diff(free.width) % BLOCK).any() and free.width[-1] > 2 * BLOCK
    assert (free.front.max(axis=1) < free.width).all()
    short = run_long(problem(half_width=70, end_time=60.0, solver=LOOSE), REST)
    assert short.width.max() == short.width[-1] == 70


@pytest.mark.parametrize("rest", [1e-10, 1e-40])
def test_the_front_does_not_feel_for_long_where_the_chain_is_cut(rest):
    """Later it does: it is the growth of its leading edge that draws it."""
    sites = {}
    for cut in (rest, 1e-150):
        state = begin(on_sites({0: (1.0, 0.1)}), None)
        for piece in range(25):
            state = widen(state, None, cut)
            times = np.array([2.0 * piece, 2.0 * piece + 2.0])
            advance(constants_of((1.0, 1.0, 0.0)), state, times, LOOSE)
        powers = site_powers(state[:, 1:-1])
        sites[cut] = np.flatnonzero(powers > 1e-6).max(), state.shape[1]
    assert sites[rest][0] == sites[1e-150][0] and sites[rest][1] < sites[1e-150][1]
    assert powers[-8:].max() < 1e-290


def test_the_chain_begins_with_a_block_beside_the_data():
    for reach in (1, 5):
        initial = on_sites({-reach: (1.0, 0.0), reach: (1.0, 0.0)})
        assert begin(initial, None).shape == (4, BLOCK + reach + 3)


def test_a_chain_is_widened_where_its_last_sites_are_above_rest_and_never_past_its_end():
    """What is added is at rest, whatever the ghosts held: the one at the right becomes a site."""
    state = np.zeros((4, 2 * GUARD + 2))
    state[0, 1], state[2, [0, -1]] = 2.0, 7.0
    for site, amplitude, grows in (
        (GUARD, 2.01e-6, True), (GUARD, 2e-6, False), (GUARD - 1, 1.0, False),
        (2 * GUARD - 1, 2.01e-6, True),
    ):  # fmt: skip
        moved = state.copy()
        moved[1, 1 + site] = amplitude
        wider = widen(moved, None, 1e-6)
        assert wider.shape[1] == state.shape[1] + BLOCK * grows
        np.testing.assert_array_equal(wider[:, 1 : 2 * GUARD + 1], moved[:, 1:-1])
        assert not grows or not (wider[:, 2 * GUARD + 1 :].any() or wider[:, 0].any())
    state[:, -2] = 1.0
    widths = [widen(state, 2 * GUARD - 1 + more, 1e-6).shape[1] for more in (0, 1, 2 * BLOCK)]
    assert widths == [state.shape[1] + more for more in (0, 1, BLOCK)]


@pytest.mark.parametrize("site", [-(GUARD + 1), GUARD + 1])
def test_a_chain_that_is_not_even_is_widened_on_both_sides_where_either_end_moves(site):
    width = 2 * GUARD
    state = np.zeros((4, 2 * width + 3))
    state[0, 1 + width + site] = 1.0
    wider = widen(state, None, 1e-6, even=False)
    assert wider.shape == (4, 2 * (width + BLOCK) + 3)
    assert wider[0, 1 + width + BLOCK + site] == 1.0 and np.count_nonzero(wider) == 1


def test_a_front_is_found_between_two_sites():
    sites = np.zeros((4, 12))
    sites[0] = 2.0 * np.exp(-np.arange(12.0))
    exact = [round(np.log(4.0 / level) / 2.0, 3) for level in (1e-6, 1e-2, 1.0)]
    np.testing.assert_allclose(find_front(sites), [*exact, -1.0], atol=1e-9)  # three decimals


def test_a_front_next_to_nothing_stands_on_its_last_site():
    sites = np.zeros((2, 10))
    sites[0, 2:5] = 3.0  # and nothing before or behind them
    assert find_front(sites).tolist() == [4.0] * len(LEVELS)
    sites[0, 3:6] = 0.0, 3.0, 1e-4  # now nothing before it, and little behind it
    assert 4.0 < find_front(sites)[0] < 5.0
    sites[0] = 3.0
    assert find_front(sites).tolist() == [9.0] * len(LEVELS)
