"""Curves of Mathieu's equation and rates of growth, against SciPy and against 40 digits."""

from decimal import Decimal, localcontext

import numpy as np
import pytest
from pendula.studies.pendula import mathieu
from pendula.studies.pendula.mathieu import (
    band_threshold,
    first_tongue,
    growth,
    second_tongue,
    wave_threshold,
)
from scipy.special import mathieu_a, mathieu_b

PI = Decimal("3.1415926535897932384626433832795028841971")
TERMS, PIECES = 60, 4
OFFSETS = np.array([-0.9, -0.5, -0.1, -1e-3, 1e-3, 0.1, 0.5, 1.0, 1.4])


def cosine(x: Decimal) -> Decimal:
    """Return the cosine by its series."""
    total = term = Decimal(1)
    for n in range(1, TERMS):
        term *= -x * x / ((2 * n - 1) * (2 * n))
        total += term
    return total


def trace(offset: float, q: float) -> Decimal:
    """Return the trace of the monodromy of z'' + (1 + offset - 2 q cos 2 theta) z = 0 over pi.

    Power series over pieces of the period, in 40 digits. The equation is unstable where the trace
    is above 2 or below -2.
    """
    with localcontext() as context:
        context.prec = 40
        a, q = 1 + Decimal(offset), Decimal(q)
        h, pair = PI / PIECES, [[Decimal(1), Decimal(0)], [Decimal(0), Decimal(1)]]
        for piece in range(PIECES):
            angle = 2 * PI * piece / PIECES
            drive = [
                cosine(angle),
                -2 * cosine(angle - PI / 2),
            ]  # powers of theta
            for n in range(2, TERMS):
                drive.append(-4 * drive[n - 2] / (n * (n - 1)))
            pair = [continued(z, a, q, drive, h) for z in pair]
        return pair[0][0] + pair[1][1]


def continued(start, a, q, drive, h):
    z = list(start)
    for n in range(TERMS - 2):
        mixed = sum(drive[j] * z[n - j] for j in range(n + 1))
        z.append((2 * q * mixed - a * z[n]) / ((n + 1) * (n + 2)))
    value = sum(c * h**k for k, c in enumerate(z))
    return [value, sum(k * c * h ** (k - 1) for k, c in enumerate(z) if k)]


@pytest.mark.parametrize("offset", OFFSETS)
def test_the_first_tongue_has_thirteen_digits(offset):
    """By the place where the trace is -2; its slope in q comes from two values of q."""
    q = float(first_tongue(offset))
    step = 1e-6 * q
    here, beside = trace(offset, q), trace(offset, q + step)
    off = (here + 2) / ((beside - here) / Decimal(step))
    assert abs(off) < 1e-13 * q


@pytest.mark.parametrize("offset", [-0.9, 0.5, 2.0, 2.9])
def test_the_second_tongue_has_thirteen_digits(offset):
    q = float(second_tongue(offset))
    step = 1e-6 * q
    here, beside = trace(offset, q), trace(offset, q + step)
    off = (here - 2) / ((beside - here) / Decimal(step))
    assert abs(off) < 1e-13 * q


def test_curves_are_those_of_scipy():
    above, below = OFFSETS[OFFSETS > 0], OFFSETS[OFFSETS < 0]
    assert mathieu_a(1, first_tongue(above)) - 1 == pytest.approx(above, rel=1e-12)
    assert mathieu_b(1, first_tongue(below)) - 1 == pytest.approx(below, rel=1e-12)
    assert mathieu_b(2, second_tongue(OFFSETS)) - 1 == pytest.approx(OFFSETS, rel=1e-11)


def test_what_the_first_tongue_does_not_reach_is_infinite():
    highest = mathieu_a(1, np.linspace(0.0, mathieu.BEYOND, 4001)).max() - 1.0
    assert np.isfinite(first_tongue(highest - 1e-3))
    assert first_tongue(highest + 1e-3) == np.inf
    assert wave_threshold(highest + 1e-3) == second_tongue(highest + 1e-3)


@pytest.mark.parametrize("of", [first_tongue, second_tongue])
def test_deeper_fractions_change_no_bit(of, monkeypatch):
    found = of(OFFSETS)
    monkeypatch.setattr(mathieu, "DEPTH", 2 * mathieu.DEPTH)
    assert np.array_equal(of(OFFSETS), found)


def test_growth_is_that_of_the_monodromy():
    for offset, q in ((-0.1, 0.3), (0.0, 1e-3), (0.02, 0.02006), (0.5, 1.0), (0.56, 1.1)):
        half = -trace(offset, q) / 2
        exact = (half + (half * half - 1).sqrt()).ln() / PI
        assert float(growth(offset, q)) == pytest.approx(float(exact), rel=1e-12)


def test_growth_starts_at_the_threshold():
    q = first_tongue(OFFSETS)
    assert np.all(growth(OFFSETS, q * (1 - 1e-9)) == 0.0)
    assert np.all(growth(OFFSETS, q * (1 + 1e-9)) > 0.0)


def test_a_band_is_as_stable_as_its_weakest_wave():
    rng = np.random.default_rng(5)
    for _ in range(30):
        low, high = np.sort(rng.uniform(-0.9, 2.9, 2))
        within = wave_threshold(np.linspace(low, high, 400))
        assert band_threshold(low, high) <= within.min()
        edges = wave_threshold(np.array([low, high])).min() if low > 0 or high < 0 else 0.0
        assert band_threshold(low, high) == pytest.approx(edges, rel=1e-14)


def test_a_band_at_a_resonance_bears_no_drive():
    found = band_threshold(np.array([-0.2, 2.5, 3.5, 0.5]), np.array([0.1, 3.1, 3.9, 2.0]))
    assert found[:2].tolist() == [0.0, 0.0] and np.isnan(found[2]) and found[3] > 0.0
