"""Numbers as a page shows them, each with the dataset that it comes from."""

from typing import NamedTuple

import numpy as np
from markupsafe import Markup

RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
MINUS, TIMES = "−", "×"
FIRM = "\N{NO-BREAK SPACE}"
SMALL = 1e-3
"""Numbers below are written with a power of ten."""


class Quote(NamedTuple):
    """A text made from a dataset, and where that is, seen from the page; a link in templates."""

    text: str
    link: str

    def __html__(self) -> str:
        return Markup('<a class="n" href="{}">{}</a>').format(self.link, self.text)

    def __str__(self) -> str:
        return self.text


def number(value: float, digits: int = 3) -> str:
    """Return a number to so many digits, small and large ones with a raised power of ten."""
    value = float(value)
    if not np.isfinite(value):
        return "none" if np.isnan(value) else "infinite" if value > 0 else f"{MINUS}infinite"
    small = 0 < abs(value) < SMALL
    plain = f"{value:.{digits - 1}e}" if small else f"{value:.{digits}g}"
    mantissa, _, exponent = plain.partition("e")
    if not exponent:
        return plain.replace("-", MINUS)
    mantissa = mantissa.rstrip("0").rstrip(".") if "." in mantissa else mantissa
    start = "" if mantissa == "1" else f"{mantissa}{FIRM}{TIMES}{FIRM}"
    return f"{start}10{raised(exponent)}".replace("-", MINUS)


def raised(exponent: str) -> str:
    """Return a whole number as an exponent."""
    return str(int(exponent)).translate(RAISED)


def with_error(value: float, error: float) -> str:
    """Return a number and its standard error to the first digit of that, to the second of a 1."""
    if not (np.isfinite(error) and error > 0):
        return number(value)
    first = int(np.floor(np.log10(error)))
    places = max(0, -first + (error < 2.0 * 10.0**first))
    return f"{value:.{places}f}{FIRM}±{FIRM}{error:.{places}f}".replace("-", MINUS)


def percent(part: float, digits: int = 2) -> str:
    """Return a part of one in per cent: 13 %."""
    value = 100.0 * float(part)
    return (
        f"{value:.0f} %".replace("-", MINUS) if abs(value) >= 10 else f"{number(value, digits)} %"
    )


def span(values, digits: int = 3) -> str:
    """Return the least and the largest of measured numbers: 0.51 to 0.54; one if they are alike."""
    if not np.isfinite(values).any():
        return "none"
    least, largest = (measured(edge(values), digits) for edge in (np.nanmin, np.nanmax))
    return least if least == largest else f"{least} to {largest}"


def measured(value: float, digits: int = 3) -> str:
    """Return a number with zeros at its end where they were measured: 1.00, not 1."""
    value = float(value)
    if not np.isfinite(value) or not SMALL <= abs(value) < 10**digits:
        return number(value, digits)
    return f"{value:#.{digits}g}".rstrip(".").replace("-", MINUS)
