"""Numbers, symbols and tables as text for pages."""

import re
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

import numpy as np
from latticode.datasets import complete_or_absent
from tabulate import tabulate

RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
MINUS, TIMES = "−", "×"
FIRM = "\N{NO-BREAK SPACE}"
SMALL = 1e-3
"""Smaller numbers are printed with a power of ten."""
ROUNDING = 1e-9
"""A smaller relative error is not printed."""
UP, DOWN = np.ceil, np.floor
"""The directions of `rounded` and `outward`."""
Direction = Callable[[float], float]
SYMBOLS = {
    "Omega": "Ω",
    "A_0": "A₀",
    "B_0": "B₀",
    "C_0": "C₀",
    "gamma_0": "γ₀",
    "gamma": "γ",
    "epsilon": "ε",
    "delta_0": "δ₀",
    "delta": "δ",
    "tau": "τ",
    "mu": "μ",
    "omega": "ω",
    "beta": "β",
    "l2": "ℓ²",
    "l-infinity": "ℓ∞",
    "linf": "ℓ∞",
}
SIGNS = {"<=": "≤", ">=": "≥", "+-": "±"}
_POWERS_OF_TEN = re.compile(r"(?<![\w.])\d+(\.\d+)?e[+-]?\d+(?!\w)")
_MINUS = re.compile(r"(?<![\w)|])-(?=[\w(|])")
_EXPONENTS = re.compile(r"\^(-?\d+)(?![\d.])")
_NAMES = re.compile(r"(?<![A-Za-z])(?<![a-z]\.)(" + "|".join(SYMBOLS) + r")(?![A-Za-z])")


def number(value: float, digits: int = 3) -> str:
    """Return a number to `digits` significant digits; small and large ones get a power of ten."""
    value = float(value)
    if not np.isfinite(value):
        return "none" if np.isnan(value) else "infinite" if value > 0 else f"{MINUS}infinite"
    small = 0 < abs(value) < SMALL
    digits_text = f"{value:.{digits - 1}e}" if small else f"{value:.{digits}g}"
    mantissa, _, exponent = digits_text.partition("e")
    if not exponent:
        return digits_text.replace("-", MINUS)
    mantissa = mantissa.rstrip("0").rstrip(".") if "." in mantissa else mantissa
    start = "" if mantissa == "1" else f"{mantissa}{FIRM}{TIMES}{FIRM}"
    return f"{start}10{raised(exponent)}".replace("-", MINUS)


def raised(exponent: str) -> str:
    """Return a whole number as an exponent."""
    return str(int(exponent)).translate(RAISED)


def with_error(value: float, error: float, digits: int = 3) -> str:
    """Return a number and its error with one digit of the error, or two if the first is 1.

    The error is rounded up and includes the rounding of the number, so the printed interval
    contains the exact one. Small numbers with small errors get a common power of ten. If the
    relative error is below ROUNDING, the number is printed to `digits` digits without it.
    """
    if not (np.isfinite(error) and error > ROUNDING * abs(value)):
        return number(value, digits)
    if max(abs(value), error) < SMALL:
        power = int(np.floor(np.log10(max(abs(value), error))))
        scaled = with_error(value / 10.0**power, error / 10.0**power)
        return f"({scaled}){FIRM}{TIMES}{FIRM}10{raised(str(power))}"
    first = int(np.floor(np.log10(error)))
    places = max(0, -first + (error < 2.0 * 10.0**first))
    enclosing = rounded(error + abs(round(value, places) - value), places, UP)
    return f"{value:.{places}f}{FIRM}±{FIRM}{enclosing:.{places}f}".replace("-", MINUS)


def rounded(value: float, places: int, direction: Direction) -> float:
    """Return a number rounded up or down to decimal places, with a tolerance of 1e-9 places."""
    scaled = value * 10.0**places
    return float(direction(scaled - 1e-9 if direction is UP else scaled + 1e-9)) / 10.0**places


def outward(value: float, digits: int, direction: Direction) -> float:
    """Return a number rounded to `digits` significant digits, up or down."""
    if not np.isfinite(value) or value == 0:
        return float(value)
    return rounded(value, digits - 1 - int(np.floor(np.log10(abs(value)))), direction)


def percent(fraction: float, digits: int = 2) -> str:
    """Return a fraction in per cent, such as 13 %; only the fraction 1 is printed as 100 %."""
    value = 100.0 * float(fraction)
    if abs(value) < 10:
        return f"{number(value, digits)}{FIRM}%"
    texts = (f"{value:.{places}f}" for places in range(8))
    rounded = next((text for text in texts if value == 100 or float(text) != 100), "100")
    rounded = rounded.replace("-", MINUS)
    return f"{rounded}{FIRM}%"


def enclosing_span(low: float, high: float, digits: int) -> str:
    """Return a range, rounded outward to `digits` significant digits of its lower end.

    Both ends get the same number of decimal places. `low` must be positive.
    """
    places = max(0, digits - 1 - int(np.floor(np.log10(low))))
    ends = rounded(low, places, DOWN), rounded(high, places, UP)
    return " to ".join(dict.fromkeys(f"{end:.{places}f}" for end in ends))


def symbols(text: str) -> str:
    """Return a text of the ledger with Greek letters and mathematical signs."""
    text = _NAMES.sub(lambda match: SYMBOLS[match[0]], text.replace("l2^2", "(l2)²"))
    text = _POWERS_OF_TEN.sub(lambda match: number(float(match[0]), len(match[0])), text)
    text = _EXPONENTS.sub(lambda match: raised(match[1]), text)
    text = _MINUS.sub(MINUS, text)
    for written, sign in SIGNS.items():
        text = text.replace(written, sign)
    return text


def plainly(name: str) -> str:
    """Return the name of a number in the ledger as readable text."""
    return re.sub(r"_(?!\d)", " ", symbols(name.replace("_over_", " / ")))


def markdown(head: Sequence[str], rows: Iterable[Sequence]) -> str:
    """Return a table in Markdown; cells are formatted with `str`."""
    titles, *cells = ([str(cell).replace("|", "\\|") for cell in row] for row in (head, *rows))
    # no alignment: one long cell would widen every row
    return tabulate(cells, titles, "github", stralign=None, disable_numparse=True)


def write_markdown(path: str | Path, *paragraphs: str) -> None:
    """Write a page of Markdown: titles, paragraphs and tables with an empty line between them."""
    with complete_or_absent(path) as partial:
        Path(partial).write_text("\n\n".join(paragraphs) + "\n", encoding="utf-8")
