"""Steady states: closed forms of one pair, the chain, its spectrum, and where there is none."""

import numpy as np
import pytest
from latticode.equations.ends import DIRICHLET, MIRROR
from latticode.localised.breathers import NoStateError, State, flat, newton
from latticode.localised.linearised import linearise
from pendula.models.amplitudes import Chain, rates, tangent_rates
from pendula.models.pairs import FAMILIES, pair
from pendula.problem import Constants
from pendula.studies.breathers import steady
from problems import problem_from

REAL, EQUAL, ASYMMETRIC, IMAGINARY, ASYMMETRIC_IMAGINARY = FAMILIES
each_family = pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)


def numbers(epsilon=1.0, gamma=1.0, omega=-4.0):
    return Constants(epsilon=epsilon, gamma=gamma, omega=omega)


def found_on(family, constants, half_width):
    """Return the problem and the state of a family, or None."""
    return next(steady.continued(family, constants, [half_width]), None)


def test_a_family_of_one_pair_ends_where_its_pitchfork_or_zero_is():
    """At Omega = 2 gamma, 0, -gamma, -2 gamma and -3 gamma."""
    for family, end in zip(FAMILIES, (2.0, 0.0, -1.0, -2.0, -3.0), strict=True):
        assert pair(family, 1.0, end - 1e-9) is not None
        assert pair(family, 1.0, end + 1e-9) is None
        assert found_on(family, numbers(omega=end + 0.5), 30) is None


def state_of_kernels(state):
    """Return the state of the kernels, (4, 1 + site), and the chain."""
    y = np.zeros((4, state.x.size // 4 + 2))
    y[:, 1:-1] = state.x.reshape(4, -1)
    return y, Chain(1.0, 1.0, -4.0, MIRROR, DIRICHLET)


@each_family
def test_the_kernels_of_the_integrators_see_a_state_at_rest_and_its_exponents(family):
    (_, long), (problem, state) = found_on(family, numbers(), 30), found_on(family, numbers(), 8)
    y, chain = state_of_kernels(long)
    dy = np.zeros_like(y)
    rates(chain, y, dy)
    assert np.abs(dy[:, 1:-1]).max() < 1e-11
    y, chain = state_of_kernels(state)
    rates(chain, y, np.zeros_like(y))  # fills the ghosts
    columns = []
    for unit in np.eye(state.x.size):
        w, dw = np.zeros_like(y), np.zeros_like(y)
        w[:, 1:-1] = unit.reshape(4, -1)
        tangent_rates(chain, y, w, dw)
        columns.append(dw[:, 1:-1].ravel())
    expected = np.linalg.eigvals(np.array(columns).T).real.max()
    even = linearise(problem, state.x, parity=state.parity)[1]
    np.testing.assert_allclose(even, np.array(columns).T, rtol=0, atol=1e-13)
    # where A = B the zero exponent is double, and rounding shows by its square root
    assert steady.growth(problem, state) >= expected - 3e-7


@pytest.mark.parametrize(("family", "epsilon", "omega", "stable"), [
    (EQUAL, 1.0, -4.0, False), (EQUAL, 1.0, -8.0, True), (REAL, 1.0, -12.0, False),
    (REAL, 1.0, -13.0, True), (ASYMMETRIC, 1.0, -13.0, True), (IMAGINARY, 1.0, -13.0, False),
    (EQUAL, 0.05, -5.0, True),
    # A = B on one pair swings at the square 4 gamma (-Omega - gamma), and the lower edge of the
    # band of A - B has Omega^2 - 4 gamma^2: the two are equal at Omega = -4 gamma
    (EQUAL, 0.01, -4.0, False),
])  # fmt: skip
def test_verdicts_of_stability_are_the_same_on_twice_the_chain(family, epsilon, omega, stable):
    for problem, state in steady.continued(family, numbers(epsilon, 1.0, omega), (20, 40)):
        assert (steady.growth(problem, state) == 0.0) is stable


@pytest.mark.parametrize("omega", [6.0, 6.5, 8.0])
def test_no_start_leads_to_a_state_where_the_theorem_forbids_one(omega):
    """Omega >= 4 epsilon + 2 gamma: the form is definite, so that only zero is left."""
    rng = np.random.default_rng(1)
    for _ in range(20):
        data = 4.0 * (rng.normal(size=(2, 21)) + 1j * rng.normal(size=(2, 21)))
        given = problem_from(data, (1.0, 1.0, omega))
        slopes = linearise(given, flat(data))[0].reshape(2, 2, 21)
        left = -slopes[:, 1] + 1j * slopes[:, 0]  # i dA/dtau
        assert np.sum(data.conj() * left).real >= 0.25 * np.sum(np.abs(data) ** 4) > 0.0
    for unit in (4.0, 4.0j):
        for sign in (1.0, -1.0):
            given = problem_from(np.array([[unit], [sign * unit]]), (1.0, 1.0, omega))
            given = given.changed(half_width=10)
            with pytest.raises(NoStateError):
                newton(given, State(flat(given.amplitudes, even=True), even=True), None)
