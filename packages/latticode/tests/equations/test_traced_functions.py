"""Functions of fields, of velocities and of the time in traced models, against SciPy on NumPy."""

import numpy as np
import pytest
from latticode.equations.model import Model, ModelError, abs2, conj, cos, exp, lap, log, sin, sqrt
from latticode.integrators.methods import methods_taking
from latticode.simulation.simulate import IntegrationError, simulate
from scipy.integrate import quad, solve_ivp
from test_traced_models import TIGHT, neighbours, problem

SITES = 13
PLACES = np.linspace(0.3, 1.4, SITES)
FIRST = {
    "saturation, quotients, real powers, exponential and logarithm": (
        lambda p, u: (
            lap(u) / (4.0 + conj(u))
            + abs2(u) / (1 + abs2(u)) * u
            + (0.1 + abs2(u)) ** 0.7 * u
            - (abs2(u) + 1.5) ** -2 * u
            + exp(-abs2(u)) * u
            + log(abs2(u) + 2) * u
        ),
        lambda t, u, r, s: (
            (r + s - 2 * u) / (4 + u.conj())
            + abs(u) ** 2 / (1 + abs(u) ** 2) * u
            + (0.1 + abs(u) ** 2) ** 0.7 * u
            - (abs(u) ** 2 + 1.5) ** -2 * u
            + np.exp(-(abs(u) ** 2)) * u
            + np.log(abs(u) ** 2 + 2) * u
        ),
    ),
    "a Peierls phase, phases by site, a chirp and a decay": (
        lambda p, u: (
            exp(1j * p.a) * u.right
            + exp(-1j * p.a) * u.left
            + sin(2.0 * p.t + p.b) * u
            + sin(p.t * p.t) * u
            + exp(-p.t) * u
        ),
        lambda t, u, r, s: (
            np.exp(0.7j) * r
            + np.exp(-0.7j) * s
            + (np.sin(2 * t + PLACES) + np.sin(t * t) + np.exp(-t)) * u
        ),
    ),
}
SECOND = {
    "Toda and Lennard-Jones": (
        lambda p, x: (
            exp(x.left - x) - exp(x - x.right) + (3 + x - x.left) ** -7 - (3 + x.right - x) ** -7
        ),
        lambda t, x, v, r, s, vr, vs: (
            np.exp(s - x) - np.exp(x - r) + (3 + x - s) ** -7 - (3 + r - x) ** -7
        ),
    ),
    "forces of parameters and of clocks alone, and a quotient of them": (
        lambda p, x, v: (
            0.5 * p.k - 0.3 * cos(p.k) - sqrt(2 + cos(p.k * p.t)) + lap(x) - v - p.k / (2 + x * x)
        ),
        lambda t, x, v, r, s, vr, vs: (
            0.35
            - 0.3 * np.cos(0.7)
            - np.sqrt(2 + np.cos(0.7 * t))
            + (r + s - 2 * x)
            - v
            - 0.7 / (2 + x * x)
        ),
    ),
    "relativistic, damped, with friction between neighbours, and driven": (
        lambda p, x, v: (
            (1 - 0.05 * v * v) * sqrt(1 - 0.05 * v * v) * (lap(x) - x)
            - 0.2 * v
            + 0.1 * lap(v)
            + 0.3 * np.cos(1.3 * p.t)
        ),
        lambda t, x, v, r, s, vr, vs: (
            (1 - 0.05 * v**2) ** 1.5 * (r + s - 3 * x)
            - 0.2 * v
            + 0.1 * (vr + vs - 2 * v)
            + 0.3 * np.cos(1.3 * t)
        ),
    ),
}


def sides(values, boundary):
    return [neighbours(values, by, boundary) for by in (1, -1)]


@pytest.mark.parametrize("boundary", ["dirichlet", "periodic"])
@pytest.mark.parametrize("name", FIRST)
def test_functions_of_complex_fields_equal_scipy(name, boundary):
    traced, of_numpy = FIRST[name]
    model = Model(fields="u", parameters={"a": 0.7, "b": PLACES}, i_dt=traced)
    initial = np.random.default_rng(5).normal(size=(1, SITES, 2)) @ (0.7, 0.7j)
    expected = solve_ivp(
        lambda t, u: -1j * of_numpy(t, u, *sides(u, boundary)), (0.0, 1.0), initial[0], **TIGHT
    ).y[:, -1]
    for solver in ("taylor", "dop853"):
        final = simulate(problem(model, initial, boundary, solver)).final[0]
        np.testing.assert_allclose(final, expected, rtol=0, atol=1e-10)


@pytest.mark.parametrize("boundary", ["free", "periodic"])
@pytest.mark.parametrize("name", SECOND)
def test_forces_and_velocities_equal_scipy(name, boundary):
    traced, of_numpy = SECOND[name]
    model = Model(fields="x", parameters={"k": 0.7}, d2_dt2=traced)
    initial = np.random.default_rng(6).normal(size=(1, SITES, 2)) @ (0.4, 0.4j)

    def slope(t, flat):
        x, v = flat.reshape(2, -1)
        return np.ravel([v, of_numpy(t, x, v, *sides(x, boundary), *sides(v, boundary))])

    start = np.ravel([initial[0].real, initial[0].imag])
    expected = solve_ivp(slope, (0.0, 1.0), start, **TIGHT).y[:, -1].reshape(2, -1)
    solvers = [name for name in methods_taking(model) if name != "crank_nicolson"]
    assert ("kahan_li" in solvers) == name.startswith("Toda")
    for solver in set(solvers) - {"ode45"}:  # it has the rates of dop853
        final = simulate(problem(model, initial, boundary, solver)).final[:, 0]
        error = 1e-10 if solver != "kahan_li" else 1e-8
        np.testing.assert_allclose(final, expected, rtol=0, atol=error)


def test_rates_of_parameters_alone_move_fields_steadily():
    model = Model(
        fields=("u", "v"),
        parameters={"k": 0.7},
        i_dt=lambda p, u, v: (-0.5j * p.k, 0.4 * p.k * sin(p.k)),
    )
    initial = np.random.default_rng(5).normal(size=(2, SITES)) + 0j
    final = simulate(problem(model, initial, "free")).final
    rates = np.array([[-0.35], [-0.28j * np.sin(0.7)]])
    np.testing.assert_allclose(final, initial + rates, rtol=0, atol=1e-12)


def test_a_series_of_every_fourth_order_alone_limits_the_step():
    """From t = 0 the last two terms of the series vanish, and so do not show how far it holds."""
    model = Model(
        fields="u", parameters={}, i_dt=lambda p, u: 1j * exp(-sin(p.t * p.t) * sin(p.t * p.t))
    )
    final = simulate(problem(model, np.zeros((1, SITES)) + 1.0, "free")).final
    expected = 1.0 + quad(lambda t: np.exp(-(np.sin(t * t) ** 2)), 0.0, 1.0, epsabs=1e-14)[0]
    np.testing.assert_allclose(final, expected, rtol=0, atol=1e-11)


def test_a_domain_that_is_left_ends_the_run_and_gives_no_numbers():
    model = Model(fields="x", parameters={}, d2_dt2=lambda p, x: sqrt(x) - 2)
    initial = np.full((1, SITES), 0.5 + 0j)
    with pytest.raises(IntegrationError, match="no longer finite"):
        simulate(problem(model, initial, "free", end_time=4.0))


def test_a_function_with_another_number_of_values_says_which():
    with pytest.raises(
        ModelError, match=r"must take \(p, x\), or \(p, x, and a velocity of each\)"
    ):
        Model(fields="x", parameters={}, d2_dt2=lambda p: 1.0)
    with pytest.raises(ModelError, match=r"must take \(p, u\)"):
        Model(fields="u", parameters={}, i_dt=lambda p, u, v: u)


def test_phases_of_first_order_equal_scipy():
    phases = Model(
        fields="u",
        parameters={"w": PLACES},
        i_dt=lambda p, u: 1j * (p.w + sin(u.right.real - u.real) + sin(u.left.real - u.real)),
    )
    initial = np.random.default_rng(5).normal(size=(1, SITES)) + 0j

    def slope(t, u):
        right, left = sides(u, "periodic")
        return PLACES + np.sin(right - u) + np.sin(left - u)

    expected = solve_ivp(slope, (0.0, 1.0), initial[0].real, **TIGHT).y[:, -1]
    for solver in ("taylor", "dop853"):
        final = simulate(problem(phases, initial, "periodic", solver)).final[0]
        np.testing.assert_allclose(final, expected, rtol=0, atol=1e-11)
