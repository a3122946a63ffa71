"""Steady states: closed forms of one pair, the chain, its spectrum, and where there is none."""

import numpy as np
import pytest
from latticode.equations.ends import DIRICHLET, MIRROR
from pendula.models.amplitudes import Chain as Ends
from pendula.models.amplitudes import rates, tangent_rates
from pendula.models.pairs import FAMILIES, pair
from pendula.studies.breathers import steady

REAL, EQUAL, ASYMMETRIC, IMAGINARY, ASYMMETRIC_IMAGINARY = FAMILIES
HERE = steady.Chain(epsilon=1.0, gamma=1.0, omega=-4.0, half_width=30)
each_family = pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)


@each_family
def test_the_closed_form_solves_the_equations_of_one_pair(family):
    alone = steady.Chain(epsilon=0.0, gamma=0.7, omega=-4.3, half_width=1)
    state = np.zeros((2, 2))
    state[:, 0] = pair(family, alone.gamma, alone.omega)
    assert np.abs(steady.residual(alone, family.drive(alone.gamma), state)).max() < 1e-13


def test_a_family_of_one_pair_ends_where_its_pitchfork_or_zero_is():
    """At Omega = 2 gamma, 0, -gamma, -2 gamma and -3 gamma."""
    for family, end in zip(FAMILIES, (2.0, 0.0, -1.0, -2.0, -3.0), strict=True):
        assert pair(family, 1.0, end - 1e-9) is not None
        assert pair(family, 1.0, end + 1e-9) is None
        assert steady.continued(HERE._replace(omega=end + 0.5), family) is None


def vector_field(chain, family, state):
    """Return the rates of the kernels at a steady state, (4, M + 1)."""
    y = np.zeros((4, state.shape[1] + 2))
    y[1 if family.imaginary else 0, 1:-1] = state[0]
    y[3 if family.imaginary else 2, 1:-1] = state[1]
    dy = np.zeros_like(y)
    ends = Ends(chain.epsilon, chain.gamma, chain.omega, MIRROR, DIRICHLET)
    rates(ends, y, dy)
    return ends, y, dy[:, 1:-1]


@each_family
def test_the_kernels_of_the_integrators_see_a_state_at_rest_and_its_exponents(family):
    assert np.abs(vector_field(HERE, family, steady.continued(HERE, family))[-1]).max() < 1e-11
    state = steady.continued(HERE._replace(half_width=8), family)
    ends, y, _ = vector_field(HERE, family, state)
    size = 4 * state.shape[1]
    jacobian = np.empty((size, size))
    for column in range(size):
        w, dw = np.zeros_like(y), np.zeros_like(y)
        w[:, 1:-1].reshape(4, -1)[np.unravel_index(column, (4, state.shape[1]))] = 1.0
        tangent_rates(ends, y, w, dw)
        jacobian[:, column] = dw[:, 1:-1].ravel()
    expected = np.linalg.eigvals(jacobian).real.max()
    found = steady.growth(
        steady.squared_exponents(HERE, family.drive(HERE.gamma), state, even=True)
    )
    # where A = B the zero exponent is double, and rounding shows by its square root
    assert found == pytest.approx(expected, abs=3e-7)


@pytest.mark.parametrize(("family", "epsilon", "omega", "stable"), [
    (EQUAL, 1.0, -4.0, False), (EQUAL, 1.0, -8.0, True), (REAL, 1.0, -12.0, False),
    (REAL, 1.0, -13.0, True), (ASYMMETRIC, 1.0, -13.0, True), (IMAGINARY, 1.0, -13.0, False),
    (EQUAL, 0.05, -5.0, True),
    # A = B on one pair swings at the square 4 gamma (-Omega - gamma), and the lower edge of the
    # band of A - B has Omega^2 - 4 gamma^2: the two are equal at Omega = -4 gamma
    (EQUAL, 0.01, -4.0, False),
])  # fmt: skip
def test_verdicts_of_stability_are_the_same_on_twice_the_chain(family, epsilon, omega, stable):
    for half_width in (20, 40):
        chain = steady.Chain(epsilon, 1.0, omega, half_width)
        assert (
            steady.fastest_growth(chain, family, steady.continued(chain, family)) == 0.0
        ) is stable


@pytest.mark.parametrize("omega", [6.0, 6.5, 8.0])
def test_no_start_leads_to_a_state_where_the_theorem_forbids_one(omega):
    """Omega >= 4 epsilon + 2 gamma: the form is definite, so that only zero is left."""
    rng = np.random.default_rng(1)
    chain = HERE._replace(omega=omega, half_width=10)
    for s in (chain.gamma, -chain.gamma):
        for _ in range(20):
            state = rng.normal(size=(2, 11)) * 4.0
            weights = np.array([1.0] + [2.0] * 10)
            form = np.sum(weights * state * steady.residual(chain, s, state))
            assert form >= 0.5 * np.sum(weights * state**4) > 0.0
    for sign in (1.0, -1.0):
        start = np.zeros((2, 11))
        start[:, 0] = (4.0, 4.0 * sign)
        with pytest.raises(steady.NotFoundError):
            steady.newton(chain, chain.gamma, start)


def test_the_size_of_the_steps_of_the_coupling_changes_no_state(monkeypatch):
    """In one step Newton's method would lose the family: the step is halved."""
    by_small_steps = steady.continued(HERE, REAL)
    monkeypatch.setattr(steady, "FIRST_STEP", 1.0)
    assert np.abs(steady.continued(HERE, REAL) - by_small_steps).max() < 1e-12
    monkeypatch.setattr(steady, "LARGEST_CHANGE", 0.0)
    with pytest.raises(steady.NotFoundError, match="ends at 0 of the coupling"):
        steady.continued(HERE, REAL)
