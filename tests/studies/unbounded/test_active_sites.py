"""Active sites: the numbers are those of the whole chain, and S and D obey its equations."""

import numpy as np
import pytest
from latticode.simulation.lattice import WHOLE
from latticode.simulation.simulate import simulate
from pendula.studies.unbounded.active_sites import (
    BLOCK,
    GUARD,
    advance,
    begin,
    find_front,
    piece_times,
    right_half,
    run_long,
    widen,
)
from pendula.studies.unbounded.sums import in_sums, turned
from problems import problem_of

TIGHT = {"name": "dop853", "rtol": 1e-14, "atol": 1e-14}
REST = 1e-20
LOPSIDED = {-2: (1.0, 0.1), 0: (0.0, 0.5j)}


def problem(case="fig3_small", **changes):
    chosen = {"half_width": None, "end_time": 40.0, "output_step": 0.5, "solver": TIGHT}
    return problem_of(case, **chosen | changes)


def end_of(given, rest=REST):
    """Return A and B on the sites 0..W at the end of a run."""
    own, rooms, even = in_sums(given), {}, np.array_equal(given.initial, given.initial[:, ::-1])
    state = begin(own.initial, given.half_width)
    for piece in range(round(given.end_time / 2.0)):
        state = widen(state, given.half_width, rest, even)
        advance(own, state, piece_times(given, piece), rooms, even)
    sites = turned(right_half(state, even))
    return sites[0::2] + 1j * sites[1::2]


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
    amplitudes, centre = end_of(windowed), whole.final.shape[1] // 2
    shared = min(centre, one.width[-1]) + 1
    right = whole.final[:, centre : centre + shared]
    np.testing.assert_allclose(amplitudes[:, :shared], right, atol=1e-10)
    powers = (np.abs(amplitudes) ** 2).sum(axis=0)
    assert one.front[-1] == pytest.approx(find_front(powers), abs=1e-3)
    sums = np.abs(amplitudes[0] + amplitudes[1]) ** 2 / 2.0
    assert one.second_front[-1] == pytest.approx(find_front(sums), abs=1e-3)


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
