"""Cut-offs: numbers that decide a verdict, their origins, and the verdicts if one is changed.

The paper writes "grows" or "comparable" without a number. To decide such a sentence we must choose
a number, and the ledger must report whether the verdict depends on the choice. Each cut-off records
that it is read. The ledger then decides the claim again with each of these cut-offs moved: a third
smaller, and a third larger.
"""

from collections.abc import Callable, Iterator
from functools import wraps
from typing import Any, NamedTuple

MOVES = (2.0 / 3.0, 4.0 / 3.0)
"""Factors by which a cut-off is moved."""


class Cutoff(NamedTuple):
    """A number that decides a verdict, and its origin.

    A move changes the distance to `ideal` by a third: a cut-off of 0.9 with the ideal 1 moves to
    0.87 and 0.93.
    """

    number: float
    origin: str
    ideal: float = 0.0

    @property
    def value(self) -> float:
        """The number, or the moved number while the ledger moves it; each access is recorded."""
        _read.add(self)
        return self.ideal + _moved.get(self, 1.0) * (self.number - self.ideal)

    def __float__(self) -> float:
        return self.value


_read: set[Cutoff] = set()
_moved: dict[Cutoff, float] = {}


def reading(decide: Callable[[], Any]) -> tuple[Any, set[Cutoff]]:
    """Return the result of a function, and the cut-offs that it reads."""
    before = set(_read)
    _read.clear()
    try:
        return decide(), set(_read)
    finally:
        _read.update(before)


def flips(verdict: str, read: set[Cutoff], verdict_of: Callable[[], str]) -> list[str]:
    """Return a phrase for each move of the cut-offs in `read` that changes the `verdict`.

    `verdict_of` decides the claim again.
    """
    return [
        f"{moved_verdict} with {value:.3g} instead of {cutoff.number:.3g}"
        for cutoff, value, moved_verdict in each_move(read, verdict_of)
        if moved_verdict != verdict
    ]


def each_move(read: set[Cutoff], decide: Callable[[], Any]) -> Iterator[tuple[Cutoff, float, Any]]:
    """Yield each cut-off in `read` as moved, its moved value, and the result of `decide`."""
    for cutoff in sorted(read):
        for factor in MOVES:
            _moved[cutoff] = factor
            try:
                moved = cutoff.value, decide()
            finally:
                _moved.clear()
            yield cutoff, *moved


def once(measure: Callable) -> Callable:
    """Return `measure` with a cache of its results by arguments.

    While a cut-off is moved, results that depend on it are measured again.
    """
    stored: dict[tuple, tuple] = {}

    @wraps(measure)
    def measured(*arguments: Any) -> Any:
        key = tuple(
            argument if isinstance(argument, str | float | int) else ("", id(argument))
            for argument in arguments
        )
        result, read, _ = stored.get(key, (None, None, ()))
        if read is None or read & _moved.keys():
            result, read = reading(lambda: measure(*arguments))
            if not _moved:
                stored[key] = result, read, arguments  # so that their ids are not reused
        _read.update(read)
        return result

    return measured
