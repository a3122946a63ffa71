"""The exact flow of the linear equations, against a matrix exponential and the solvers."""

import numpy as np
import pytest
from oracle import BOUNDARIES, SOLVERS, laplacian, random_chain
from pendula.models.linear_chain import driven, flow, stable_windows, widest_gamma
from pendula.simulation.simulate import simulate
from problems import make_problem
from scipy.linalg import expm

CONSTANTS = (0.7, 1.3, -2.1)
each_boundary = pytest.mark.parametrize("boundary", BOUNDARIES)


def exponential(z, tau, constants, boundary):
    """Return the linear flow by the exponential of one real matrix for Re A, Im A, Re B, Im B."""
    epsilon, gamma, omega = constants
    sites = z.shape[1]
    chain = epsilon * laplacian(sites, boundary) + omega * np.eye(sites)
    drive = gamma * np.eye(sites)
    none = np.zeros_like(chain)
    # A' = -i (chain A + gamma (conj B - conj A)) in its real and imaginary parts
    matrix = np.block([
        [none, chain + drive, none, -drive],
        [drive - chain, none, -drive, none],
        [none, -drive, none, chain + drive],
        [-drive, none, drive - chain, none],
    ])  # fmt: skip
    parts = np.concatenate([z[0].real, z[0].imag, z[1].real, z[1].imag])
    re_a, im_a, re_b, im_b = (expm(tau * matrix) @ parts).reshape(4, sites)
    return np.stack([re_a + 1j * im_a, re_b + 1j * im_b])


@each_boundary
@pytest.mark.parametrize("constants", [CONSTANTS, (1.0, 1.0, 8.0), (1.0, 1.0, 0.0)])
@pytest.mark.parametrize("half_width", [0, 1, 2, 5])
def test_flow_is_the_matrix_exponential(half_width, constants, boundary):
    """With all waves stable and with unstable ones."""
    z = random_chain(half_width)
    for tau in (0.0, 0.8, -0.5):
        expected = exponential(z, tau, constants, boundary)
        found = flow(z, tau, *constants, boundary)
        np.testing.assert_allclose(found, expected, atol=1e-12, err_msg=f"tau = {tau}")


@each_boundary
@pytest.mark.parametrize("name", SOLVERS)
def test_solvers_follow_the_flow_up_to_the_cube_of_the_amplitude(name, boundary):
    """Only the cubic term parts them: half the amplitude, an eighth of the difference."""
    solver = SOLVERS[name] | {"rtol": 1e-11, "atol": 1e-13, "step": 1e-3}
    difference = []
    for size in (0.08, 0.04):
        z = size * random_chain(3)
        final = simulate(make_problem(z, CONSTANTS, boundary, solver)).final
        difference.append(np.linalg.norm(final - flow(z, 1.0, *CONSTANTS, boundary)))
    assert difference[0] / difference[1] == pytest.approx(8.0, rel=0.05)


def test_a_mode_grows_turns_or_drifts_on_either_side_of_its_threshold():
    """D'' = (4 gamma^2 - kappa^2) D, with gamma = 1 / 2 and squares of 1 / 4, -1 / 4 and 0."""
    kappa, tau = np.sqrt([0.75, 1.25, 1.0]), 0.8
    even, odd = driven(kappa, 0.5, tau)
    np.testing.assert_allclose(even, [np.cosh(0.4), np.cos(0.4), 1.0], rtol=1e-14)
    np.testing.assert_allclose(odd, [2 * np.sinh(0.4), 2 * np.sin(0.4), 0.8], rtol=1e-14)


def test_windows_of_short_chains():
    """The modes of a free chain of three sites have 0, 1 and 3; a window of no width is none."""
    expected = [[0.0, 1.0], [1.0, 3.0], [3.0, 4.0]]
    np.testing.assert_allclose(stable_windows(0.0, 1.0, 3, "free"), expected, atol=1e-13)


@pytest.mark.parametrize(
    ("sites", "boundary", "widest"),
    [(1, "dirichlet", 1.0), (2, "dirichlet", 0.5), (1, "free", 2.0), (2, "free", 1.0)],
)
def test_the_widest_gamma_of_short_chains(sites, boundary, widest):
    """Their modes have 2; 1 and 3; 0; 0 and 2."""
    assert widest_gamma(1.0, sites, boundary) == pytest.approx(widest, rel=1e-14)
