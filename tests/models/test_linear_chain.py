"""The exact flow of the linear equations, against a matrix exponential and the solvers."""

import numpy as np
import pytest
from oracle import BOUNDARIES, laplacian, random_chain
from pendula.models.linear_chain import flow
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
    matrix = np.block(
        [
            [none, chain + drive, none, -drive],
            [drive - chain, none, -drive, none],
            [none, -drive, none, chain + drive],
            [-drive, none, drive - chain, none],
        ]
    )
    components = np.concatenate([z[0].real, z[0].imag, z[1].real, z[1].imag])
    re_a, im_a, re_b, im_b = (expm(tau * matrix) @ components).reshape(4, sites)
    return np.stack([re_a + 1j * im_a, re_b + 1j * im_b])


@each_boundary
@pytest.mark.parametrize("constants", [CONSTANTS, (1.0, 1.0, 8.0), (1.0, 1.0, 0.0)])
@pytest.mark.parametrize("half_width", [0, 1, 2, 5])
def test_flow_is_the_matrix_exponential(half_width, constants, boundary):
    """With all waves stable and with unstable ones."""
    z = random_chain(half_width)
    for tau in (0.0, 0.8, -0.5):
        expected = exponential(z, tau, constants, boundary)
        computed = flow(z, tau, *constants, boundary)
        np.testing.assert_allclose(computed, expected, atol=1e-12, err_msg=f"tau = {tau}")
