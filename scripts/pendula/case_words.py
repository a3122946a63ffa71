"""Text that describes a case of the paper on pages: its detuning and its initial data."""

import xarray as xr
from latticode.equations.initial_values import read_initial
from replication.words import FIRM, number

SUBSCRIPTS = str.maketrans("-0123456789", "₋₀₁₂₃₄₅₆₇₈₉")


def case_of(dataset: xr.Dataset) -> str:
    """Return `omega` and `initial` of a dataset as text, such as Ω = 8, (A₀, B₀) = (5, 1)."""
    return case_in_words(float(dataset["omega"]), str(dataset["initial"].values))


def case_in_words(omega: float, initial: str) -> str:
    """Return the detuning and the initial data of a case as text."""
    sites = read_initial(initial)
    if len(sites) != 1:
        return f"Ω = {number(omega)}, data on {len(sites)} sites"
    ((site, (a, b)),) = sites.items()
    index = str(site).translate(SUBSCRIPTS)
    pair = f"(A{index}, B{index}) = ({_amplitude(a)}, {_amplitude(b)})"
    return f"Ω = {number(omega)}".replace(" ", FIRM) + ", " + pair.replace(" ", FIRM)


def _amplitude(z: complex) -> str:
    return f"{z:g}" if z.imag else number(z.real)
