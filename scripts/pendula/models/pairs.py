"""All steady states of a single pair of pendula, in closed form.

For epsilon = 0 a steady state of (4) obeys

    (Omega + |A|^2 / 2) A = gamma (conj A - conj B) = -(Omega + |B|^2 / 2) B.

Proof that the list below is complete (gamma > 0, A and B not both zero). If both factors
Omega + |.|^2 / 2 vanish, so does the middle, and A = B on the circle |A|^2 = -2 Omega. Otherwise
let the factor of A be nonzero. If the right side vanished, then A = 0, and the middle would give
B = 0. So both sides are nonzero, and A = r B with a real r. For r = 1 the middle vanishes: this
is the circle. For any other r the middle is a real multiple of conj A, so A^2 is real: A and B are
both real or both imaginary. Let A = a, B = b, s = gamma in the real case, and A = i a, B = i b,
s = -gamma in the imaginary case, because the drive acts on conjugates. Then

    (Omega - s) a + s b + a^3 / 2 = 0,     (Omega - s) b + s a + b^3 / 2 = 0.

The difference is (a - b) (Omega - 2 s + (a^2 + a b + b^2) / 2) = 0, and the sum is
(a + b) (Omega + (a^2 - a b + b^2) / 2) = 0. So either a = b, or a = -b with
a^2 = 2 (2 s - Omega), or both brackets vanish: a b = 2 s and a^2 + b^2 = 2 s - 2 Omega.
"""

from math import copysign, sqrt
from typing import NamedTuple


class Family(NamedTuple):
    """A family of steady states of one pair; `name` is its label in datasets."""

    name: str
    imaginary: bool  # whether A and B are imaginary; else real
    kind: str  # "opposite" for a = -b, "equal" for a = b, "asymmetric"

    def drive(self, gamma: float) -> float:
        """Return s, the signed strength of the drive on a and b."""
        return -gamma if self.imaginary else gamma


FAMILIES = (
    Family("A = -B real", False, "opposite"),
    Family("A = B real", False, "equal"),
    Family("asymmetric real", False, "asymmetric"),
    Family("A = -B imaginary", True, "opposite"),
    Family("asymmetric imaginary", True, "asymmetric"),
)
"""All families. The real state represents the circle A = B, which has states of any phase."""


def pair(family: Family, gamma: float, omega: float) -> tuple[float, float] | None:
    """Return (a, b) of a family with a >= |b|, or None if the family does not exist."""
    s = family.drive(gamma)
    if family.kind == "equal":
        return _same(-2.0 * omega, 1.0)
    if family.kind == "opposite":
        return _same(2.0 * (2.0 * s - omega), -1.0)
    # a + b and a - b, from the sum of squares and the product
    total, difference = 6.0 * s - 2.0 * omega, -2.0 * s - 2.0 * omega
    if min(total, difference) <= 0.0:
        return None
    large, small = sqrt(max(total, difference)), sqrt(min(total, difference))
    return (large + small) / 2.0, copysign((large - small) / 2.0, s)


def _same(square: float, sign: float) -> tuple[float, float] | None:
    return (sqrt(square), sign * sqrt(square)) if square > 0.0 else None
