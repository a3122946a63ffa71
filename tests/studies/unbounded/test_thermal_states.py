"""The thermal states by the transfer operator, against exact cases."""

import hashlib

import numpy as np
import pytest
from pendula.studies.unbounded import thermal
from pendula.studies.unbounded.transfer import (
    applied,
    leading,
    make_operator,
)
from problems import constants_of

NODES = 12
"""As config/unbounded.yaml has it."""


def state_of(numbers, energy=0.0, nodes=NODES, antisymmetric=False):
    """Return the thermal state of the chain with these epsilon, gamma and Omega."""
    return thermal.state_of_energy(constants_of(numbers), energy, nodes, antisymmetric)


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
