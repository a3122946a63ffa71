"""Traced models against plain NumPy and SciPy: random polynomials, sines, drives, disorder."""

from functools import reduce

import numpy as np
import pytest
from latticode.equations.model import Model, abs2, conj, lap, shift
from latticode.simulation.lattice import FULL_CHAIN
from latticode.simulation.problem import Problem
from latticode.simulation.simulate import simulate
from scipy.integrate import solve_ivp

TIGHT = {"method": "DOP853", "rtol": 1e-13, "atol": 1e-13}


def problem(model, initial, boundary, solver="taylor", end_time=1.0, **parameters):
    """Return the problem of a traced model on as many sites as `initial` (field, site) has."""
    return Problem(
        half_width=initial.shape[1] // 2,
        boundary=boundary,
        initial=initial,
        end_time=end_time,
        output_step=0.25,
        model=model,
        parameters=parameters,
        solver={"name": solver, "rtol": 1e-13, "atol": 1e-13, "step": 0.01},
        snapshot_every=1,
    )


def neighbours(values, by, boundary):
    """Return the values (site,) at the sites n + by."""
    mode = {"dirichlet": "constant", "free": "symmetric", "periodic": "wrap"}[boundary]
    return np.pad(values, 7, mode)[7 + by : 7 + by + values.size]


def polynomial(seed, fields, reach):
    """Return random terms of each field's rate: a coefficient, a parameter, and its factors."""
    rng = np.random.default_rng(seed)

    def factor():
        return rng.integers(fields), rng.random() < 0.5, rng.integers(-reach, reach + 1)

    def term():
        number = complex(*rng.uniform(-0.7, 0.7, 2)) if rng.random() < 0.7 else 1.0
        return number, rng.choice(["a", "b"]), [factor() for _ in range(rng.integers(1, 4))]

    return [[term() for _ in range(4)] for _ in range(fields)]


def traced(terms):
    """Return the model of random terms."""

    def i_dt(p, *fields):
        def product(number, parameter, factors):
            values = [
                shift(conj(fields[f]) if conjugated else fields[f], int(by))
                for f, conjugated, by in factors
            ]
            return reduce(lambda a, b: a * b, values, number * getattr(p, str(parameter)))

        return [sum(product(*term) for term in row) for row in terms]

    names = tuple(f"u{i}" for i in range(len(terms)))
    return Model(fields=names, parameters={"a": 0.7, "b": -0.4}, i_dt=i_dt)


def rate(terms, boundary, parameters):
    """Return du/dt of random terms, in plain NumPy, of a flat state."""

    def slope(_, flat):
        fields = flat.reshape(len(terms), -1)
        rows = []
        for row in terms:
            total = 0
            for number, parameter, factors in row:
                product = number * parameters[parameter]
                for f, conjugated, by in factors:
                    values = neighbours(fields[f], by, boundary)
                    product = product * (values.conj() if conjugated else values)
                total = total + product
            rows.append(-1j * total)
        return np.ravel(rows)

    return slope


RANDOM = [(1, 1, 1, "free", 10), (2, 2, 2, "dirichlet", 11), (3, 3, 1, "periodic", 2)]
"""Random models: seed, fields, reach, ends, half-width."""


def random_problem(seed, fields, reach, boundary, half_width):
    """Return the problem of a random model with disorder in the parameter b, and its terms."""
    terms, sites = polynomial(seed, fields, reach), 2 * half_width + 1
    initial = 0.2 * np.random.default_rng(seed).normal(size=(fields, sites, 2)) @ (1.0, 1j)
    return problem(traced(terms), initial, boundary, b=np.linspace(0.2, 1.0, sites)), terms


@pytest.mark.parametrize("numbers", RANDOM)
def test_random_polynomials_equal_scipy_on_numpy(numbers):
    chain, terms = random_problem(*numbers)
    slope = rate(terms, chain.boundary, {"a": 0.7, **chain.parameters})
    expected = solve_ivp(slope, (0.0, 1.0), chain.initial.ravel(), **TIGHT).y[:, -1]
    final = simulate(chain).final.ravel()
    np.testing.assert_allclose(final, expected, rtol=0, atol=1e-9)


@pytest.mark.parametrize("boundary", ["dirichlet", "free", "periodic"])
def test_half_of_an_even_chain_has_the_bits_of_the_whole(boundary):
    """Equations that look two sites far, on chains whose half ends inside a block."""

    def i_dt(p, u):
        return p.a * (shift(u, 2) + shift(u, -2)) + (abs2(u.right) + abs2(u.left)) * u

    model = Model(fields="u", parameters={"a": 0.7}, i_dt=i_dt)
    assert model.even and not Model(fields="u", parameters={}, i_dt=lambda p, u: u.right).even
    half = np.random.default_rng(3).normal(size=(1, 10, 2)) @ (0.5, 0.5j)
    even_chain = problem(model, np.concatenate([half[:, :0:-1], half], axis=1), boundary)
    runs = [simulate(even_chain, cut) for cut in (None, FULL_CHAIN)]
    assert runs[0].final[0, 0] == runs[0].final[0, -1]
    for name in ("final", "l2", "linf", "state"):
        np.testing.assert_array_equal(*(getattr(run, name) for run in runs))


def pendulum(p, x):
    """A driven chain with a sine of each angle and of each bond, linear bonds, and a force."""
    bond = p.bond * np.sin(x.right - x)
    wave = np.cos(p.frequency * p.t + 0.3)
    drive = p.strength * (wave * np.sin(p.t)) * x + wave * x
    return (bond - bond.left) + 0.2 * lap(x) - np.sin(x) + drive + 0.1 * p.t - p.force


@pytest.mark.parametrize("solver", ["taylor", "dop853", "kahan_li"])
def test_sines_drives_and_functions_of_time_equal_scipy(solver):
    numbers = {"bond": 0.5, "strength": 0.4, "frequency": 2.2, "force": 0.05}
    model = Model(fields="x", parameters=numbers, d2_dt2=pendulum)
    initial = np.random.default_rng(4).normal(size=(1, 13, 2)) @ (1.0, 1j)

    def slope(t, flat):
        x, v = flat.reshape(2, -1)
        after, before = neighbours(x, 1, "free") - x, x - neighbours(x, -1, "free")
        bonds = 0.5 * (np.sin(after) - np.sin(before)) + 0.2 * (after - before)
        drive = (1.0 + 0.4 * np.sin(t)) * np.cos(2.2 * t + 0.3)
        return np.ravel([v, bonds - np.sin(x) + drive * x + 0.1 * t - 0.05])

    start = np.ravel([initial[0].real, initial[0].imag])
    expected = solve_ivp(slope, (0.0, 2.0), start, **TIGHT).y[:, -1]
    final = simulate(problem(model, initial, "free", solver, end_time=2.0)).final[:, 0]
    error = 1e-9 if solver != "kahan_li" else 1e-8
    np.testing.assert_allclose(final.ravel(), expected, rtol=0, atol=error)


def test_the_bound_of_rates_derives_the_equations_once(monkeypatch):
    """A survey asks for it before each of its runs, which may be shorter than a derivation."""
    chain = Model(fields="u", parameters={"c": 1.0}, i_dt=lambda p, u: p.c * lap(u) + abs2(u) * u)
    first = chain.rates_at({"c": 2.0}, 0.5)
    monkeypatch.setattr("latticode.equations.model.derivative", None)
    assert chain.rates_at({"c": 2.0}, 0.5) == first < chain.rates_at({"c": 3.0}, 0.5)
