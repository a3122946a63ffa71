"""Which digits of a stored number are held, and whether a text prints more of them."""

import re

import numpy as np
import xarray as xr

NUMBER = re.compile(r"(\d[\d,]*(?:\.(\d+))?)(?:\s×\s10([⁻⁰¹²³⁴-⁹]+))?")
LOWERED = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")


def blurred(data: xr.Dataset, rng: np.random.Generator) -> xr.Dataset:
    """Return a dataset with every number moved by half of the last digit that is held."""
    data = data.copy(deep=True)
    for name, variable in data.data_vars.items():
        if variable.dtype.kind == "f":
            sign = rng.choice([-1.0, 1.0], variable.shape)
            data[name] = variable.astype(float) + sign * last_half(variable)
    return data


def last_half(variable: xr.DataArray) -> np.ndarray:
    """Return half of the last digit of each number: of single precision, or as declared.

    A number of at most eleven binary digits, such as a count or the end of a run, is exact.
    """
    values = abs(np.where(np.isfinite(variable), variable, 0.0).astype(float))
    digits = variable.attrs.get("significant_digits", np.inf)
    first = np.floor(np.log10(np.where(values > 0.0, values, 1.0)))
    declared = np.where(values > 0.0, 0.5 * 10.0 ** (first + 1.0 - digits), 0.0)
    single = 2.0**-24 * values * (variable.dtype == np.float32)
    exact = np.frexp(values)[0] * 2.0**11 % 1.0 == 0.0
    return np.where(exact, 0.0, np.maximum(declared, single))


def unlike(before: str, after: str) -> bool:
    """Return whether a number in a text has moved by more than one of its last place."""
    if NUMBER.sub("#", before) != NUMBER.sub("#", after):
        return True
    for pair in zip(NUMBER.finditer(before), NUMBER.finditer(after), strict=True):
        (one, unit), (other, finer) = map(_value_and_unit, pair)
        if abs(one - other) > 1.01 * min(unit, finer):
            return True
    return False


def _value_and_unit(found: re.Match) -> tuple[float, float]:
    """Return a printed number, and one of its last place."""
    power = 10.0 ** int((found[3] or "⁰").translate(LOWERED))
    return float(found[1].replace(",", "")) * power, power * 10.0 ** -len(found[2] or "")
