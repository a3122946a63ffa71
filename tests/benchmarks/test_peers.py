"""Other people's integrators against ours, on a small chain."""

import numpy as np
import pytest
from helpers import skip
from oracle import SOLVERS, random_chain
from pendula.problem import Constants, Problem
from pendula.simulation.lattice import WHOLE
from pendula.simulation.simulate import simulate

from benchmarks.contestants import PEERS

WAY = "install that beside environment.txt, in the same environment"
CASES = {  # a peer's tolerance, and the largest error of an amplitude that it may leave
    "scipy_rk45_numpy": (1e-9, 1e-6),
    "scipy_dop853_numpy": (1e-11, 1e-8),
    "scipy_rk45": (1e-9, 1e-6),
    "scipy_dop853": (1e-11, 1e-8),
    "scipy_lsoda": (1e-10, 1e-6),
    "scipy_radau": (1e-6, 1e-3),
    "heyoka_full": (1e-12, 1e-10),
    "heyoka_half": (1e-12, 1e-10),
    "cvode_adams": (1e-10, 1e-6),
    "octave_ode45": (1e-7, 1e-4),
    "numbalsoda_dop853": (1e-11, 1e-8),
    "numbalsoda_dop853_half": (1e-11, 1e-8),
    "cpp_taylor": (1e-12, 1e-10),
    "cpp_taylor_contracted": (1e-12, 1e-10),
    "cpp_taylor_eight": (1e-12, 1e-10),
}


def problem(boundary="dirichlet", half_width=5, even=True):
    return Problem(
        constants=Constants(epsilon=1.0, gamma=1.0, omega=-4.0),
        half_width=half_width,
        boundary=boundary,
        initial=random_chain(half_width, even=even),
        end_time=2.0,
        output_step=2.0,
        solver={"name": "dop853", "rtol": 1e-13, "atol": 1e-13},
    )


def test_every_peer_has_a_case():
    assert CASES.keys() == PEERS.keys()


@pytest.mark.parametrize("name", PEERS)
def test_peers_agree_with_ours(name):
    peer = PEERS[name]
    if reason := peer.why_absent():
        skip(reason, WAY)
    rtol, bound = CASES[name]
    given = problem()
    exact = simulate(given, WHOLE).final
    solve = peer.prepare(given)
    first, seconds = solve(rtol)
    again, _ = solve(rtol)
    assert np.abs(first - exact).max() < bound
    np.testing.assert_array_equal(again, first)
    assert seconds > 0.0


@pytest.mark.parametrize("half_width", [3, 4, 5, 6])
@pytest.mark.parametrize("name", ["cpp_taylor", "cpp_taylor_contracted", "cpp_taylor_eight"])
def test_the_taylor_method_in_cpp_is_ours_to_rounding(name, half_width):
    if reason := PEERS[name].why_absent():
        skip(reason, WAY)
    given = problem(half_width=half_width)
    expected = simulate(given.changed(solver=SOLVERS["taylor"])).final
    actual, _ = PEERS[name].prepare(given)(SOLVERS["taylor"]["rtol"])
    np.testing.assert_allclose(actual, expected, rtol=0, atol=1e-12)
