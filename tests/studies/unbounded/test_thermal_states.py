"""The thermal states by the transfer operator, against exact cases."""

import hashlib
from types import SimpleNamespace

import numpy as np
import pytest
from pendula.studies.unbounded import thermal
from pendula.studies.unbounded.transfer import (
    applied,
    leading,
    make_operator,
    reach_of,
)
from problems import constants_of

NODES = 12
"""As config/unbounded.yaml has it."""


def state_of(numbers, energy=0.0, nodes=NODES, antisymmetric=False):
    """Return the thermal state of the chain with these epsilon, gamma and Omega."""
    return thermal.state_of_energy(constants_of(numbers), energy, nodes, antisymmetric)


ALONE = pytest.mark.parametrize("alone", [False, True], ids=["both fields", "opposite fields"])


@ALONE
def test_a_pair_alone_is_a_plain_integral(alone):
    """Without bonds the mean over a site is an integral over the parts of A and B."""
    state = state_of((0.0, 0.7, -1.5), 2.0, antisymmetric=alone)
    x = np.linspace(-7.0, 7.0, 29)
    a, b, c, d = np.ix_(x, x, x, x)
    if alone:
        a, b = (grid.reshape(29, 29) for grid in (a + 0.0 * b, b + 0.0 * a))
        c, d = -a, -b
    first, second = a * a + b * b, c * c + d * d
    energy = 0.25 * (first * first + second * second) - 1.5 * (first + second)
    energy = energy - 0.7 * ((a - c) ** 2 - (b - d) ** 2)
    weight = np.exp(-state.beta * energy)
    assert np.average(energy, weights=weight) == pytest.approx(2.0, rel=1e-6)
    power = np.average(np.broadcast_to(first + second, energy.shape), weights=weight)
    assert state.power == pytest.approx(power, abs=max(3.0 * state.power_error, 1e-6))


@ALONE
def test_cold_states_of_a_stable_chain_are_those_of_its_waves(alone):
    """Without a cubic term a wave k has the mean square 1 / (2 beta) over its coefficient in H."""
    omega, gamma, epsilon = 12.0, 1.0, 1.0
    state = state_of((epsilon, gamma, omega), 1e-4, antisymmetric=alone)
    k = 2.0 * np.pi * np.arange(1024) / 1024
    shift = omega - 4.0 * epsilon * np.sin(0.5 * k) ** 2
    square = 0.5 * (1.0 / (shift - 2.0 * gamma) + 1.0 / (shift + 2.0 * gamma))
    square = square if alone else square + 1.0 / shift
    assert state.beta == pytest.approx((1.0 if alone else 2.0) / 1e-4, rel=1e-4)
    assert state.power == pytest.approx(square.mean() / state.beta, rel=1e-4)


def log_of_sum(constants, beta, nodes):
    """Return the logarithm of the sum over all states, a site: the largest eigenvalue."""
    operator = make_operator(constants, beta, nodes)
    psi, (_, t, _, q) = leading(operator), np.ix_(*nodes)
    shift = constants.omega - 4.0 * constants.epsilon
    site = operator.quartic + shift * operator.power - 2.0 * constants.gamma * (t * t - q * q)
    return np.log(np.sum(psi * applied(operator, psi))) - beta * site.min()


@ALONE
def test_energy_and_power_are_derivatives_of_the_free_energy(alone):
    """They come from one site alone; the largest eigenvalue counts the bonds too."""
    numbers = (0.9, 0.8, 1.3)
    state, step = state_of(numbers, 1.0, antisymmetric=alone), 1e-3
    beta, nodes = state.beta, state.operator.nodes
    hot, cold = (log_of_sum(constants_of(numbers), beta * by, nodes) for by in (1 - step, 1 + step))
    assert (hot - cold) / (2.0 * step * beta) == pytest.approx(1.0, rel=1e-4)
    less, more = (
        log_of_sum(constants_of((*numbers[:2], numbers[2] + by)), beta, nodes)
        for by in (-step, step)
    )
    assert (less - more) / (2.0 * step * beta) == pytest.approx(state.power, rel=1e-4)


def test_where_every_state_has_energy_there_is_none():
    with pytest.raises(ValueError, match="has the energy"):
        state_of((1.0, 1.0, 8.0))


HASH = "2bdb683494d790c2"
"""Of the bits that every machine must get of the states below."""


def test_the_bits_of_thermal_states_are_those_of_every_machine():
    numbers = []
    for omega, energy, alone in ((0.0, 0.0, False), (2.0, 0.0, True), (-4.0, 3.0, False)):
        state = state_of((1.0, 1.0, omega), energy, 8, alone)
        numbers += [state.beta, state.power, state.power_error]
    # adding zero makes -0 and 0 the same number
    bits = (np.array(numbers) + 0.0).tobytes()
    assert hashlib.sha256(bits).hexdigest()[:16] == HASH


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
