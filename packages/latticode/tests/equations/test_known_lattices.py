"""Lattices of the literature, written as a user would, against SciPy on NumPy written by hand.

Each row has what the model is made of, its ends, its initial data, and the same equations for
arrays: of a complex field i du/dt, of a real one its second derivative. Where `r` and `s` stand,
they are the right and the left neighbours. Toda and Lennard-Jones stand in test_traced_functions.
"""

import numpy as np
import pytest
from latticode import Case, Model, abs2, cos, lap, simulate, sin, sqrt
from scipy.integrate import solve_ivp
from test_traced_models import TIGHT, neighbours

M, END = 4, 4.0
DRAWN = np.random.default_rng(3).uniform(-1, 1, 2 * M + 1)


def zigzag(p, u, v):
    return (
        lap(u) + p.k * (v + v.left) + abs2(u) * u - 1j * p.g * u,
        lap(v) + p.k * (u + u.right) + abs2(v) * v + 1j * p.g * v,
    )


def plain_zigzag(t, u, v, r, s):
    return (
        r[0] + s[0] - 2 * u + 0.5 * (v + s[1]) + abs(u) ** 2 * u - 0.1j * u,
        r[1] + s[1] - 2 * v + 0.5 * (u + r[0]) + abs(v) ** 2 * v + 0.1j * v,
    )


FIRST = {
    "Ablowitz-Ladik, damped": (
        "u",
        {"g": 0.1},
        "periodic",
        {0: [1], 1: [0.3j]},
        lambda p, u: -(1 + abs2(u)) * (u.right + u.left) - 1j * p.g * u,
        lambda t, u, r, s: -(1 + abs(u) ** 2) * (r[0] + s[0]) - 0.1j * u,
    ),
    "saturable": (
        "u",
        {"b": 2.0},
        "free",
        {0: [1.5], 1: [0.3j]},
        lambda p, u: lap(u) - p.b * u / (1 + abs2(u)),
        lambda t, u, r, s: r[0] + s[0] - 2 * u - 2 * u / (1 + abs(u) ** 2),
    ),
    "Ginzburg-Landau with a root": (
        "u",
        {"m": 0.5, "b": 0.7},
        "periodic",
        {0: [0.7], -2: [0.2 - 0.1j]},
        lambda p, u: (1 + 0.2j) * lap(u) + 1j * p.m * u + (1 - 1j * p.b) * sqrt(1 + abs2(u)) * u,
        lambda t, u, r, s: (
            (1 + 0.2j) * (r[0] + s[0] - 2 * u)
            + 0.5j * u
            + (1 - 0.7j) * np.sqrt(1 + abs(u) ** 2) * u
        ),
    ),
    "a zigzag ladder with gain and loss": (
        ("u", "v"),
        {"k": 0.5, "g": 0.1},
        "dirichlet",
        {0: [1.2, 0.1j], 1: [0.2, 0.3]},
        zigzag,
        plain_zigzag,
    ),
}
SECOND = {
    "sine-Gordon, damped and driven": (
        {"a": 0.2, "f": 0.4, "w": 0.9},
        "free",
        {0: [2 + 1j]},
        lambda p, x, v: lap(x) - sin(x) - p.a * v + p.f * cos(p.w * p.t),
        lambda t, x, v, r, s: r + s - 2 * x - np.sin(x) - 0.2 * v + 0.4 * np.cos(0.9 * t),
    ),
    "rotors, damped, with a torque at each site": (
        {"g": 0.05, "torque": DRAWN},
        "free",
        {0: [1 + 2j], 1: [-1]},
        lambda p, x, v: sin(x.right - x) + sin(x.left - x) - p.g * v + p.torque,
        lambda t, x, v, r, s: np.sin(r - x) + np.sin(s - x) - 0.05 * v + DRAWN,
    ),
    "compressed spheres": (
        {"d": 0.5},
        "periodic",
        {0: [0.1 + 0.1j]},
        lambda p, x: (p.d + x.left - x) ** 1.5 - (p.d + x - x.right) ** 1.5,
        lambda t, x, v, r, s: (0.5 + s - x) ** 1.5 - (0.5 + x - r) ** 1.5,
    ),
}


def start_of(initial, fields):
    start = np.zeros((fields, 2 * M + 1), complex)
    for site, values in initial.items():
        start[:, M + site] = values
    return start


def agrees(model, boundary, initial, slope, start):
    """Compare a run with SciPy, whose state has the shape of `start`: two parts of each field."""
    case = Case(model=model, half_width=M, boundary=boundary, initial=initial, end_time=END)
    final = simulate(case)["final"].values
    solved = (
        solve_ivp(
            lambda t, y: np.ravel(slope(t, y.reshape(start.shape))),
            (0, END),
            start.ravel(),
            **TIGHT,
        )
        .y[:, -1]
        .reshape(start.shape)
    )
    expected = np.stack([solved.real, solved.imag]) if np.iscomplexobj(solved) else solved
    np.testing.assert_allclose(final, expected.reshape(final.shape), rtol=0, atol=1e-11)


@pytest.mark.parametrize("name", FIRST)
def test_lattices_of_complex_fields(name):
    fields, parameters, boundary, initial, traced, rates = FIRST[name]
    model = Model(fields=fields, parameters=parameters, i_dt=traced)

    def slope(t, u):
        r, s = ([neighbours(field, by, boundary) for field in u] for by in (1, -1))
        return -1j * np.asarray(rates(t, *u, r, s)).reshape(u.shape)

    agrees(model, boundary, initial, slope, start_of(initial, len(model.fields)))


@pytest.mark.parametrize("name", SECOND)
def test_lattices_of_oscillators(name):
    parameters, boundary, initial, traced, forces = SECOND[name]
    model = Model(fields="x", parameters=parameters, d2_dt2=traced)

    def slope(t, y):
        x, v = y
        return np.stack([v, forces(t, x, v, *(neighbours(x, by, boundary) for by in (1, -1)))])

    start = start_of(initial, 1)[0]
    agrees(model, boundary, initial, slope, np.stack([start.real, start.imag]))
