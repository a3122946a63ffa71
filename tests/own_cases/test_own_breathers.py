"""Localised states of models of one's own: against exact ones, the paper's and integrations."""

import numpy as np
import pytest
from latticode.equations.model import abs2, lap
from latticode.simulation.simulate import simulate
from pendula import Case, Model, check, draw_breather
from pendula.models import amplitudes
from pendula.models.pairs import FAMILIES
from pendula.own_cases import answers
from pendula.own_cases.breathers import check_breather, exponents, find_state
from pendula.problem import Problem
from pendula.studies.breathers import steady

CUBIC = Model(fields="u", parameters={}, i_dt=lambda p, u: 0.3 * lap(u) + abs2(u) * u)


def problem(model, data, half_width=10, end_time=1.0):
    """Return the problem of data (field, ...) on site 0."""
    case = Case(model=model, initial={0: data}, half_width=half_width, end_time=end_time)
    return Problem.of(case.problem(output_step=end_time))


def test_a_localised_state_is_the_exact_one_of_ablowitz_and_ladik():
    """u_n = sinh(b) / cosh(b n) turns at the frequency 2 cosh(b), and is neutrally stable."""
    model = Model(fields="u", parameters={}, i_dt=lambda p, u: (u.right + u.left) * (1 + abs2(u)))
    exact = np.sinh(1.0) / np.cosh(np.arange(-15, 16))
    found = check_breather(problem(model, [float(np.sqrt(np.sum(exact**2)))], half_width=15))
    np.testing.assert_allclose(found["breather"][0], exact, rtol=0, atol=1e-5)
    np.testing.assert_allclose(found["breather_frequency"], 2.0 * np.cosh(1.0), rtol=1e-5)
    np.testing.assert_allclose(np.hypot(*found["breather_multipliers"].values), 1.0, rtol=1e-5)
    # the waves have the frequencies 2 cos(k)
    gap = 2.0 * (np.cosh(1.0) - np.cos(np.pi / 32))
    np.testing.assert_allclose(found["breather_gap"], gap, rtol=1e-5)


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
def test_steady_states_of_the_papers_equations_are_those_of_their_study(family):
    chain = steady.Chain(1.0, 1.0, -8.0, 10)
    expected = steady.continued(chain, family)
    numbers = {"epsilon": 1.0, "gamma": 1.0, "omega": -8.0}
    model = Model(fields=("A", "B"), parameters=numbers, i_dt=amplitudes.i_dt)
    unit = 1.0 if family.drive(1.0) > 0.0 else 1j
    given = problem(model, [complex(unit * one) for one in expected[:, 0]])
    state = find_state(given)
    moduli = np.hypot(*state.x.reshape(2, 2, 21).swapaxes(0, 1))
    np.testing.assert_allclose(moduli[:, 10:], np.abs(expected), rtol=0, atol=1e-7)
    growth = exponents(given, state).real.max()
    assert growth == pytest.approx(steady.fastest_growth(chain, family, expected), abs=1e-5)


def test_multipliers_are_those_of_integrations_over_a_period():
    gain = Model(
        fields=("u", "v"), parameters={},
        i_dt=lambda p, u, v: (0.3 * lap(u) + v + 0.4j * u + abs2(u) * u,
                              0.3 * lap(v) + u - 0.4j * v + abs2(v) * v),
    )  # fmt: skip
    given = problem(gain, [1.5, 1.5], half_width=1)
    found = check_breather(given)
    assert float(found["breather_growth"]) > 0.1
    state = find_state(given)
    phi = state.x.reshape(2, 2, 3)[:, 0] + 1j * state.x.reshape(2, 2, 3)[:, 1]
    period = 2.0 * np.pi / abs(state.frequency)
    long = given.changed(end_time=period, output_step=period)
    changes = 1e-5 * np.concatenate([np.eye(6), 1j * np.eye(6)]).reshape(12, 2, 3)
    pairs = [[simulate(long.changed(initial=phi + s * one)).final for s in (1, -1)]
             for one in changes]  # fmt: skip
    apart = [(one - other).ravel() / 2e-5 for one, other in pairs]
    measured = np.linalg.eigvals([np.concatenate([one.real, one.imag]) for one in apart])
    expected = found["breather_multipliers"].values.T @ (1.0, 1j)
    for one in expected[np.abs(expected - 1.0) > 1e-2]:  # the phase has a double one
        assert np.abs(measured - one).min() < 1e-4 * max(1.0, abs(one))


def forced(p, u):
    return lap(u) + 0.1


def shaken(p, x):
    return lap(x) - np.cos(p.t) * x


@pytest.mark.parametrize(
    ("model", "data", "said"),
    [
        (CUBIC, [1.5], "turns at the frequency 1."),
        (CUBIC, [0.1], "but reaches the ends of the chain"),
        (CUBIC, [0], "the chain is at rest"),
        (Model(fields="x", parameters={}, d2_dt2=shaken), [1], "depend on the time"),
        (Model(fields="u", parameters={}, i_dt=forced), [1], "rest does not solve the equations"),
        (Model(fields="u", parameters={}, i_dt=lambda p, u: abs2(u) * u - 0.1j * u), [1],
         "its power would decay, at the rate 0.2"),
        (Model(fields="x", parameters={}, d2_dt2=lambda p, x: 0.2 * lap(x) - np.sin(x)), [6.2],
         "it ends at 0.6"),
        (Model(fields="x", parameters={}, d2_dt2=lambda p, x: lap(x) - 1 * x), [1], "none near"),
    ],
)  # fmt: skip
def test_the_page_and_the_figure_say_what_is_found(model, data, said):
    found = check_breather(problem(model, data))
    assert said in answers.localised(found)
    figure = draw_breather(found.assign(divergence_time=1.0))
    assert len(figure.axes) == (2 if "breather" in found else 0)


def test_a_chain_too_long_for_its_matrix_is_told_how_long_it_may_be():
    found = check_breather(problem(CUBIC, [1], half_width=300))
    assert "601 sites; give at most 500" in found.attrs["breather_refusal"]


def test_the_checks_of_a_case_hold_its_localised_state():
    case = Case(model=CUBIC, initial={3: [1.5]}, half_width=6, end_time=1)
    found = check(case)
    assert int(found["breather"].sel(component="u").idxmax()) == 3
    assert float(found["breather_growth"]) == 0.0
