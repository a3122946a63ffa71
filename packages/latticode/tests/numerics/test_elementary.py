"""Elementary functions against balls of 300 bits, and the hashes of their bits."""

import hashlib
from fractions import Fraction
from math import nextafter, ulp

import numpy as np
import pytest
from flint import arb, ctx
from latticode.kernels.compiled import kernel
from latticode.numerics import elementary as e

SAMPLES = 1500

wide = np.random.default_rng(5).uniform(-700.0, 700.0, SAMPLES)
near = np.random.default_rng(6).uniform(-3.0, 3.0, SAMPLES)
tiny = np.ldexp(near, -np.random.default_rng(7).integers(0, 60, SAMPLES))
all_arguments = np.concatenate([wide, near, tiny])
positive = np.concatenate([np.ldexp(1.0 + np.abs(tiny), wide.astype(int)), 1.0 + 0.3 * tiny])
angles = np.concatenate([2000.0 * wide, 4.0 * near, tiny, np.arange(1, 400) * (np.pi / 4)])
exponents = np.resize([0.25, -0.1, 1 / 3, 3.0, -2.5], positive.size)


EXACT = {
    "exp": (all_arguments, arb.exp, 1.0),
    "expm1": (all_arguments, arb.expm1, 1.5),
    "sinh": (all_arguments, arb.sinh, 2.0),
    "cosh": (all_arguments, arb.cosh, 1.5),
    "log": (positive, arb.log, 1.0),
    "sin": (angles, arb.sin, 1.0),
    "cos": (angles, arb.cos, 1.0),
}
"""Of each function: its arguments, the exact values, and the error in ulp that it states."""


def ulps(computed, exact):
    """Return the largest error in units in the last place of the exact values."""
    return max(
        float(abs(arb(float(first)) - second)) / ulp(float(second))
        for first, second in zip(computed, exact, strict=True)
    )


@pytest.fixture(autouse=True)
def precision():
    with ctx.workprec(300):
        yield


@pytest.mark.parametrize("name", EXACT)
def test_functions_err_by_less_than_they_state(name):
    arguments, exact, allowed = EXACT[name]
    arguments = arguments[::2]
    off = ulps(getattr(e, name)(arguments), [exact(arb(float(x))) for x in arguments])
    assert off < allowed


def test_powers_err_by_less_than_they_state():
    x, y = positive[::7], exponents[::7]
    exact = [arb(float(a)) ** arb(float(b)) for a, b in zip(x, y, strict=True)]
    normal = np.array([1e-300 < float(first) < 1e300 for first in exact])
    assert ulps(e.power(x[normal], y[normal]), np.array(exact)[normal]) < 1.0


@pytest.mark.parametrize("root", [e.fifth_root, kernel(e.fifth_root)])
def test_fifth_roots_err_by_less_than_one_ulp(root):
    """A result errs by less where the doubles before and after it lie on either side of the root,
    which their fifth powers tell exactly."""
    for x in map(
        float, np.concatenate([positive[::4], np.linspace(0.9, 33.0, 500), [5e-324, 1.7e308]])
    ):
        computed = root(x)
        below, above = (Fraction(nextafter(computed, end)) ** 5 for end in (0.0, np.inf))
        assert below < x < above
    assert [root(x) for x in (0.0, 1.0, 32.0, np.inf)] == [0.0, 1.0, 2.0, np.inf]
    assert np.isnan(root(np.nan))


def test_a_geometric_series_has_the_doubles_next_to_the_exact_ones():
    assert e.geometric(1e-5, 1e5, 11).tolist() == [float(f"1e{n}") for n in range(-5, 6)]
    computed = e.geometric(1.0, 400.0, 90)
    assert ulps(computed, [arb(400) ** (arb(i) / 89) for i in range(90)]) <= 0.5


def test_limits_are_values_and_no_warnings():
    ends = np.array([-np.inf, -1e9, 0.0, 1e9, np.inf, np.nan])
    with np.errstate(all="raise", under="ignore"):
        assert str(e.exp(ends).tolist()) == "[0.0, 0.0, 1.0, inf, inf, nan]"
        assert str(e.log(ends[[0, 1, 2, 4, 5]]).tolist()) == "[nan, nan, -inf, inf, nan]"
        for x in (1e7, 1.6e6, -1.6e6):
            assert str(e.sine_and_cosine(x)) == "(np.float64(nan), np.float64(nan))"
        assert e.expm1(0.0) == e.sinh(0.0) == e.sin(0.0) == 0.0 and e.cosh(0.0) == 1.0


def test_complex_numbers():
    a, b = tiny[:750] + 1j * near[:750], near[:750] + 1j * tiny[750:]
    assert np.allclose(e.product(a, b), a * b, rtol=1e-15, atol=1e-15)
    assert np.allclose(e.modulus(a), abs(a), rtol=1e-15, atol=0.0)
    far = 10.0 ** np.arange(-300, 308, 4.0) * (3.0 + 4.0j)
    assert np.allclose(e.modulus(far), abs(far), rtol=3e-16, atol=0.0)
    assert np.allclose(e.turn(near), np.exp(1j * near), rtol=0.0, atol=1e-15)
    assert np.allclose(e.quotient(b, a), b / a, rtol=2e-15, atol=0.0)
    numbers = near[:750] + 1j * near[750:]
    assert np.allclose(e.square_root(numbers), np.sqrt(numbers), rtol=1e-15, atol=1e-15)
    assert e.square_root(-4.0) == 2j and e.square_root(0.0) == 0.0
    assert e.product(2.0, 3.0 - 1j) == 6.0 - 2j and isinstance(e.modulus(3.0 + 4j), float)


def values():
    """Return what each function gives on many arguments."""
    computed = {name: getattr(e, name)(arguments) for name, (arguments, _, _) in EXACT.items()}
    computed["power"] = e.power(positive, exponents)
    computed["fifth_root"] = np.array([e.fifth_root(float(x)) for x in positive])
    computed["product"] = e.product(e.turn(near), e.turn(wide)).view(float)
    return computed


HASHES = {
    "exp": "e79eeb1aa42730b4",
    "expm1": "3ea296fb91f28d19",
    "sinh": "1b43ac27aa4209fe",
    "cosh": "4e036972471ce742",
    "log": "07e01cd5bff5cb24",
    "sin": "b564a52f58aeb0f9",
    "cos": "ebebc60920021168",
    "power": "763dc6fbd6dadfde",
    "fifth_root": "5eea0251d3ae4a30",
    "product": "a1fb1b1c7018e5d9",
}
"""Bits that every machine must get, of functions of random but fixed arguments."""


def test_bits_are_those_of_every_machine():
    computed = {
        name: hashlib.sha256(first.tobytes()).hexdigest()[:16] for name, first in values().items()
    }
    assert computed == HASHES


def test_a_number_gives_the_bits_of_an_array_and_a_kernel_those_of_python():
    sines = kernel(e.sine_less_angle), kernel(e.cosine_near_zero)
    for x in 0.3 * near[:200]:
        assert e.exp(x) == e.exp(np.array([x]))[0] and e.log(x * x) == e.log(np.array([x * x]))[0]
        assert e.sine_less_angle(x) == sines[0](x) and e.cosine_near_zero(x) == sines[1](x)
