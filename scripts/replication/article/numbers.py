"""The numbers that an article prints, each with the source that its card describes."""

from collections.abc import Callable
from typing import Any

import xarray as xr

from replication.ledger.rows import counted_verdicts, load, on_figure, whether_it_holds
from replication.results import Results
from replication.variables import VARIATION
from replication.words import (
    DOWN,
    FIRM,
    UP,
    enclosing_span,
    number,
    outward,
    percent,
    with_error,
)

from .quoted import is_quoted
from .sources import Printed, Source, printed

MARK = "†"
"""The mark after each result of a long study; a full run does not compute these results."""
PER_CENT_DIGITS = 2
"""Significant digits of a fraction in per cent."""
FUNCTIONS = (
    "labels",
    "of",
    "span",
    "percent_of",
    "share",
    "range_of",
    "share_span",
    "n",
    "share_of",
    "verdicts",
    "figure_holds",
)
"""The methods of `Numbers` that a template can call."""

SUFFIXES = ("", "_error", "_low", "_high", "_statistical_error", "_varied")
"""Endings of the names of a variable and of its errors."""


class Numbers:
    """Numbers of a run as text: from its datasets, or measured for claims; some in per cent."""

    def __init__(self, results: Results) -> None:
        self.results, self.rows = results, load(results)
        self._claims = {row["name"]: row for row in self.rows}

    def labels(self, name: str, coordinate: str) -> list:
        """Return the labels of a coordinate."""
        return list(self.results[name][coordinate].values)

    def of(self, name: str, variable: str, digits: int = 3, **labels: Any) -> Printed:
        """Return a number with its error or confidence interval, if the dataset has one."""
        data = self._selected(name, variable, labels)
        if f"{variable}_error" in data and f"{variable}_low" not in data:
            value, error = (float(data[f"{variable}{suffix}"]) for suffix in ("", "_error"))
            return self._mark(with_error(value, error, digits), name, variable, labels)
        write = lambda value: number(value, digits)  # noqa: E731
        return self._with_limits(name, variable, labels, digits, write)

    def share(self, name: str, variable: str, **labels: Any) -> Printed:
        """Return a fraction in per cent."""
        return self._with_limits(name, variable, labels, PER_CENT_DIGITS, percent)

    def percent_of(self, name: str, variable: str, **labels: Any) -> Printed:
        """Return a number and its error, both in per cent."""
        data = self._selected(name, variable, labels)
        value, error = (100.0 * float(data[f"{variable}{suffix}"]) for suffix in ("", "_error"))
        return self._mark(f"({with_error(value, error)}){FIRM}%", name, variable, labels)

    def span(self, name: str, variable: str, digits: int = 3) -> Printed:
        """Return the range of a variable over all labels, widened by the errors."""
        limits = self._limits(name, variable, {})
        return self._mark(enclosing_span(*limits, digits), name, variable, {})

    def range_of(
        self, name: str, variable: str, digits: int = 2, definition: str = "", **labels: Any
    ) -> Printed:
        """Return the range of several numbers widened by their errors, such as 6.7 to 7.9.

        Variations of the choice `definition` are left out, because they define another quantity.
        """
        limits = self._limits(name, variable, labels, definition)
        return self._mark(enclosing_span(*limits, digits), name, variable, labels)

    def share_span(self, name: str, variable: str, **labels: Any) -> Printed:
        """Return the range of several fractions in per cent, widened by their errors."""
        low, high = self._limits(name, variable, labels)
        ends = outward(low, PER_CENT_DIGITS, DOWN), outward(high, PER_CENT_DIGITS, UP)
        return self._mark(" to ".join(map(percent, ends)), name, variable, labels)

    def n(self, claim: str, key: str, digits: int = 3) -> Printed:
        """Return a number that decides a claim."""
        return Printed(number(self.measured(claim, key), digits), Source(claim=claim))

    def share_of(self, claim: str, key: str) -> Printed:
        """Return, in per cent, a fraction that decides a claim."""
        return Printed(percent(self.measured(claim, key)), Source(claim=claim))

    def measured(self, claim: str, key: str) -> float:
        """Return a number that was measured for a claim; NaN if there is none."""
        value = self._claims[claim]["measured"].get(key, "nan")
        return float({"none": "nan", "infinite": "inf"}.get(value, value))

    def verdicts(self, figure: int) -> Printed:
        """Return how many of the paper's claims on a figure have each verdict."""
        text = counted_verdicts(on_figure(self.rows, figure))
        return Printed(text, Source(figure=f"fig{figure}"))

    def figure_holds(self, figure: int) -> Printed:
        """Return a phrase on whether the paper's claims on a figure hold."""
        text = whether_it_holds(on_figure(self.rows, figure))
        return Printed(text, Source(figure=f"fig{figure}"))

    def functions(self) -> dict[str, Callable]:
        """Return the functions that a template calls, by name."""
        return {name: getattr(self, name) for name in FUNCTIONS}

    def _selected(self, name: str, variable: str, labels: dict) -> xr.Dataset:
        """Return a variable and its errors at some labels, without all other variables."""
        data = self.results[name]
        if variable not in data.data_vars:
            return data.sel(labels)
        entries = (f"{variable}{suffix}" for suffix in SUFFIXES)
        return data[[entry for entry in entries if entry in data.data_vars]].sel(labels)

    def _limits(
        self, name: str, variable: str, labels: dict, definition: str = ""
    ) -> tuple[float, float]:
        """Return the smallest lower and the largest upper limit of all numbers of a variable."""
        data = self._selected(name, variable, labels)
        value = data[variable]
        if definition:
            error = data[f"{variable}_statistical_error"]
            varied = data[f"{variable}_varied"]
            varies = [not str(label).startswith(definition) for label in data[VARIATION].values]
            varied = varied.isel({VARIATION: varies})
            values = [value - error, value + error, varied]
        elif f"{variable}_low" in data:
            values = [data[f"{variable}_low"], data[f"{variable}_high"]]
        elif f"{variable}_error" in data:
            values = [value - data[f"{variable}_error"], value + data[f"{variable}_error"]]
        else:
            values = [value]
        return min(float(ends.min()) for ends in values), max(float(ends.max()) for ends in values)

    def _with_limits(
        self, name: str, variable: str, labels: dict, digits: int, write: Callable[[float], str]
    ) -> Printed:
        """Return a number and, unless its width is zero, its interval rounded outward."""
        data = self._selected(name, variable, labels)
        value = float(data[variable] if variable in data.variables else data.attrs[variable])
        middle = write(outward(value, digits, DOWN) if variable.endswith("_low") else value)
        ends = [
            write(outward(float(data[f"{variable}{end}"]), digits, direction))
            for end, direction in (("_low", DOWN), ("_high", UP))
            if f"{variable}{end}" in data
        ]
        interval = f" ({' to '.join(ends)})" if set(ends) - {middle} else ""
        if variable in data.data_vars:
            return self._mark(middle + interval, name, variable, labels)
        return Printed(middle + interval, Source(name, attribute=variable))  # a setting

    def _mark(self, text: str, name: str, variable: str, labels: dict) -> Printed:
        """Return a printed result, followed by MARK if it comes from a long study."""
        variable = variable.removesuffix("_low")
        return printed(f"{text}{MARK if is_quoted(name) else ''}", name, variable, labels)
