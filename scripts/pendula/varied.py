"""Numbers that are not in the paper, measured again with each of their choices changed.

A choice is a tolerance, a length, a margin, a seed or a definition. `vary` uses the first value of
every choice for the printed number, and changes one choice at a time for its variations. The error
of the number is the larger of its statistical error and its largest change under a variation.

For the number `speed` a dataset also has `speed_error`, `speed_statistical_error`, and
`speed_varied` along `variation`, with labels such as "tolerance = 1e-10". A number with a
confidence interval also has `speed_low` and `speed_high`, which enclose its variations.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from latticode.measures.confidence import ConfidenceInterval

Estimate = tuple[Any, Any] | ConfidenceInterval
"""A number with its statistical error or confidence interval, or arrays of these of equal shape.
NaN means that a number was not measured."""
VARIATION, ENDINGS = "variation", ("", "_error", "_statistical_error", "_varied")
"""The dimension of variations, and the endings of the names of a number's variables."""


class VariedNumber(NamedTuple):
    """A number, or an array of numbers, with its values under variations of its choices."""

    value: np.ndarray
    statistical_error: np.ndarray  # of the shape of `value`
    choices: Mapping[str, Any]  # the choices of the printed number, by name
    variations: Mapping[str, np.ndarray]  # the number again, by "choice = value"
    limits: ConfidenceInterval | None = None  # for an interval that may be asymmetric

    @property
    def widened(self) -> tuple[np.ndarray, np.ndarray]:
        """The ends of the confidence interval, widened to enclose all variations."""
        varied_values = list(self.variations.values())
        low = np.fmin.reduce([self.limits.low, *varied_values], axis=0)
        return low, np.fmax.reduce([self.limits.high, *varied_values], axis=0)

    @property
    def error(self) -> np.ndarray:
        """The larger of the statistical error and the largest change under a variation."""
        with np.errstate(invalid="ignore"):  # times that are never reached give infinity - infinity
            changes = np.abs(np.array(list(self.variations.values())) - self.value)
        return np.fmax(self.statistical_error, np.fmax.reduce(changes, axis=0))


def settings_of(choices: Mapping[str, Sequence]) -> dict[str, dict[str, Any]]:
    """Return the settings of each measurement that `vary` makes, by a label "choice = value".

    The first has the label "" and the first value of every choice. Each further measurement changes
    one choice to one of its other values.
    """
    printed = {name: values[0] for name, values in choices.items()}
    changed = {
        f"{name} = {_written(value)}": printed | {name: value}
        for name, values in choices.items()
        for value in values[1:]
    }
    return {"": printed, **changed}


def _written(value: Any) -> str:
    return f"{value:g}" if isinstance(value, int | float) else str(value)


def vary(measure: Callable[..., Estimate], choices: Mapping[str, Sequence]) -> VariedNumber:
    """Return the number `measure(**settings)` with its variations by `settings_of(choices)`.

    Raises ValueError if no choice has a second value, since nothing would be varied.
    """
    return vary_several(lambda **settings: {"number": measure(**settings)}, choices)["number"]


def vary_several(
    measure: Callable[..., Mapping[str, Estimate]], choices: Mapping[str, Sequence]
) -> dict[str, VariedNumber]:
    """Return, by name, each number of a measurement with its variations; see `vary`."""
    (_, printed), *changed = settings_of(choices).items()
    if not changed:
        raise ValueError(f"no choice has a second value to vary: {', '.join(choices) or 'none'}")
    first = measure(**printed)
    varied_estimates = {label: measure(**settings) for label, settings in changed}
    return {
        name: _varied(
            estimate,
            printed,
            {label: varied_estimates[label][name][0] for label in varied_estimates},
        )
        for name, estimate in first.items()
    }


def _varied(
    estimate: Estimate, choices: dict[str, Any], varied_values: Mapping[str, Any]
) -> VariedNumber:
    limits = estimate if isinstance(estimate, ConfidenceInterval) else None
    arrays = [np.asarray(array, float) for array in estimate]
    if limits:
        value, low, high = arrays
        with np.errstate(invalid="ignore"):  # see `VariedNumber.error`
            error = np.fmax(value - low, high - value)
    else:
        value, error = arrays
    changed = {label: np.asarray(value, float) for label, value in varied_values.items()}
    return VariedNumber(value, np.broadcast_to(error, value.shape), choices, changed, limits)


class NamedNumber(NamedTuple):
    """A number with its dimensions in a dataset and its long name."""

    dimensions: tuple[str, ...]
    number: VariedNumber
    long_name: str


def as_dataset(numbers: Mapping[str, NamedNumber], coordinates: Mapping[str, Any]) -> xr.Dataset:
    """Return a dataset of numbers by name, with the coordinates of their dimensions.

    The attribute `choices` of a number holds the choices of the printed value. A number that was
    not measured under a variation is NaN there.
    """
    labels = list(
        dict.fromkeys(label for named in numbers.values() for label in named.number.variations)
    )
    attributes = {"long_name": "choice that was changed, and its changed value"}
    label = xr.Variable(VARIATION, np.array(labels, object), attributes)
    data = xr.Dataset(coords={**coordinates, VARIATION: label})
    for name, printed in numbers.items():
        data = data.assign(dict(zip(names_of(name), _variables_of(printed, labels), strict=True)))
        data = data.assign(_limits(name, printed))
    return data


def _variables_of(printed: NamedNumber, labels: Sequence[str]) -> list[xr.Variable]:
    """Return a number, its error, its statistical error, and the number under its variations."""
    (dims, number, meaning), missing = printed, np.full(printed.number.value.shape, np.nan)
    varied_values = [number.variations.get(label, missing) for label in labels]
    chosen = ", ".join(f"{key} = {_written(value)}" for key, value in number.choices.items())
    error = f"error of the {meaning}: the larger of the statistical one and the largest change"
    return [
        xr.Variable(dims, number.value, {"long_name": meaning, "choices": chosen}),
        xr.Variable(dims, number.error, _named(error)),
        xr.Variable(dims, number.statistical_error, _named(f"statistical error of the {meaning}")),
        xr.Variable(
            (*dims, VARIATION), np.stack(varied_values, axis=-1), _named(f"{meaning}, varied")
        ),
    ]


def _limits(name: str, printed: NamedNumber) -> dict[str, xr.Variable]:
    """Return the ends of a number's confidence interval by name, if it has an interval."""
    dims, number, meaning = printed
    if number.limits is None:
        return {}
    meaning_of_limit = f"limit of the {meaning}, moved to enclose its variations"
    return {
        f"{name}_{end}": xr.Variable(dims, limit, _named(f"{words} {meaning_of_limit}"))
        for (end, words), limit in zip(
            (("low", "lower"), ("high", "upper")), number.widened, strict=True
        )
    }


def _named(long_name: str) -> dict[str, str]:
    return {"long_name": long_name}


def names_of(number: str) -> list[str]:
    """Return the names of a number's variables: value, both errors, and its variations."""
    return [f"{number}{end}" for end in ENDINGS]


def numbers_in(data: xr.Dataset) -> list[str]:
    """Return the names of the numbers of a dataset that have variations."""
    end = ENDINGS[-1]
    return [str(name).removesuffix(end) for name in data.data_vars if str(name).endswith(end)]


def variations_of(data: xr.Dataset, number: str) -> dict[str, float]:
    """Return the values of a single number of a dataset under its variations, by label.

    `data` has only the dimension of variations. The result is empty for a number without any.
    """
    if number not in numbers_in(data):
        return {}
    varied_values = data[names_of(number)[-1]].dropna(VARIATION)
    return {str(value[VARIATION].item()): float(value) for value in varied_values}


def single_numbers(data: xr.Dataset) -> Iterator[tuple[str, xr.Dataset]]:
    """Yield the name and dataset of each number with variations, or of each entry of an array.

    The dataset holds the variables of this number alone.
    """
    for name in numbers_in(data):
        number = data[[variable for variable in names_of(name) if variable in data]]
        for place in np.argwhere(np.isfinite(data[name].values)):
            single = number.isel(dict(zip(data[name].dims, place, strict=True)))
            if variations_of(single, name):
                yield name, single
