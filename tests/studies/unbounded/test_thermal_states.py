"""The thermal states by the transfer operator, against exact cases and against sampled rings."""

import hashlib
from types import SimpleNamespace

import numpy as np
import pytest
from metropolis import energy_of, mean_and_error, sample
from oracle import hamiltonian, random_chain
from pendula.studies.unbounded import thermal
from pendula.studies.unbounded.transfer import (
    REACH,
    applied,
    leading,
    make_operator,
    reach_of,
    widest,
)
from problems import constants_of
from scipy.optimize import minimize_scalar

NODES = 12
"""As config/unbounded.yaml has it."""


def state_of(numbers, energy=0.0, nodes=NODES, antisymmetric=False):
    """Return the thermal state of the chain with these epsilon, gamma and Omega."""
    return thermal.state_of_energy(constants_of(numbers), energy, nodes, antisymmetric)


@pytest.fixture(scope="module", params=[False, True], ids=["both fields", "opposite fields"])
def sampled(request):
    """A state of no energy, whether its fields are opposite, and rings sampled at its temperature.

    The rings must be much longer than the correlations, which reach over 90 sites at Omega = 5,
    and settle soon: those of Omega = 4 take three times as long.
    """
    alone = request.param
    state = state_of((1.0, 1.0, 2.0 if alone else 0.0), antisymmetric=alone)
    return state, alone, sample(state.operator.constants, state.beta, antisymmetric=alone)


def test_the_energy_of_the_sampled_rings_is_that_of_the_paper():
    numbers = (0.8, 0.6, -1.5)
    a, b = random_chain(7)
    found = energy_of(constants_of(numbers), a[None], b[None])[0]
    assert found == pytest.approx(hamiltonian(np.array([a, b]), numbers, "periodic"), rel=1e-12)


def test_sampled_rings_have_the_power_and_no_energy(sampled):
    state, alone, (powers, energies, *_) = sampled
    power, error = mean_and_error(powers)
    assert error < 0.006 * power
    wrong = state_of(state.operator.constants.scaled(1.05), antisymmetric=alone).power
    assert abs(power - state.power) < 3.0 * error < abs(power - wrong)
    energy, error = mean_and_error(energies)
    assert abs(energy - state.energy) < 3.0 * error


def test_a_pair_alone_is_a_plain_integral():
    """Without bonds the mean over a site is an integral over the four parts of A and B."""
    state = state_of((0.0, 0.7, -1.5), 2.0)
    x = np.linspace(-7.0, 7.0, 29)
    a, b, c, d = np.ix_(x, x, x, x)
    first, second = a * a + b * b, c * c + d * d
    energy = 0.25 * (first * first + second * second) - 1.5 * (first + second)
    energy = energy - 0.7 * ((a - c) ** 2 - (b - d) ** 2)
    weight = np.exp(-state.beta * energy)
    assert np.average(energy, weights=weight) == pytest.approx(2.0, rel=1e-6)
    power = np.average(np.broadcast_to(first + second, energy.shape), weights=weight)
    assert state.power == pytest.approx(power, abs=max(3.0 * state.power_error, 1e-6))


def test_cold_states_of_a_stable_chain_are_those_of_its_waves():
    """Without a cubic term a wave k has the mean square 1 / (2 beta) over its coefficient in H."""
    omega, gamma, epsilon = 12.0, 1.0, 1.0
    state = state_of((epsilon, gamma, omega), 1e-4)
    k = 2.0 * np.pi * np.arange(1024) / 1024
    shift = omega - 4.0 * epsilon * np.sin(0.5 * k) ** 2
    square = 0.5 * (2.0 / shift + 1.0 / (shift - 2.0 * gamma) + 1.0 / (shift + 2.0 * gamma))
    assert state.beta == pytest.approx(2.0 / 1e-4, rel=1e-4)
    assert state.power == pytest.approx(square.mean() / state.beta, rel=1e-4)


def test_the_energy_is_the_derivative_of_the_free_energy():
    """The energy comes from one site alone; the largest eigenvalue counts the bonds too."""
    state = state_of((0.9, 0.8, 1.3), 1.0)
    constants, _, nodes, *_ = state.operator
    _, t, _, q = np.ix_(*nodes)

    def log_of_sum(beta):
        operator = make_operator(constants, beta, nodes)
        psi = leading(operator)
        site = operator.quartic - 2.3 * operator.power - 1.6 * (t * t - q * q)
        return np.log(np.sum(psi * applied(operator, psi))) - beta * site.min()

    step = 1e-3 * state.beta
    slope = (log_of_sum(state.beta + step) - log_of_sum(state.beta - step)) / (2.0 * step)
    assert -slope == pytest.approx(1.0, rel=1e-4)


def test_where_every_state_has_energy_there_is_none():
    with pytest.raises(ValueError, match="has the energy"):
        state_of((1.0, 1.0, 8.0))


HASH = "30434829d074af90"
"""Of the bits that every machine must get of the states below."""


def test_the_bits_of_thermal_states_are_those_of_every_machine():
    told = []
    for omega, energy, alone in ((0.0, 0.0, False), (2.0, 0.0, True), (-4.0, 3.0, False)):
        state = state_of((1.0, 1.0, omega), energy, 8, alone)
        told += [state.beta, state.power, state.power_error]
    # adding zero makes -0 and 0 the same number
    bits = (np.array(told) + 0.0).tobytes()
    assert hashlib.sha256(bits).hexdigest()[:16] == HASH


@pytest.mark.parametrize("numbers", [(1.0, 1.0, -4.0), (0.7, 1.3, 2.0), (0.5, 0.2, 9.0)])
def test_the_grid_reaches_as_far_as_the_deepest_wave_has_weight(numbers):
    """On a ring A_n = -B_n = (-1)^n x has the least energy of all states of its power."""

    def energy(power):
        wave = np.sqrt(power / 2.0) * (-1.0) ** np.arange(4)
        return hamiltonian(np.array([wave, -wave]).astype(complex), numbers, "periodic") / 4.0

    found = minimize_scalar(energy, bounds=(0.0, 100.0), method="bounded", options={"xatol": 1e-7})
    least = min(found.fun, energy(0.0))
    for beta in (0.1, 2.0):
        edges = widest(constants_of(numbers), beta)
        np.testing.assert_array_equal(edges, edges[0])
        assert beta * (energy(edges[0] ** 2) - least) == pytest.approx(REACH, rel=1e-5)


def test_a_grid_reaches_one_node_beyond_the_last_that_counts_and_never_past_its_end():
    vector = np.zeros((2, 5, 5, 5, 5))
    for last in ([0, 1, 2, 4], [3, 3, 3, 3]):
        vector[:, *last] = 1.0
    state = SimpleNamespace(nodes=tuple(np.arange(20.0).reshape(4, 5)))
    assert reach_of(state, vector).tolist() == [4.0, 9.0, 14.0, 19.0]
    vector[:, 3, 3, 3, 3] = 3e-5  # its square is below a part of 1e-9
    assert reach_of(state, vector).tolist() == [1.0, 7.0, 13.0, 19.0]
    vector[:, 3, 3, 3, 3] = 3.2e-5
    assert reach_of(state, vector).tolist() == [4.0, 9.0, 14.0, 19.0]
