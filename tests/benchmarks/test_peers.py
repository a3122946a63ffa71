"""Other people's integrators against ours, on a small chain of amplitudes and one of pendula."""

import numpy as np
import pytest
from helpers import skip
from latticode.simulation.lattice import WHOLE
from latticode.simulation.simulate import simulate
from oracle import SOLVERS, random_chain
from problems import problem_from, problem_of

from benchmarks import pendula
from benchmarks.contestants import PEERS
from benchmarks.peers_in_python import OF_PENDULA

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
TIGHT = {"name": "dop853", "rtol": 1e-13, "atol": 1e-13}
TIGHT_SERIES = {"name": "taylor", "rtol": 1e-15, "atol": 1e-15}
PENDULA = pendula.as_pendula(problem_of("fig3_small", half_width=3))


def even_chain(half_width=5):
    return problem_from(
        random_chain(half_width, even=True), (1.0, 1.0, -4.0), end_time=2.0, output_step=2.0
    )


@pytest.mark.parametrize("name", PEERS)
def test_peers_agree_with_ours(name):
    peer = PEERS[name]
    if reason := peer.why_absent():
        skip(reason, WAY)
    rtol, bound = CASES[name]
    exact = simulate(even_chain().changed(solver=TIGHT), WHOLE).final
    solve = peer.prepare(even_chain())
    first, seconds = solve(rtol)
    again, _ = solve(rtol)
    assert np.abs(first - exact).max() < bound
    np.testing.assert_array_equal(again, first)
    assert seconds > 0.0


@pytest.mark.parametrize("name", ["cpp_taylor", "cpp_taylor_contracted", "cpp_taylor_eight"])
def test_the_taylor_method_in_cpp_is_ours_to_rounding(name):
    if reason := PEERS[name].why_absent():
        skip(reason, WAY)
    given = even_chain(4)
    expected = simulate(given.changed(solver=SOLVERS["taylor"])).final
    actual, _ = PEERS[name].prepare(given)(SOLVERS["taylor"]["rtol"])
    np.testing.assert_allclose(actual, expected, rtol=0, atol=1e-12)


@pytest.mark.parametrize("name", OF_PENDULA)
def test_peers_agree_with_ours_on_pendula(name):
    if reason := OF_PENDULA[name].why_absent():
        skip(reason, WAY)
    found, seconds = OF_PENDULA[name].prepare(PENDULA)(1e-12)
    exact = simulate(PENDULA.changed(solver=TIGHT_SERIES)).final
    assert found.shape == exact.shape and seconds > 0
    np.testing.assert_allclose(found, exact, rtol=0, atol=2e-9)
