"""The largest modulus of N neighbours: exact cases, another quadrature, and sampled rings."""

import hashlib

import numpy as np
import pytest
import xarray as xr
from latticode.datasets.netcdf import as_xarray
from metropolis import RINGS, SITES, sample
from pendula.studies.unbounded.extremes import law_of_maxima, mean_maximum
from pendula.studies.unbounded.thermal import maximum_variables, state_of_energy
from problems import constants_of
from scipy.special import i0e

BETA, BOUNDS = 0.0335, np.array([2.5, 3.5, 4.5, 5.5, 8.5])
"""About the temperature of the paper's Fig 4, and a last bound that stands for none."""


@pytest.fixture(scope="module")
def fig4():
    """The thermal state of the paper's Fig 4, and the law of its maxima as a dataset."""
    state = state_of_energy(constants_of((1.0, 1.0, 0.0)), 0.0, 8)
    law = as_xarray(maximum_variables(state), {})
    assert (np.diff(law["bound_rate"]) <= 0.0).all() and law["bound_rate"][-1] == 0.0
    assert (np.diff(law["bound_overlap"]) >= 0.0).all() and law["bound_omega"] == 0.0
    return state, law


def dataset(bounds, rates, overlaps):
    """Return a law of maxima as a dataset."""
    values = {"bound": bounds, "bound_rate": rates, "bound_overlap": overlaps}
    return xr.Dataset({name: ("bound", one) for name, one in values.items()})


def radial(beta, omega, bound, count=60):
    """Return the operator of an amplitude without drive on moduli alone: nodes and matrix.

    Over the angle between neighbours exp(2 beta r r' cos) has the mean I_0(2 beta r r').
    """
    nodes, weights = np.polynomial.legendre.leggauss(count)
    r = 0.5 * bound * (nodes + 1.0)
    root = np.exp(-0.5 * beta * (0.25 * r**4 + (omega - 4.0) * r**2)) * np.sqrt(bound * weights * r)
    return r, root[:, None] * root * np.exp(-beta * (r[:, None] - r) ** 2) * i0e(
        2.0 * beta * np.outer(r, r)
    )


def test_without_drive_the_chains_of_a_and_b_are_independent_ones_of_moduli():
    """One quadrature over moduli gives all that two sites of the infinite chain can do."""
    omega = 0.5
    rates, overlaps = law_of_maxima(constants_of((1.0, 0.0, omega)), BETA, BOUNDS)
    r, matrix = radial(BETA, omega, BOUNDS[-1], 400)
    values, vectors = np.linalg.eigh(matrix)
    for bound, rate, overlap in zip(BOUNDS[:-1], rates, overlaps, strict=False):
        restricted = np.linalg.eigvalsh(radial(BETA, omega, bound)[1])[-1]
        assert rate == pytest.approx(-2.0 * np.log(restricted / values[-1]), rel=1e-5)
        psi = vectors[:, -1] * (r <= bound)  # the sharp end costs a node of 400
        one, two = psi @ psi, psi @ matrix @ psi / values[-1]
        assert overlap == pytest.approx(one**2, rel=0.02)
        assert overlap * np.exp(-rate) == pytest.approx(two**2, rel=0.03)


def test_sampled_rings_have_these_maxima(fig4):
    """On a ring of many sites the probability is the power of the eigenvalues alone.

    Each ring is one sample: what it remembers of its earlier states enters no error.
    """
    state, law = fig4
    maxima = sample(state.operator.constants, state.beta)[-1]
    ring = law.assign(bound_overlap=0.0 * law["bound_overlap"] + 1.0)
    mean, error = maxima.mean(), maxima.mean(axis=0).std(ddof=1) / np.sqrt(RINGS)
    assert error < 0.01
    assert abs(mean - mean_maximum(ring, SITES + 1)) < 3.0 * error
    for wrong in (2.0 * SITES, 0.7 * SITES):
        assert abs(mean - mean_maximum(ring, wrong)) > 5.0 * error
    for m in (4.7, 5.0, 5.3, 5.6):
        shares = (maxima <= m).mean(axis=0)
        rate = law_of_maxima(state.operator.constants, state.beta, np.array([m, 8.5]))[0][0]
        error = shares.std(ddof=1) / np.sqrt(RINGS)
        assert abs(shares.mean() - np.exp(-SITES * rate)) < 3.5 * error, m
    groups = maxima.reshape(len(maxima), 4, -1).max(axis=2)  # of 16 rings, 1024 sites
    assert groups.mean() == pytest.approx(float(mean_maximum(ring, 16 * SITES + 1)), abs=0.05)


def test_the_mean_of_the_largest_is_the_integral_over_what_it_exceeds():
    bounds = np.linspace(0.01, 1.0, 100)
    law = dataset(bounds, -np.log(bounds), bounds)  # uniform moduli: N / (N + 1)
    assert mean_maximum(law, 1) == pytest.approx(0.5, abs=1e-4)
    np.testing.assert_allclose(mean_maximum(law, np.array([[3, 9]])), [[0.75, 0.9]], atol=1e-3)


HASH = "6a2f8e8c7afb7bd3"
"""Of the bits that every machine must get of the law below."""


def test_the_bits_of_the_law_are_those_of_every_machine():
    told = law_of_maxima(constants_of((1.0, 1.0, 0.0)), BETA, BOUNDS)
    assert hashlib.sha256(np.array(told).tobytes()).hexdigest()[:16] == HASH
