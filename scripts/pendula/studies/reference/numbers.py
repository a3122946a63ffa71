"""Multiprecision numbers of heyoka, from the decimals that the configuration prints."""

from types import ModuleType

import numpy as np

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
