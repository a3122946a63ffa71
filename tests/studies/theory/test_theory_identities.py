"""What algebra proves of the equations, and that it is asked about the library's own equations."""

import numpy as np
import pytest
from oracle import BOUNDARIES, hamiltonian, slope
from pendula.studies.theory import derivation, polynomials
from pendula.studies.theory.identities import IDENTITIES, prove_identities
from pendula.studies.theory.polynomials import (
    CONSTANTS,
    EPSILON,
    GAMMA,
    GENS,
    MU,
    STATE,
    rational,
)

NUMBERS = (0.5, 0.75, -1.25)
Z = np.random.default_rng(5).integers(-8, 9, (2, polynomials.SITES, 2)) / 4 @ (1.0, 1j)


def at_numbers(polynomial) -> float:
    """Return the value of a polynomial in the constants and the state at NUMBERS and Z."""
    rows = np.stack([Z.real, Z.imag], axis=1).ravel()
    values = dict.fromkeys(map(str, GENS), 0.0) | dict(zip(CONSTANTS, NUMBERS, strict=True))
    values |= dict(zip(map(str, STATE.ravel()), rows, strict=True))
    return float(polynomial(*(rational(values[str(symbol)]) for symbol in GENS)))


def test_each_statement_leaves_nothing_and_each_wrong_twin_something():
    proved = prove_identities()
    assert (proved["terms"] == 0).all() and (proved["twin_terms"] > 0).all()
    assert proved.sizes == {"identity": len(IDENTITIES), "boundary": 3}


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_the_polynomials_are_the_equations_and_the_energy(boundary):
    computed = np.vectorize(at_numbers, otypes=[float])(polynomials.rates(boundary).ravel())
    re, im = computed.reshape(STATE.shape).swapaxes(0, 1)
    np.testing.assert_allclose(re + 1j * im, slope(Z, NUMBERS, boundary), rtol=1e-13)
    energy = at_numbers(polynomials.energy(boundary))
    assert energy == pytest.approx(hamiltonian(Z, NUMBERS, boundary), rel=1e-13)


def test_the_accelerations_are_those_of_newtons_equations():
    """Of A at the first site, where B is at rest: the springs, the drive and the sine of (1)."""
    x = np.stack([STATE[0, 0], 0 * STATE[0, 0]])
    computed = derivation.accelerations("dirichlet", x)
    first, second = STATE[0, 0, :2]
    drive = 2 * GAMMA * MU**2 * derivation.DOUBLE
    bond = EPSILON * MU**2 * (second - 2 * first)
    assert computed[0, 0] == bond - drive * first - (first - first**3 / 6)
    assert computed[1, 0] == drive * first
