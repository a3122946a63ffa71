"""The breathers that tests start from."""

import numpy as np
from pendula.problem import Constants
from pendula.studies.breathers.multipliers import half_map, spectrum
from pendula.studies.breathers.periodic import Breather, family_of, shoot, single_site

BELOW = Constants(epsilon=1.0, gamma=1.0, omega=-4.0)
ABOVE = Constants(epsilon=1.0, gamma=1.0, omega=8.0)
"""Detunings below and above the band of linear waves: those of Figs 3 and 2."""


def at_twelve(constants: Constants, family: str, half_width: int) -> Breather:
    """Return the breather of a family at the frequency 12."""
    return shoot(constants, 12.0, single_site(constants, 12.0, family, half_width))


def members(constants: Constants, family: str, *frequencies, least=8, most=48) -> list[Breather]:
    """Return the breathers of a family from the highest frequency down."""
    return list(family_of(constants, family, frequencies, {"least": least, "most": most}))


def half_traces(breather: Breather, parity: str) -> np.ndarray:
    """Return the numbers nu of even or odd perturbations, complex."""
    return spectrum(half_map(breather, parity), parity)[0]
