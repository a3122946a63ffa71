"""Numbers as a page shows them, each with the dataset that it comes from."""

from typing import NamedTuple

import numpy as np
from markupsafe import Markup, escape

RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
MINUS, TIMES = "\N{MINUS SIGN}", "\N{MULTIPLICATION SIGN}"


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
    plain = f"{value:.{digits}g}"
    mantissa, _, exponent = plain.partition("e")
    if not exponent:
        return plain.replace("-", MINUS)
    power = str(int(exponent)).translate(RAISED)
    start = "" if mantissa == "1" else f"{mantissa} {TIMES} "
    return f"{start}10{power}".replace("-", MINUS)


def with_error(value: float, error: float) -> str:
    """Return a number with its standard error, both to the error's first digit: 0.508 ± 0.001."""
    if not (np.isfinite(error) and error > 0):
        return number(value)
    places = max(0, -int(np.floor(np.log10(error))))
    return f"{value:.{places}f} ± {error:.{places}f}".replace("-", MINUS)


def percent(part: float, digits: int = 2) -> str:
    """Return a part of one in per cent: 13 %."""
    return f"{number(100 * part, digits)} %"


def span(values, digits: int = 3) -> str:
    """Return the least and the largest of some numbers: 0.51 to 0.54; one if they are the same."""
    least, largest = (number(edge(values), digits) for edge in (np.nanmin, np.nanmax))
    return least if least == largest else f"{least} to {largest}"


def listed(words) -> str:
    """Return words as a sentence lists them: a, b and c."""
    words = [str(escape(word)) for word in words]
    return Markup(" and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words))
