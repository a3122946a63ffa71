"""The expansion of Newton's equations (1), derived by SymPy from nothing but (1), (2) and (3).

The pendula of three sites between ends at rest are put into (1), and every power of mu and of
E = exp(i omega t) must vanish. Derivatives of amplitudes are unknowns until their order is solved.
"""

from fractions import Fraction

import numpy as np
import pytest
from helpers import package
from pendula.models import expansion
from pendula.models.amplitudes import DIRICHLET, Chain

sympy = package("sympy", "-r tests/derivation/requirements.txt")

SITES = 3
mu, E, Omega, gamma, epsilon = sympy.symbols("mu E Omega gamma epsilon", real=True)
NAMES = [f"{pendulum}{n}" for pendulum in "AB" for n in range(SITES)]
Z = dict(zip(NAMES, sympy.symbols(NAMES), strict=True))
CONJ = {name: sympy.Symbol(f"{name}_conj") for name in NAMES}
SWAPPED = {Z[name]: CONJ[name] for name in NAMES} | {CONJ[name]: Z[name] for name in NAMES}
OTHER = {"A": "B", "B": "A"}


def conj(term):
    """Return the complex conjugate of a polynomial in the amplitudes and E."""
    unknown = {s: sympy.Symbol(flipped(s.name)) for s in term.free_symbols if s.name[:2] in MADE}
    turned = {sympy.I: -sympy.I, E: 1 / E, **SWAPPED, **unknown}
    return sympy.expand(term).subs(turned, simultaneous=True)


MADE = ("d1", "d2", "P_", "g_")
"""How names of unknowns begin: A', A'', P and the terms of A' of the next order."""


def flipped(name):
    return name.removesuffix("_conj") if name.endswith("_conj") else f"{name}_conj"


def unknown(kind, name):
    return sympy.Symbol(f"{kind}{name}")


def at(table, pendulum, n):
    """Return the entry of a site, zero beyond the ends."""
    return table.get(f"{pendulum}{n}", sympy.Integer(0))


def angle(name):
    """Return x of the expansion up to mu^3, and x'' up to mu^5 E and mu^3 E^3."""
    z, third = Z[name], unknown("P_", name)
    omega = sympy.sqrt(1 + mu**2 * Omega).series(mu, 0, 4).removeO()
    first = (
        -(1 + mu**2 * Omega) * z
        + sympy.I * omega * mu**2 * unknown("d1", name)
        + mu**4 / 4 * unknown("d2", name)
    )
    x = mu * z * E + mu**3 * third * E**3
    acceleration = mu * first * E - 9 * mu**3 * third * E**3
    return x + conj(x), acceleration + conj(acceleration)


def residual(name):
    """Return what (1) misses at a site, where D = gamma mu^2 (E^2 + E^-2)."""
    pendulum, n = name[0], int(name[1:])
    x = {other: angle(other)[0] for other in NAMES}
    here, partner = x[name], at(x, OTHER[pendulum], n)
    sine = here - here**3 / 6 + here**5 / 120
    bonds = at(x, pendulum, n + 1) - 2 * here + at(x, pendulum, n - 1)
    drive = gamma * mu**2 * (E**2 + E**-2) * (partner - here)
    return sympy.expand(angle(name)[1] + sine - epsilon * mu**2 * bonds - drive)


def part(term, power_of_mu, harmonic):
    return sympy.expand(term.coeff(mu, power_of_mu)).coeff(E, harmonic)


def along(slopes, term):
    """Return the derivative in tau of a polynomial in the amplitudes, whose slopes are given."""
    return sum(
        sympy.diff(term, Z[name]) * slopes[name] + sympy.diff(term, CONJ[name]) * conj(slopes[name])
        for name in NAMES
    )


@pytest.fixture(scope="module")
def solved():
    """Return by site the residual, P, dA/dtau and F, and G where it is asked for."""
    missed = {name: residual(name) for name in NAMES}
    third, slope, field = {}, {}, {}
    for name in NAMES:
        p, d1 = unknown("P_", name), unknown("d1", name)
        (third[name],) = sympy.solve(part(missed[name], 3, 3), p)
        (slope[name],) = sympy.solve(part(missed[name], 3, 1), d1)
        field[name] = sympy.expand(sympy.I * slope[name])
    known = {unknown("P_", name): third[name] for name in NAMES}
    known |= {unknown("P_", name + "_conj"): conj(third[name]) for name in NAMES}
    more = {name: next_order(missed, known, slope, name) for name in SOLVED}
    return missed, known, slope, field, more


SOLVED = ("A1", "B0")
"""A pendulum with two neighbours, and one at an end of the other row."""


def next_order(missed, known, slope, name):
    """Return G: dA/dtau = slope - i mu^2 G must make the terms of mu^5 E vanish."""
    more = unknown("g_", name)
    corrected = slope[name] - sympy.I * mu**2 * more
    leading = {unknown("d1", name): corrected, unknown("d2", name): along(slope, slope[name])}
    left = sympy.expand(missed[name].subs(leading))
    assert part(left, 3, 1) == 0
    (found,) = sympy.solve(part(left, 5, 1).subs(known), more)
    return sympy.expand(found)


def numbers():
    """Return exact amplitudes and constants, as SymPy's and as Python's numbers."""
    rng = np.random.default_rng(3)
    drawn = {name: [Fraction(int(i), 64) for i in rng.integers(-99, 99, 2)] for name in NAMES}
    exact = {
        name: sympy.Rational(re) + sympy.I * sympy.Rational(im) for name, (re, im) in drawn.items()
    }
    constants = {epsilon: Fraction(7, 10), gamma: Fraction(13, 10), Omega: Fraction(-21, 10)}
    values = {Z[name]: exact[name] for name in NAMES}
    values |= {CONJ[name]: sympy.conjugate(exact[name]) for name in NAMES}
    values |= {key: sympy.Rational(value) for key, value in constants.items()}
    plain = np.array([complex(exact[name]) for name in NAMES]).reshape(2, SITES)
    return values, plain, [float(value) for value in constants.values()]


def test_the_third_harmonic_is_that_of_the_sine_and_the_drive(solved):
    found = solved[1][unknown("P_", "A1")]
    expected = -(Z["A1"] ** 3 / 6 + gamma * (Z["B1"] - Z["A1"])) / 8
    assert sympy.expand(found - expected) == 0


@pytest.mark.parametrize("name", SOLVED)
def test_the_next_order_is_g_as_the_library_states_it(solved, name):
    _, known, slope, field, more = solved
    third, partner = (known[unknown("P_", one)] for one in (name, OTHER[name[0]] + name[1:]))
    z, bar = Z[name], CONJ[name]
    expected = (
        -Omega * field[name] / 2
        - along(slope, slope[name]) / 4
        + bar**2 * third / 2
        - z**3 * bar**2 / 12
        + gamma * (partner - third)
    )
    assert sympy.expand(more[name] - expected) == 0


def test_the_kernel_moves_the_amplitudes_by_f_and_g(solved):
    values, z, (coupling, drive, detuning) = numbers()
    squared_mu = 0.01
    y = np.zeros((4, SITES + 2))
    y[0::2, 1:-1], y[1::2, 1:-1] = z.real, z.imag
    chain = Chain(coupling, drive, detuning, DIRICHLET, DIRICHLET)
    room = np.zeros((2, *y.shape))
    found = np.zeros_like(y)
    expansion.rates(expansion.Expansion(chain, squared_mu, *room), y, found)
    for name, g in solved[4].items():
        slope = solved[2][name] - sympy.I * sympy.Rational(1, 100) * g
        row, column = 2 * "AB".index(name[0]), 1 + int(name[1:])
        moved = complex(found[row, column], found[row + 1, column])
        assert moved == pytest.approx(complex(slope.subs(values)), rel=1e-13)


def test_the_corrected_start_has_the_angles_and_velocities_of_the_data(solved):
    """x and dx/dt at t = 0, up to mu^3, for A = a + mu^2 d with the d of the library."""
    _, known, slope, _, _ = solved
    values, z, (coupling, drive, detuning) = numbers()
    y = np.zeros((4, SITES + 2))
    y[0::2, 1:-1], y[1::2, 1:-1] = z.real, z.imag
    chain = Chain(coupling, drive, detuning, DIRICHLET, DIRICHLET)
    moved = expansion.corrected_start(chain, 1.0, y) - y
    for i, name in enumerate(NAMES):
        third = complex(known[unknown("P_", name)].subs(values))
        rate = complex(slope[name].subs(values))
        d = complex(*moved[2 * (i // SITES) : 2 * (i // SITES) + 2, 1 + i % SITES])
        angle, velocity = d + third, 1j * d + 0.5 * rate + 3j * third  # halves of those of mu^3
        assert (angle.real, velocity.real) == pytest.approx((0.0, 0.0), abs=1e-14)
