"""The numbers that an article quotes, each read from a dataset and linked to it."""

from collections.abc import Callable

import xarray as xr

from replication.ledger.rows import Ledger, counted_verdicts, on_figure, whether_it_holds
from replication.report.results import Results
from replication.report.words import (
    DOWN,
    FIRM,
    UP,
    Quote,
    enclosing_span,
    number,
    outward,
    percent,
    with_error,
)
from replication.variables import VARIATION

KEPT = "../tests/baseline"
"""Where committed datasets lie, seen from the article."""
QUOTED = f"{KEPT}/quoted/"
MARK = "†"
"""It follows each result of a long study, which a full run does not make again."""
PER_CENT_DIGITS = 2
"""So many digits has a fraction in per cent."""
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
"""The methods of `Numbers` that a template calls by their names."""


class Numbers:
    """Numbers of a run: `of` datasets, or measured for claims (`n`), also in per cent."""

    def __init__(self, results: Results):
        self.results, self.ledger = results, Ledger(results)

    def labels(self, name: str, coordinate: str) -> list:
        """Return the labels of a coordinate."""
        return list(self.results[name][coordinate].values)

    def of(self, name: str, variable: str, digits: int = 3, **labels) -> Quote:
        """Return a number with what the dataset has of its error; a time may never come."""
        data = self.results[name].sel(labels)
        if f"{variable}_error" in data and f"{variable}_low" not in data:
            value, error = (float(data[f"{variable}{part}"]) for part in ("", "_error"))
            return self.long(name, with_error(value, error, digits))
        return self._say(name, data, variable, digits, lambda value: number(value, digits))

    def span(self, name: str, variable: str, digits: int = 3) -> Quote:
        """Return the range of a number over all its labels, which contains their errors."""
        return self.long(name, enclosing_span(*self._limits(name, variable, {}), digits))

    def percent_of(self, name: str, variable: str, **labels) -> Quote:
        """Return a number with its error in per cent."""
        data = self.results[name].sel(labels)
        value, error = (100.0 * float(data[f"{variable}{part}"]) for part in ("", "_error"))
        return self.long(name, f"({with_error(value, error)}){FIRM}%")

    def share(self, name: str, variable: str, **labels) -> Quote:
        """Return a fraction in per cent."""
        return self._say(name, self.results[name].sel(labels), variable, PER_CENT_DIGITS, percent)

    def range_of(
        self, name: str, variable: str, digits: int = 2, definition: str = "", **labels
    ) -> Quote:
        """Return the range of several numbers with their limits, such as 6.7 to 7.9.

        Variations of `definition` are left out: they measure another thing, printed by itself.
        """
        limits = self._limits(name, variable, labels, definition)
        return self.long(name, enclosing_span(*limits, digits))

    def share_span(self, name: str, variable: str, **labels) -> Quote:
        """Return the range of several fractions with their limits in per cent."""
        low, high = self._limits(name, variable, labels)
        ends = outward(low, PER_CENT_DIGITS, DOWN), outward(high, PER_CENT_DIGITS, UP)
        return self.long(name, " to ".join(map(percent, ends)))

    def _limits(
        self, name: str, variable: str, labels: dict, definition: str = ""
    ) -> tuple[float, float]:
        """Return the least lower and the largest upper limit of all numbers of a variable."""
        data = self.results[name].sel(labels)
        value = data[variable]
        if definition:
            error = data[f"{variable}_statistical_error"]
            again = data[f"{variable}_varied"]
            varies = [not str(label).startswith(definition) for label in data[VARIATION].values]
            again = again.isel({VARIATION: varies})
            values = [value - error, value + error, again]
        elif f"{variable}_low" in data:
            values = [data[f"{variable}_low"], data[f"{variable}_high"]]
        elif f"{variable}_error" in data:
            values = [value - data[f"{variable}_error"], value + data[f"{variable}_error"]]
        else:
            values = [value]
        return min(float(part.min()) for part in values), max(float(part.max()) for part in values)

    def _say(
        self, name: str, data: xr.Dataset, variable: str, digits: int, write: Callable[[float], str]
    ) -> Quote:
        """Return a number with its confidence interval, if this has a width, rounded outward."""
        value = float(data[variable] if variable in data.variables else data.attrs[variable])
        middle = write(outward(value, digits, DOWN) if variable.endswith("_low") else value)
        ends = [
            write(outward(float(data[f"{variable}{end}"]), digits, direction))
            for end, direction in (("_low", DOWN), ("_high", UP))
            if f"{variable}{end}" in data
        ]
        interval = f" ({' to '.join(ends)})" if set(ends) - {middle} else ""
        say = self.long if variable in data.data_vars else self.results.say
        return say(name, middle + interval)

    def long(self, name: str, text: str) -> Quote:
        """Return a result, with a mark if it is of a long study."""
        return self.results.say(name, f"{text}{MARK if name.startswith(QUOTED) else ''}")

    def n(self, claim: str, key: str, digits: int = 3) -> Quote:
        """Return a number that decides a claim."""
        return self.ledger.quote(claim, key, digits)

    def share_of(self, claim: str, key: str) -> Quote:
        """Return the same in per cent."""
        return self.n(claim, key)._replace(text=percent(self.ledger.value(claim, key)))

    def verdicts(self, figure: int) -> str:
        """Return how many of the paper's claims on a figure have each verdict."""
        return counted_verdicts(on_figure(self.ledger.rows, figure))

    def figure_holds(self, figure: int) -> str:
        """Return in words whether what the paper says of a figure holds."""
        return whether_it_holds(on_figure(self.ledger.rows, figure))

    def functions(self) -> dict[str, Callable]:
        """Return the functions that a template calls, by name."""
        return {name: getattr(self, name) for name in FUNCTIONS}
