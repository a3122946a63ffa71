"""Runs on an infinite chain: exact solutions, and chains that grow where the motion comes."""

import numpy as np
import pytest
from latticode import Model, abs2, lap
from latticode.equations.initial_values import on_sites
from latticode.simulation.active_sites import BLOCK, GUARD, integrate_intervals, widen
from latticode.simulation.problem import Problem
from latticode.simulation.simulate import simulate
from scipy.special import jv

LINEAR = Model(fields="u", parameters={}, i_dt=lambda p, u: lap(u) + 2.0 * u)
CUBIC = Model(fields="u", parameters={}, i_dt=lambda p, u: lap(u) + abs2(u) * u)
TIGHT = {"name": "taylor", "rtol": 1e-15, "atol": 1e-15}


def endless(model, initial, **changes):
    values = {"half_width": None, "boundary": "dirichlet", "end_time": 60.0, "output_step": 0.5}
    return Problem(model=model, initial=on_sites(initial, 1), solver=TIGHT, **values | changes)


def test_a_linear_chain_spreads_as_bessel_functions():
    """i u_n' = u_{n+1} + u_{n-1} from one site: u_n = (-i)^n J_n(2 t)."""
    *_, last = integrate_intervals(endless(LINEAR, {0: (1.0,)}), 1e-20)
    u = last.right_half[0] + 1j * last.right_half[1]
    n = np.arange(u.size)
    assert last.times[-1] == 60.0 and u.size > 120
    np.testing.assert_allclose(u, (-1j) ** n * jv(n, 120.0), atol=2e-13)


@pytest.mark.parametrize("start_time", [0.0, 3.0])
def test_data_that_are_not_even_move_as_on_a_long_chain(start_time):
    data = {-1: (1.0,), 2: (0.5j,)}
    times = {"start_time": start_time, "end_time": start_time + 20.0}
    problem = endless(CUBIC, data, **times)
    intervals = list(integrate_intervals(problem, 1e-20))
    finite = simulate(problem.changed(half_width=200))
    norms = np.concatenate([interval.record.l2[0, 1:] for interval in intervals])
    np.testing.assert_allclose(norms, finite.l2[0, 1:], rtol=1e-12)
    last = intervals[-1]
    u = last.right_half[0] + 1j * last.right_half[1]
    np.testing.assert_allclose(u, finite.final[0, 200 : 200 + u.size], atol=1e-11)
    assert intervals[0].times[0] == start_time and last.times[-1] == finite.tau[-1]


def test_a_chain_is_widened_where_its_last_sites_are_above_rest():
    """What is added is at rest, whatever the ghosts held: the one at the right becomes a site."""
    state = np.zeros((4, 2 * GUARD + 2))
    state[0, 1], state[2, [0, -1]] = 2.0, 7.0
    for site, amplitude, grows in (
        (GUARD, 2.01e-6, True),
        (GUARD, 2e-6, False),
        (GUARD - 1, 1.0, False),
        (2 * GUARD - 1, 2.01e-6, True),
    ):
        moved = state.copy()
        moved[1, 1 + site] = amplitude
        wider = widen(moved, 1e-6)
        assert wider.shape[1] == state.shape[1] + BLOCK * grows
        np.testing.assert_array_equal(wider[:, 1 : 2 * GUARD + 1], moved[:, 1:-1])
        assert not grows or not (wider[:, 2 * GUARD + 1 :].any() or wider[:, 0].any())
