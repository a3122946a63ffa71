"""Floquet multipliers: against the flow over a whole period, signatures, and collisions."""

import numpy as np
import pytest
from on_breathers import ABOVE, BELOW, at_twelve, half_traces, members
from pendula.studies.breathers import multipliers
from pendula.studies.breathers.periodic import FAMILIES, Breather, real_data, shoot
from pendula.studies.breathers.quarter_period import flow
from pendula.studies.breathers.steady import NotFoundError
from pendula.studies.breathers.waves import band_traces

ALL = [(constants, family) for constants in (BELOW, ABOVE) for family in FAMILIES]


def known(breather: Breather, parity: str) -> tuple:
    return breather, *multipliers.spectrum(multipliers.half_map(breather, parity), parity)


def monodromy(breather: Breather, parity: str) -> tuple[np.ndarray, np.ndarray]:
    """Return the map of all perturbations over a whole period, and the weights of their sums.

    Rows and columns are the real parts of A and B on all sites, then the imaginary ones.
    """
    sites, first = breather.data.shape[1], multipliers.PARITIES.index(parity)
    units = np.eye(2 * sites).reshape(2, sites, 2, sites)[:, first:].reshape(-1, 2, sites)
    directions = np.zeros((2, len(units), 4, sites))
    directions[0][:, ::2] = directions[1][:, 1::2] = units
    directions, nothing = directions.reshape(-1, 4, sites), np.empty((0, 4, sites))
    bundle = (nothing, directions) if first else (directions, nothing)
    period = 4.0 * breather.quarter
    ends = flow(breather.constants, real_data(breather.data), *bundle, period, 128)[1:, :, first:]
    rows = np.concatenate([ends[:, ::2], ends[:, 1::2]], axis=1).reshape(len(ends), -1)
    weights = np.tile([1.0] * (1 - first) + [2.0] * (sites - 1), 4)
    return rows.T, weights


@pytest.mark.parametrize("parity", multipliers.PARITIES)
def test_the_map_over_half_a_period_and_its_signatures_are_those_of_the_flow(parity):
    """The signature is that of i conj(v)^T J v on the eigenvectors v of the flow over a period.

    Where two multipliers are nearly equal their eigenvectors are not known.
    """
    compared = []
    for breather in (at_twelve(*one, 12) for one in ALL):
        half, (matrix, weights) = (
            multipliers.half_map(breather, parity),
            monodromy(breather, parity),
        )
        lower = (half.a.T * half.weights[:, 0]) / half.weights
        whole = np.block([[half.a, half.b], [half.c, lower]])
        assert np.abs(whole @ whole - matrix).max() < 1e-9
        values, vectors = np.linalg.eig(matrix)
        for nu, sign in zip(*multipliers.spectrum(half, parity), strict=True):
            mu = nu.real + 1j * np.sqrt(1.0 - nu.real**2 + 0j)
            off = np.abs(values - mu**2)
            if nu == 1.0 or abs(nu) > 1.0 or nu.imag or np.sort(off)[1] < 1e-6:
                continue
            p, q = np.split(vectors[:, off.argmin()], 2)
            form = 1j * np.sum(weights[: len(p)] * (p.conj() * q - q.conj() * p))
            assert off.min() < 1e-8
            assert np.sign(form.real) == sign
            compared.append(sign)
    assert set(compared) == {1, -1}
    assert len(compared) > 60


@pytest.mark.parametrize(("constants", "expected"), [(BELOW, -1), (ABOVE, 1)])
def test_waves_have_the_signature_of_their_frequency(constants, expected):
    """On a chain nearly at rest nu fills the bands of (15): positive frequencies at Omega = 8."""
    rest = Breather(constants, 12.0, np.zeros((2, 30)))
    traces, signs = multipliers.spectrum(multipliers.half_map(rest, "odd"), "odd")
    assert set(signs) == {expected}
    bands = band_traces(constants, 12.0)
    assert all(any(low - 1e-9 < nu.real < high + 1e-9 for low, high in bands) for nu in traces)
    assert traces.real.min() == pytest.approx(min(bands)[0], abs=0.01)
    assert traces.real.max() == pytest.approx(max(high for _, high in bands), abs=0.01)
    assert multipliers.localised_modes(rest, traces, signs) == []


@pytest.mark.parametrize(("traces", "rate"), [
    ([0.3, -1.0, 1.0, 1.0 + 1e-13], 0.0),  # on the circle, but for rounding
    ([-np.cosh(0.2)], 0.4 / np.pi),  # mu = -e^x over half a period pi / 2
    ([np.cosh(0.2 + 0.7j)], 0.4 / np.pi),  # a quartet e^(x + i y)
])  # fmt: skip
def test_growth_of_traces(traces, rate):
    assert multipliers.growth(2.0, np.array(traces)) == pytest.approx(rate)


def test_localised_modes_come_with_their_signatures():
    (mode,) = multipliers.localised_modes(*known(at_twelve(BELOW, "A = -B", 12), "even"))
    assert mode.signature == -1
    assert mode.trace == pytest.approx(0.945451, abs=1e-5)
    (mode,) = multipliers.localised_modes(*known(at_twelve(BELOW, "A = B", 12), "even"))
    assert mode.signature == 0  # it grows
    assert mode.trace.real > 1.0


def test_a_quartet_is_born_where_opposite_signatures_meet():
    low, high = members(ABOVE, "A = -B", 9.5, 10.0, most=30)[::-1]
    met = multipliers.collision(known(low, "even"), known(high, "even"), "even")
    assert sorted(met.signatures) == [-1, 1]
    assert -1.0 < met.trace < 1.0
    frequency = met.breather.frequency
    assert low.frequency < frequency < high.frequency
    for away, grows in ((-1e-3, True), (1e-3, False)):
        beside = shoot(ABOVE, frequency + away, met.breather.data)
        assert (multipliers.growth(frequency, half_traces(beside, "even")) > 0.0) is grows


def test_a_pair_meets_itself_at_one():
    """A = B gives birth to A alone there: an even perturbation that makes A and B differ."""
    low, high = members(ABOVE, "A = B", 8.07, 8.1, 9.0, most=30)[:0:-1]
    met = multipliers.collision(known(low, "even"), known(high, "even"), "even")
    assert met.trace == 1.0
    assert met.signatures == (1, -1)
    assert 8.08 < met.breather.frequency < 8.083


def test_no_collision_where_both_are_stable_or_grow_and_never_two_at_once():
    for family in ("A only", "A = B"):
        low, high = members(BELOW, family, 9.0, 10.0, most=30)[::-1]
        assert multipliers.collision(known(low, "even"), known(high, "even"), "even") is None
    stable, grown, signs = np.array([0.5 + 0j, 0.2]), np.array([1.2 + 0j, -1.2]), np.array([1, -1])
    with pytest.raises(NotFoundError, match="two even"):
        multipliers.collision((low, stable, signs), (high, grown, signs), "even")


def test_what_rounding_splits_stays_on_the_circle():
    """Two waves of one signature with equal nu: a is not symmetric, and rounding may split them."""
    one = np.eye(3)
    turned = np.array([[0.5, 1e-9, 0.0], [-1e-9, 0.5, 0.0], [0.0, 0.0, 0.1]])
    traces, signs = multipliers.spectrum(
        multipliers.HalfMap(-turned, one, one, np.ones((3, 1))), "odd"
    )
    assert not traces.imag.any()
    assert set(signs) == {1}
