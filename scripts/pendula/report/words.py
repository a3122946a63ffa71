"""How cases, solvers and symbols are written on a page."""

import re

from pendula.problem import read_initial

from .numbers import FIRM, MINUS, number, raised

SOLVERS = {
    "ode45": "ode45",
    "crank_nicolson": "Crank\N{EN DASH}Nicolson",
    "dop853": "DOP853",
    "taylor": "Taylor",
    "splitting": "BM6 splitting",
}
SYMBOLS = {
    "Omega": "Ω",
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
SIGNS = {"<=": "≤", ">=": "≥"}
_POWERS_OF_TEN = re.compile(r"(?<![\w.])\d+(\.\d+)?e[+-]?\d+(?!\w)")
_MINUS = re.compile(r"(?<![\w)|])-(?=[\w(|])")
_EXPONENTS = re.compile(r"\^(-?\d+)(?![\d.])")
_NAMES = re.compile(r"(?<![A-Za-z])(" + "|".join(SYMBOLS) + r")(?![A-Za-z])")


def symbols(text: str) -> str:
    """Return a text of the ledger with its Greek letters and signs."""
    text = _NAMES.sub(lambda found: SYMBOLS[found[0]], text)
    text = _POWERS_OF_TEN.sub(lambda found: number(float(found[0]), len(found[0])), text)
    text = _EXPONENTS.sub(lambda found: raised(found[1]), text)
    text = _MINUS.sub(MINUS, text)
    for written, sign in SIGNS.items():
        text = text.replace(written, sign)
    return text


def plainly(name: str) -> str:
    """Return the name of a number in the ledger as words."""
    return re.sub(r"_(?!\d)", " ", symbols(name.replace("_over_", " / ")))


def criterion(text: str) -> str:
    """Return a criterion of the ledger, names of numbers in it as words."""
    return re.sub(r"(?<=[a-z])_(?=[a-z])", " ", symbols(text))


def case_of(dataset) -> str:
    """Return a case, of `omega` and `initial` as datasets keep them: Ω = 8, (A₀, B₀) = (5, 1)."""
    return case_in_words(float(dataset["omega"]), str(dataset["initial"].values))


def case_in_words(omega: float, initial: str) -> str:
    """Return the detuning and the data of a case."""
    sites = read_initial(initial)
    if len(sites) != 1:
        return f"Ω = {number(omega)}, data on {len(sites)} sites"
    ((site, (a, b)),) = sites.items()
    index = str(site).replace("-", "₋").translate(str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉"))
    pair = f"(A{index}, B{index}) = ({_amplitude(a)}, {_amplitude(b)})"
    return f"Ω = {number(omega)}".replace(" ", FIRM) + ", " + pair.replace(" ", FIRM)


def _amplitude(z: complex) -> str:
    return f"{z:g}" if z.imag else number(z.real)


def count(number_of: int, word: str) -> str:
    """Return a number of things: 1 case, 3 cases."""
    return f"{number_of} {word}" if number_of == 1 else f"{number_of} {word}s"
