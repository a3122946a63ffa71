"""Steady states: closed forms of one pair, the chain, its spectrum, and where there is none."""

import numpy as np
import pytest
from pendula.ends import DIRICHLET
from pendula.models.amplitudes import Chain as Ends
from pendula.models.amplitudes import rates
from pendula.models.chain import MIRROR
from pendula.models.pairs import FAMILIES, pair
from pendula.models.tangent import tangent_rates
from pendula.studies.breathers.steady import (
    Chain,
    NotFoundError,
    continued,
    growth,
    newton,
    residual,
    squared_exponents,
)

REAL, EQUAL, ASYMMETRIC, IMAGINARY, ASYMMETRIC_IMAGINARY = FAMILIES
HERE = Chain(epsilon=1.0, gamma=1.0, omega=-4.0, half_width=30)


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
def test_the_closed_form_solves_the_equations_of_one_pair(family):
    alone = Chain(epsilon=0.0, gamma=0.7, omega=-4.3, half_width=1)
    state = np.zeros((2, 2))
    state[:, 0] = pair(family, alone.gamma, alone.omega)
    assert np.abs(residual(alone, family.drive(alone.gamma), state)).max() < 1e-13


@pytest.mark.parametrize(
    ("family", "ends_at"),
    [
        (REAL, 2.0),  # Omega < 2 gamma
        (EQUAL, 0.0),
        (ASYMMETRIC, -1.0),  # pitchfork of A = B at -gamma
        (IMAGINARY, -2.0),
        (ASYMMETRIC_IMAGINARY, -3.0),  # pitchfork of A = -B at -3 gamma
    ],
    ids=lambda value: getattr(value, "name", ""),
)
def test_a_family_of_one_pair_ends_where_its_pitchfork_or_zero_is(family, ends_at):
    assert pair(family, 1.0, ends_at - 1e-9) is not None
    assert pair(family, 1.0, ends_at + 1e-9) is None


def vector_field(chain, family, state):
    """Return the rates of the kernels at a steady state, (4, M + 1)."""
    y = np.zeros((4, state.shape[1] + 2))
    y[1 if family.imaginary else 0, 1:-1] = state[0]
    y[3 if family.imaginary else 2, 1:-1] = state[1]
    dy = np.zeros_like(y)
    ends = Ends(chain.epsilon, chain.gamma, chain.omega, MIRROR, DIRICHLET)
    rates(ends, y, dy)
    return ends, y, dy[:, 1:-1]


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
def test_the_kernels_of_the_integrators_see_a_state_at_rest(family):
    _, _, rate = vector_field(HERE, family, continued(HERE, family))
    assert np.abs(rate).max() < 1e-11


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
def test_exponents_are_those_of_the_variational_kernel(family):
    state = continued(HERE._replace(half_width=8), family)
    ends, y, _ = vector_field(HERE, family, state)
    size = 4 * state.shape[1]
    jacobian = np.empty((size, size))
    for column in range(size):
        w, dw = np.zeros_like(y), np.zeros_like(y)
        w[:, 1:-1].reshape(4, -1)[np.unravel_index(column, (4, state.shape[1]))] = 1.0
        tangent_rates(ends, y, w, dw)
        jacobian[:, column] = dw[:, 1:-1].ravel()
    expected = np.linalg.eigvals(jacobian).real.max()
    found = growth(squared_exponents(HERE, family.drive(HERE.gamma), state, even=True))
    # where A = B the zero exponent is double, and rounding shows by its square root
    assert found == pytest.approx(expected, abs=3e-7)


def test_odd_perturbations_are_those_of_a_chain_whose_centre_is_held():
    small = HERE._replace(half_width=2)
    state = continued(small, EQUAL)
    assert len(squared_exponents(small, 1.0, state, even=True)) == 6
    assert len(squared_exponents(small, 1.0, state, even=False)) == 4


def test_the_phase_of_equal_amplitudes_costs_nothing():
    squares = squared_exponents(
        HERE._replace(omega=-8.0), 1.0, continued(HERE._replace(omega=-8.0), EQUAL), True
    )
    assert np.abs(squares).min() < 1e-11
    assert growth(squares) == 0.0


@pytest.mark.parametrize(("family", "omega", "stable"), [
    (EQUAL, -4.0, False), (EQUAL, -8.0, True), (REAL, -12.0, False), (REAL, -13.0, True),
    (ASYMMETRIC, -13.0, True), (IMAGINARY, -13.0, False),
])  # fmt: skip
def test_verdicts_of_stability_are_the_same_on_twice_the_chain(family, omega, stable):
    for half_width in (20, 40):
        chain = HERE._replace(omega=omega, half_width=half_width)
        state, s = continued(chain, family), family.drive(chain.gamma)
        rate = max(growth(squared_exponents(chain, s, state, even)) for even in (True, False))
        assert (rate == 0.0) is stable


def test_all_families_are_unstable_at_the_detuning_of_fig_3():
    for family in FAMILIES:
        state, s = continued(HERE, family), family.drive(HERE.gamma)
        assert growth(squared_exponents(HERE, s, state, even=True)) > 0.1


def test_weak_coupling_leaves_stable_states():
    weak = HERE._replace(epsilon=0.05, omega=-5.0)
    state = continued(weak, EQUAL)
    assert growth(squared_exponents(weak, 1.0, state, even=True)) == 0.0


def test_equal_amplitudes_meet_the_band_at_once_at_minus_four():
    """A = B on one pair swings at the square 4 gamma (-Omega - gamma), and the lower edge of the
    band of A - B has Omega^2 - 4 gamma^2: the two are equal at Omega = -4 gamma, that of Fig 3."""
    weak = HERE._replace(epsilon=0.01)
    state = continued(weak, EQUAL)
    assert growth(squared_exponents(weak, 1.0, state, even=True)) > 1e-3


@pytest.mark.parametrize("omega", [6.0, 6.5, 8.0])
def test_no_start_leads_to_a_state_where_the_theorem_forbids_one(omega):
    """Omega >= 4 epsilon + 2 gamma: the form is definite, so that only zero is left."""
    rng = np.random.default_rng(1)
    chain = HERE._replace(omega=omega, half_width=10)
    for s in (chain.gamma, -chain.gamma):
        for _ in range(20):
            state = rng.normal(size=(2, 11)) * 4.0
            weights = np.array([1.0] + [2.0] * 10)
            form = np.sum(weights * state * residual(chain, s, state))
            assert form >= 0.5 * np.sum(weights * state**4) > 0.0
    for family in (REAL, EQUAL):
        start = np.zeros((2, 11))
        start[:, 0] = (4.0, -4.0 if family is REAL else 4.0)
        with pytest.raises(NotFoundError):
            newton(chain, chain.gamma, start)


def test_the_form_is_not_definite_below():
    """The bound of the theorem is sharp for the form: just below it takes both signs."""
    chain = HERE._replace(omega=5.9, half_width=200)
    n = np.arange(201)
    wave = (-1.0) ** n * np.cos(np.pi * n / 402) * 1e-3
    state = np.stack([wave, -wave])
    weights = np.array([1.0] + [2.0] * 200)
    assert np.sum(weights * state * residual(chain, chain.gamma, state)) < 0.0


def test_a_family_that_does_not_exist_is_none():
    assert continued(HERE._replace(omega=-2.5), ASYMMETRIC_IMAGINARY) is None


def test_a_step_that_changes_the_state_too_much_is_halved(monkeypatch):
    """From the pair to the full coupling in one step Newton's method would lose the family."""
    by_small_steps = continued(HERE, REAL)
    monkeypatch.setattr("pendula.studies.breathers.steady.FIRST_STEP", 1.0)
    assert np.abs(continued(HERE, REAL) - by_small_steps).max() < 1e-12


def test_a_family_that_ends_before_the_coupling_is_told(monkeypatch):
    monkeypatch.setattr("pendula.studies.breathers.steady.LARGEST_CHANGE", 0.0)
    with pytest.raises(NotFoundError, match="ends at 0 of the coupling"):
        continued(HERE, REAL)
