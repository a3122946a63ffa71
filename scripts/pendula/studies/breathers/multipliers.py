"""Floquet multipliers of periodic breathers, their Krein signatures, and where they collide.

Let perturbations p + i q of the solution go over a quarter of its period T as

    p -> P p + Q q,    q -> S p + W q,

symplectic in p, q: W^T P - Q^T S = 1 (transposed with the sums over the whole chain). The
reflection at T / 4 gives the map over T / 2,

    [ a  b  ]        a = W^T P + Q^T S = 1 + 2 Q^T S,    b = 2 W^T Q,    c = 2 P^T S,
    [ c a^T ]

and with the change of sign there the multipliers mu over half a period are the eigenvalues of minus
this map. It is a product of two reflections, so that mu and 1 / mu come together, and the traces
nu = (mu + 1 / mu) / 2 are the eigenvalues of -a: half as many, and a breather is stable if all nu
lie in [-1, 1]. The multipliers over a whole period are the squares of mu. The shift along the
solution has nu = 1. There mu has a Jordan block, and an error d of the map would show as sqrt(d);
nu is simple and exact, so that it is set to 1.

Signatures. A pair mu = exp(+-i theta) on the circle, 0 < theta < pi, has the signature of the
quadratic form i conj(v)^T J v = i sum (conj p q - conj q p) on the eigenvector v of exp(i theta):
+1 if the perturbation turns as a wave exp(-i omega tau) of positive omega does, -1 if it turns the
other way. The first row of the map gives q = -i sin(theta) b^-1 p, hence the sign of
sin(theta) p^T b^-1 p. Since a b = b a^T, p = b y with an eigenvector y of a^T, so that y^T b y has
the same sign and nothing is inverted. Multipliers of one signature pass through each other; only
those of opposite signatures leave the circle where they meet (M. G. Krein, Doklady Akad. Nauk SSSR
73 (1950) 445; J. Moser, Comm. Pure Appl. Math. 11 (1958) 81; for breathers S. Aubry, Physica D 103
(1997) 201). At nu = +-1 a pair meets itself, and mu and 1 / mu have opposite signatures.

Finite chains. On an infinite chain the waves of (15) fill intervals of nu, and what is localised
lies outside of them or off the circle. On a finite chain the waves are single multipliers, and one
of the other signature that runs through them makes a row of isolated quartets, which come and go
with the length of the chain. So rates of growth are found on half of the chain too.
"""

from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from pendula.numerics.elementary import log

from .periodic import Breather, real_data, shoot, widened
from .quarter_period import STEPS, flow
from .steady import NotFoundError, exchange_sign
from .waves import band_traces

PARITIES = ("even", "odd")
NOISE = 1e-5
"""Growth by less counts as none: an error of nu near 1 shows by its root. A perturbation would grow
at this rate by a tenth until tau = 1e4; the slowest that was seen grows at 0.03."""
VANISHES = 1e-6
"""A form y^T b y that is smaller, relative to the vectors, is none."""
MARGIN = 1e-4
"""What is nearer to the waves in nu counts as one of them."""


class HalfMap(NamedTuple):
    """The blocks a, b, c of the map over half a period, each (n, n), and the weights of sums.

    `alike` says whether A = B or A = -B: then the map is the same with A and B exchanged.
    """

    a: np.ndarray
    b: np.ndarray
    c: np.ndarray
    weights: np.ndarray
    alike: bool = False


class Mode(NamedTuple):
    """A pair of multipliers: its trace nu, and its signature; 0 off the circle."""

    trace: complex
    signature: int


def half_map(breather: Breather, parity: str) -> HalfMap:
    """Return the map of even or odd perturbations over half a period, without the sign."""
    sites, first = breather.data.shape[1], PARITIES.index(parity)
    alike = exchange_sign(breather.data) != 0
    directions, nothing = _directions(sites, first, alike), np.empty((0, 4, sites))
    bundle = (nothing, directions) if first else (directions, nothing)
    steps, state = breather.finer * STEPS, real_data(breather.data)
    ends = flow(breather.constants, state, *bundle, breather.quarter, steps)[1:]
    ends = ends[:, :, first:].reshape(2, -1, 2, 2, sites - first)  # (part, start, A or B, part, n)
    if alike:
        ends = np.concatenate([ends, ends[:, :, ::-1]], axis=1)
    (p, s), (q, w) = ends.transpose(0, 3, 2, 4, 1).reshape(2, 2, ends.shape[1], -1)
    # a site beside the centre stands for its mirror image too
    weights = np.tile([1.0] * (1 - first) + [2.0] * (sites - 1), 2)[:, None]

    def product(left, right):
        return (left.T @ (weights * right)) / weights

    a, b, c = np.eye(len(p)) + 2.0 * product(q, s), 2.0 * product(w, q), 2.0 * product(p, s)
    return HalfMap(a, b, c, weights, alike)


def _directions(sites: int, first: int, alike: bool) -> np.ndarray:
    """Return unit perturbations on the sites `first`..M: of real parts, then of imaginary ones.

    Those of B are left out where A and B are `alike`.
    """
    units = np.eye(2 * sites).reshape(2, sites, 2, sites)[: 2 - alike, first:]
    units = units.reshape(-1, 2, sites)
    found = np.zeros((2, len(units), 4, sites))
    found[0][:, ::2] = found[1][:, 1::2] = units
    return found.reshape(-1, 4, sites)


def spectrum(half: HalfMap, parity: str) -> tuple[np.ndarray, np.ndarray]:
    """Return all traces nu, complex, and their signatures, which mean nothing beyond +-1.

    The form of a complex trace vanishes. Where it does not, rounding has split two waves of one
    signature with nearly equal nu, which stay on the circle: nu is made real. The trace of
    the shift along the solution, an even perturbation, is exactly 1.
    """
    found = [_traces_and_forms(*one) for one in _sectors(half)]
    traces, forms = (np.concatenate(values) for values in zip(*found, strict=True))
    complex_ones = (traces.imag != 0.0) & (np.abs(forms) < VANISHES)
    traces.imag[~complex_ones] = 0.0
    if parity == "even":
        traces[np.argmin(np.abs(traces - 1.0))] = 1.0
    return traces, np.where(complex_ones, 0, np.sign(forms)).astype(int)


def _sectors(half: HalfMap) -> list[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Return the blocks a and b and the weights of perturbations that do not mix.

    Those with b = a and those with b = -a do not where A and B are alike.
    """
    if not half.alike:
        return [(half.a, half.b, half.weights)]
    n = len(half.a) // 2
    return [
        (*(one[:n, :n] + sign * one[:n, n:] for one in half[:2]), half.weights[:n])
        for sign in (1.0, -1.0)
    ]


def _traces_and_forms(a: np.ndarray, b: np.ndarray, weights: np.ndarray) -> tuple:
    """Return the eigenvalues of -a, and y^T b y on each eigenvector y of a^T, relative."""
    values, vectors = np.linalg.eig(a.T)
    moved = b @ (vectors / weights)
    forms = np.sum(vectors.conj() * moved, axis=0).real
    forms /= np.sqrt(np.sum(np.abs(vectors) ** 2, axis=0) * np.sum(np.abs(moved) ** 2, axis=0))
    return -values.astype(complex), forms


def growths(frequency: float, traces: np.ndarray) -> np.ndarray:
    """Return the rate of growth per unit of tau of each trace; 0 where it is none."""
    root = np.sqrt(traces.astype(complex) ** 2 - 1.0)
    largest = np.maximum(np.abs(traces + root), np.abs(traces - root))
    rates = log(largest) * frequency / np.pi
    return np.where(rates > NOISE, rates, 0.0)


def growth(frequency: float, traces: np.ndarray) -> float:
    """Return the rate at which the worst perturbation grows per unit of tau; 0 if none does."""
    return float(growths(frequency, traces).max())


def localised_modes(breather: Breather, traces: np.ndarray, signs: np.ndarray) -> list[Mode]:
    """Return what is no wave: growing ones first, and then by their distance from the waves.

    Of two conjugate traces that with a positive imaginary part is returned, and not the shift.
    """
    rates = growths(breather.frequency, traces)
    away = np.full(len(traces), np.inf)
    for low, high in band_traces(breather.constants, breather.frequency):
        away = np.minimum(away, np.maximum(low - traces.real, traces.real - high))
    chosen = ((rates > 0.0) & (traces.imag >= 0.0)) | ((rates == 0.0) & (away > MARGIN))
    chosen &= traces != 1.0
    order = sorted(np.flatnonzero(chosen), key=lambda k: (-rates[k], -away[k]))
    return [Mode(complex(traces[k]), 0 if rates[k] else int(signs[k])) for k in order]


# --- Collisions -----------------------------------------------------------------------------------


class Collision(NamedTuple):
    """Where two multipliers meet and leave the circle, on the family of a breather."""

    breather: Breather
    trace: float
    signatures: tuple[int, int]


FREQUENCY_ERROR = 1e-6


def unstable_count(frequency: float, traces: np.ndarray) -> int:
    """Return how many traces grow; conjugate ones count once."""
    return int(((growths(frequency, traces) > 0.0) & (traces.imag >= 0.0)).sum())


Known = tuple[Breather, np.ndarray, np.ndarray]
"""A breather with the traces and signatures of its perturbations of one parity."""


def collision(one: Known, other: Known, parity: str) -> Collision | None:
    """Return the collision between two members of a family that differ by one growing trace.

    None where they do not differ: two collisions between them that undo each other are missed. A
    smooth function of the frequency changes its sign at a collision, and the method of R. P. Brent
    finds its root. The signatures are those just beside it, on the side where all is on the circle.
    """
    known = {found[0].frequency: found for found in (one, other)}
    counts = {lam: unstable_count(lam, traces) for lam, (_, traces, _) in known.items()}
    stable, unstable = sorted(counts, key=counts.get)
    if counts[stable] == counts[unstable]:
        return None
    if counts[unstable] - counts[stable] > 1:
        raise NotFoundError(f"two {parity} perturbations grow at {unstable:g}, not at {stable:g}")
    meet = _which_meet(known[stable][1], known[unstable][1])
    beside = {}

    def gap(frequency: float) -> float:
        if frequency not in known:
            breather = _between(known, frequency)
            known[frequency] = (breather, *spectrum(half_map(breather, parity), parity))
        found = meet(known[frequency][1:])
        if found.gap > 0.0:
            beside[frequency] = found
        return found.gap

    root = brentq(gap, *sorted(known), xtol=FREQUENCY_ERROR)
    nearest = min(beside, key=lambda lam: abs(lam - root))
    return Collision(known[nearest][0]._replace(frequency=root), *beside[nearest][1:])


def _between(known: dict, frequency: float) -> Breather:
    """Return the breather at a frequency between known ones, from the line through the nearest."""
    low = max(lam for lam in known if lam < frequency)
    high = min(lam for lam in known if lam > frequency)
    below, above = known[low][0], known[high][0]
    sites = max(below.data.shape[1], above.data.shape[1])
    first, second = widened(below.data, sites), widened(above.data, sites)
    share = (frequency - low) / (high - low)
    return shoot(below.constants, frequency, first + share * (second - first))


class _Meeting(NamedTuple):
    gap: float
    trace: float
    signatures: tuple[int, int]


def _which_meet(before: np.ndarray, after: np.ndarray):
    """Return what gives the meeting of (traces, signs), by the trace that is off the circle after.

    mu and 1 / mu meet at nu = +-1: the gap is 1 - |nu|. Two pairs meet elsewhere and make a
    quartet: the gap is the square of half the difference of their nu, real on either side.
    """
    off_before, off_after = (
        traces[(traces.imag != 0.0) | (np.abs(traces.real) > 1.0)] for traces in (before, after)
    )
    distances = [np.abs(nu - off_before).min(initial=np.inf) for nu in off_after]
    new = off_after[int(np.argmax(distances))]
    if new.imag:
        return _two_pairs(int((off_before.imag > 0.0).sum()))
    end = float(np.sign(new.real))
    real = off_before.real[off_before.imag == 0.0]
    return _pair_with_itself(end, int((end * real > 1.0).sum()))


def _pair_with_itself(end: float, others: int):
    """Return what finds the trace that passes `end`, where `others` lie beyond it on both sides."""

    def meet(found):
        traces, signs = found
        real = np.flatnonzero((traces.imag == 0.0) & (traces != 1.0))
        last = real[np.argsort(-end * traces[real].real, kind="stable")[others]]
        sign = int(signs[last])
        return _Meeting(1.0 - end * float(traces[last].real), end, (sign, -sign))

    return meet


def _two_pairs(others: int):
    """Return what finds the quartet, or the nearest pairs of opposite signatures before it.

    `others` quartets are there on both sides.
    """

    def meet(found):
        traces, signs = found
        split = np.sort(traces.imag[traces.imag > 0.0])
        if len(split) > others:
            return _Meeting(-float(split[0] * split[0]), np.nan, (0, 0))
        on = (traces.imag == 0.0) & (np.abs(traces.real) < 1.0)
        plus, minus = (traces[on & (signs == sign)].real for sign in (1, -1))
        if not (len(plus) and len(minus)):
            raise NotFoundError("a quartet grows out of multipliers of one signature")
        difference = minus[:, None] - plus
        i, j = np.unravel_index(np.abs(difference).argmin(), difference.shape)
        half = 0.5 * float(difference[i, j])
        return _Meeting(half * half, 0.5 * float(minus[i] + plus[j]), (-1, 1))

    return meet
