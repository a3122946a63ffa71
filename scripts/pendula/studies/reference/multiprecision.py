"""Equations (4) and their energy (8) in multiprecision, for heyoka, on half a chain of even data.

A state has the rows Re A, Im A, Re B, Im B on the sites 0..M, and A = B = 0 beyond site M. heyoka
takes expressions, which follow from the traced equations. The numbers come from the decimals that
the configuration prints.
"""

from types import ModuleType
from typing import Any, NamedTuple

import numpy as np

from pendula.models.amplitudes import field

HEYOKA = "heyoka==7.13.2"


class HeyokaMissingError(RuntimeError):
    """heyoka, which only the reference needs, is not installed."""


def load_heyoka() -> ModuleType:
    """Return the module heyoka; raises HeyokaMissingError with the command that installs it."""
    try:
        import heyoka
    except ImportError:
        raise HeyokaMissingError(
            f"the reference, and nothing else, needs heyoka: pip install {HEYOKA}"
        ) from None
    return heyoka


class Numbers:
    """Makes multiprecision reals of `bits` bits.

    With `decimal`, 0.1 is one tenth: the shortest decimal that names the double, which is what
    the configuration prints. Without, it is the double itself.
    """

    def __init__(self, bits: int, decimal: bool = True):
        self.heyoka, self.bits, self.decimal = load_heyoka(), bits, decimal

    def exact(self, x: float):
        """Return the double `x`, exactly."""
        return self.heyoka.real(float(x), self.bits)

    def given(self, x: float):
        """Return the number that the configuration means by `x`."""
        return self.heyoka.real(repr(float(x)), self.bits) if self.decimal else self.exact(x)

    def exactly(self, values) -> np.ndarray:
        """Return an array of doubles as reals."""
        flat = [self.exact(x) for x in np.ravel(values)]
        return np.array(flat).reshape(np.shape(values))


class RealConstants(NamedTuple):
    """Coupling, drive and detuning, as multiprecision reals."""

    epsilon: Any
    gamma: Any
    omega: Any


def right_hand_side(heyoka, constants: RealConstants, half_width: int) -> list[tuple]:
    """Return the pairs (variable, its rate of change), in the order of a flattened state."""
    names = [[f"{row}{n}" for n in range(half_width + 1)] for row in ("ra", "ia", "rb", "ib")]
    rows = [[heyoka.make_vars(name) for name in row] for row in names]

    def field_at(component: int, n: int) -> tuple:
        def seen(partner: int, part: int, by: int):
            row, site = rows[2 * (component ^ partner) + part], abs(n + by)  # -1 moves as 1
            return row[site] if site < len(row) else 0.0  # site M + 1 is at rest

        return field(constants, seen)

    pairs = []
    for component in (0, 1):
        fields = [field_at(component, n) for n in range(half_width + 1)]
        re, im = rows[2 * component : 2 * component + 2]
        pairs += [(u, of_im) for u, (_, of_im) in zip(re, fields, strict=True)]
        pairs += [(v, -of_re) for v, (of_re, _) in zip(im, fields, strict=True)]
    return pairs


def norms(states: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the l-infinity and l2 norms, each (component, time), of states (time, row, site)."""
    modulus2 = _squares(states)
    largest = np.maximum.reduce(modulus2, axis=2)
    return np.sqrt(largest), np.sqrt(_over_chain(modulus2))


def energy(constants: RealConstants, states: np.ndarray) -> np.ndarray:
    """Return the energy (8), (time,), of states (time, row, site)."""
    epsilon, gamma, omega = constants
    modulus2 = _squares(states)
    both = modulus2[0] + modulus2[1]
    quartic = np.square(modulus2[0]) + np.square(modulus2[1])
    gap = states[:, :2] - states[:, 2:]  # Re (A - B) and Im (A - B)
    drive = np.square(gap[:, 1]) - np.square(gap[:, 0])
    # of all bonds: inside the half chain twice (left and right), and the two to the ends
    bonds = _sum(np.square(states[:, :, 1:] - states[:, :, :-1])) + _sum(states[:, :, -1:] ** 2)
    on_sites = quartic / 4 + omega * both + gamma * drive
    return _over_chain(on_sites) - epsilon * (bonds + bonds)


def _squares(states):
    """Return |A_n|^2 and |B_n|^2, (component, time, site)."""
    squares = np.square(states)
    return np.stack([squares[:, 0] + squares[:, 1], squares[:, 2] + squares[:, 3]])


def _over_chain(values):
    """Return the sum over the sites -M..M of values that end in the sites 0..M."""
    right = np.add.reduce(values[..., 1:], axis=-1)
    return values[..., 0] + right + right


def _sum(values):
    """Return the sum over rows and sites of values (time, row, site)."""
    return np.add.reduce(np.add.reduce(values, axis=2), axis=1)
