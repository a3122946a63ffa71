"""Mathieu's equation once more, by power series in 40 digits, to try the library on.

Nothing here uses the library: neither its continued fractions nor its floating-point numbers.
"""

from decimal import Decimal, localcontext

PI = Decimal("3.1415926535897932384626433832795028841971")
TERMS, PIECES = 60, 4


def cosine(x: Decimal) -> Decimal:
    """Return the cosine by its series."""
    total = term = Decimal(1)
    for n in range(1, TERMS):
        term *= -x * x / ((2 * n - 1) * (2 * n))
        total += term
    return total


def trace(offset, q) -> Decimal:
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


def distance_to_edge(offset, q, level: int) -> float:
    """Return by how much q is off, over q, from where the trace is `level`, -2 or 2.

    The slope of the trace in q comes from a second q.
    """
    with localcontext() as context:
        context.prec = 40
        q = Decimal(q)
        step = q / 1_000_000
        here, beside = trace(offset, q), trace(offset, q + step)
        return float((here - level) * step / (beside - here) / q)


def growth_over_period(offset, q) -> float:
    """Return the logarithm of the largest multiplier over pi, in the first tongue."""
    with localcontext() as context:
        context.prec = 40
        half = -trace(offset, q) / 2
        return float((half + (half * half - 1).sqrt()).ln())
