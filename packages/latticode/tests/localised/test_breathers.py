"""Localised states against exact ones, closed forms of one pair, differences and integrations."""

import numpy as np
import pytest
from latticode.equations.model import Model, abs2, conj, lap, shift
from latticode.localised.breathers import (
    LocalisedState,
    NoStateError,
    exponents,
    find_state,
    flat,
    newton,
    widened,
)
from latticode.localised.linearised import EVEN, ODD, linearise
from latticode.simulation.problem import Problem
from latticode.simulation.simulate import simulate

CUBIC = Model(fields="u", parameters={}, i_dt=lambda p, u: 0.3 * lap(u) + abs2(u) * u)
COUPLED = Model(
    fields=("A", "B"),
    parameters={"epsilon": 1.0, "gamma": 1.0, "omega": -8.0},
    i_dt=lambda p, a, b: [
        p.epsilon * lap(u) + p.omega * u + p.gamma * (conj(v) - conj(u)) + 0.5 * abs2(u) * u
        for u, v in ((a, b), (b, a))
    ],
)
FAR = Model(
    fields="u",
    parameters={"J": 0.3},
    i_dt=lambda p, u: lap(u) + p.J * (shift(u, 2) + shift(u, -2)) * abs2(u) - u,
)


def problem(model, data, half_width=10, boundary="dirichlet", site=0):
    """Return the problem of data (field, ...) on one site."""
    initial = np.zeros((len(model.fields), 2 * abs(site) + 1), complex)
    initial[:, abs(site) + site] = data
    return Problem(
        model=model,
        half_width=half_width,
        boundary=boundary,
        initial=initial,
        end_time=1.0,
        output_step=1.0,
        solver={"name": "taylor", "rtol": 1e-13, "atol": 1e-13},
    )


# --- The matrix -----------------------------------------------------------------------------------


@pytest.mark.parametrize("boundary", ["dirichlet", "free", "periodic"])
@pytest.mark.parametrize("model", [COUPLED, FAR], ids=["coupled", "far"])
def test_even_and_odd_perturbations_have_together_the_matrix_of_the_whole_chain(model, boundary):
    case, rng = problem(model, 1.0, half_width=5, boundary=boundary), np.random.default_rng(1)
    fields, size = len(model.fields), 4 * len(model.fields) * 5
    half = rng.normal(size=(2 * fields, 6))
    full = np.concatenate([half[:, :0:-1], half], axis=1).ravel()
    rates, matrix = linearise(case, full)
    retained, even = linearise(case, half.ravel(), parity=EVEN)
    odd = linearise(case, half.ravel(), parity=ODD)[1]
    np.testing.assert_allclose(retained, rates.reshape(-1, 11)[:, 5:].ravel(), rtol=0, atol=1e-13)
    computed = np.concatenate([np.linalg.eigvals(even), np.linalg.eigvals(odd)])
    expected = np.linalg.eigvals(matrix)
    assert odd.shape == (size // 2, size // 2)
    assert max(np.abs(expected - first).min() for first in computed) < 1e-7
    assert computed.sum() == pytest.approx(np.trace(matrix), abs=1e-9)


@pytest.mark.parametrize("boundary", ["dirichlet", "free", "periodic", "antiperiodic"])
def test_the_matrix_is_that_of_differences_of_the_rates(boundary):
    case, rng = problem(FAR, 1.0, half_width=4, boundary=boundary), np.random.default_rng(2)
    x, change, h = rng.normal(size=18), rng.normal(size=18), 1e-6
    for coupling in (1.0, 0.4):
        ahead, behind = (linearise(case, x + s * change, coupling)[0] for s in (h, -h))
        moved = linearise(case, x, coupling)[1] @ change
        np.testing.assert_allclose(moved, (ahead - behind) / (2 * h), rtol=1e-6, atol=1e-7)


# --- States ---------------------------------------------------------------------------------------


def test_a_localised_state_is_the_exact_one_of_ablowitz_and_ladik():
    """u_n = sinh(b) / cosh(b n) turns at the frequency 2 cosh(b), and is neutrally stable."""
    model = Model(fields="u", parameters={}, i_dt=lambda p, u: (u.right + u.left) * (1 + abs2(u)))
    exact = np.sinh(1.0) / np.cosh(np.arange(-15, 16))
    case = problem(model, np.sqrt(np.sum(exact**2)), half_width=15)
    state = find_state(case)
    np.testing.assert_allclose(np.hypot(*state.components(case)[0]), exact, rtol=0, atol=1e-5)
    assert state.frequency == pytest.approx(2.0 * np.cosh(1.0), rel=1e-5)
    assert np.abs(exponents(case, state).real).max() < 1e-5


def test_a_state_beside_the_middle_is_found_on_the_whole_chain():
    middle, neighbour = (problem(CUBIC, 1.5, half_width=20, site=site) for site in (0, 1))
    half, full = find_state(middle), find_state(neighbour)
    assert half.even and not full.even
    moduli = [np.hypot(*state.components(middle)[0]) for state in (half, full)]
    np.testing.assert_allclose(moduli[1][1:], moduli[0][:-1], rtol=0, atol=1e-8)
    assert full.frequency == pytest.approx(half.frequency, rel=1e-9)


def test_with_another_sign_of_the_cubic_term_there_is_no_such_state():
    """Only (u.right + u.left) (1 - |u|^2) has dark solitons alone."""
    model = Model(fields="u", parameters={}, i_dt=lambda p, u: (u.right + u.left) * (1 - abs2(u)))
    with pytest.raises(NoStateError):
        find_state(problem(model, 0.9, half_width=15))


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_pair_of_the_coupled_chain_continues_its_closed_form(sign):
    """A = B with A^2 = -2 Omega, and A = -B with A^2 = 4 gamma - 2 Omega, where epsilon = 0."""
    size = np.sqrt(16.0 if sign > 0 else 20.0)
    alone = find_state(problem(COUPLED, (size, sign * size)).changed(epsilon=0.0))
    case = problem(COUPLED, (size, sign * size))
    np.testing.assert_allclose(alone.components(case)[:, 0, 10], (size, sign * size), rtol=1e-12)
    state = find_state(case)
    components = state.components(case)
    np.testing.assert_array_equal(components[:, 1], 0.0)
    np.testing.assert_allclose(components[1], sign * components[0], rtol=0, atol=1e-12)
    fields = components[:, 0] + 1j * components[:, 1]
    later = simulate(case.changed(initial=fields)).final
    np.testing.assert_allclose(later, fields, rtol=0, atol=1e-9)
    longer = case.changed(half_width=20)
    recomputed = newton(longer, widened(longer, state), None)
    np.testing.assert_allclose(
        recomputed.components(longer)[:, :, 10:31], components, rtol=0, atol=1e-8
    )


@pytest.mark.parametrize("turned", [1.0, np.exp(0.3j)])
def test_exponents_are_those_of_the_whole_matrix(turned):
    """A = B turned by a phase has the same, by one matrix in place of squares of its roots."""
    case = problem(COUPLED, (4.0, 4.0))
    state = find_state(case)
    full = turned * (state.components(case)[:, 0] + 1j * state.components(case)[:, 1])
    expected = np.linalg.eigvals(linearise(case, flat(full))[1])
    computed = exponents(case, LocalisedState(flat(full, even=True), even=True))
    assert len(computed) == len(expected)
    assert max(np.abs(expected - first).min() for first in computed) < 1e-5


def test_multipliers_are_those_of_integrations_over_a_period():
    gain = Model(
        fields=("u", "v"),
        parameters={},
        i_dt=lambda p, u, v: (
            0.3 * lap(u) + v + 0.4j * u + abs2(u) * u,
            0.3 * lap(v) + u - 0.4j * v + abs2(v) * v,
        ),
    )
    case = problem(gain, [1.5, 1.5], half_width=1)
    state = find_state(case)
    computed = exponents(case, state)
    assert computed.real.max() > 0.1
    components, period = state.components(case), 2.0 * np.pi / abs(state.frequency)
    long = case.changed(end_time=period, output_step=period)
    changes = 1e-5 * np.concatenate([np.eye(6), 1j * np.eye(6)]).reshape(12, 2, 3)
    phi = components[:, 0] + 1j * components[:, 1]
    pairs = [
        [simulate(long.changed(initial=phi + s * first)).final for s in (1, -1)]
        for first in changes
    ]
    difference = [(first - second).ravel() / 2e-5 for first, second in pairs]
    measured = np.linalg.eigvals([np.concatenate([first.real, first.imag]) for first in difference])
    expected = np.exp(period * computed)
    for first in expected[np.abs(expected - 1.0) > 1e-2]:  # the phase has a double one
        assert np.abs(measured - first).min() < 1e-4 * max(1.0, abs(first))


@pytest.mark.parametrize(
    ("model", "data", "reason"),
    [
        (CUBIC, [0], "the chain is at rest"),
        (
            Model(fields="x", parameters={}, d2_dt2=lambda p, x: lap(x) - np.cos(p.t) * x),
            [1],
            "depend on time",
        ),
        (
            Model(fields="u", parameters={}, i_dt=lambda p, u: lap(u) + 0.1),
            [1],
            "rest does not solve the equations",
        ),
        (
            Model(fields="u", parameters={}, i_dt=lambda p, u: abs2(u) * u - 0.1j * u),
            [1],
            "its power would decay at the rate 0.2",
        ),
        (
            Model(fields="u", parameters={}, i_dt=lambda p, u: abs2(u) * u + 0.1j * u),
            [1],
            "its power would grow at the rate 0.2",
        ),
        (
            Model(fields="x", parameters={}, d2_dt2=lambda p, x: 0.2 * lap(x) - np.sin(x)),
            [6.2],
            "continuation fails at 0.6",
        ),
        (
            Model(fields="x", parameters={}, d2_dt2=lambda p, x: lap(x) - 1 * x),
            [1],
            "no such state",
        ),
    ],
)
def test_where_there_is_no_state_the_reason_is_told(model, data, reason):
    with pytest.raises(NoStateError, match=reason):
        find_state(problem(model, data))


def test_a_chain_too_long_for_its_matrix_is_told_how_long_it_may_be():
    assert find_state(problem(CUBIC, 1.5, half_width=200)).even
    with pytest.raises(NoStateError, match="601 sites; give at most 500"):
        find_state(problem(CUBIC, 1, half_width=300, site=1))
