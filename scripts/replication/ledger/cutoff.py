"""Cut-offs: numbers that decide a verdict, where each comes from, and what follows if one moves.

The paper says "grows" or "comparable" and gives no number. Who decides such a sentence by numbers
has to choose one, and a verdict that hangs on the choice must say so. So a cut-off is no plain
float: while a claim is decided it notes that it was read, and it can be moved, so that the ledger
can decide the claim again with each of its cut-offs a third smaller and larger.
"""

from collections.abc import Callable, Iterator
from functools import wraps
from typing import Any, NamedTuple

MOVES = (2.0 / 3.0, 4.0 / 3.0)
"""A cut-off is moved by a third either way."""


class Cutoff(NamedTuple):
    """A number that decides, and in words where it comes from.

    `ideal` is the value that the cut-off keeps a distance from, and this distance is what a move
    changes: a share of "at least 0.9" is 0.1 away from the whole, so it moves to 0.87 and 0.93.
    """

    number: float
    origin: str
    ideal: float = 0.0

    @property
    def value(self) -> float:
        """The number that decides now."""
        _read.add(self)
        return self.ideal + _moved.get(self, 1.0) * (self.number - self.ideal)

    def __float__(self) -> float:
        return self.value


_read: set[Cutoff] = set()
_moved: dict[Cutoff, float] = {}


def reading(decide: Callable[[], Any]) -> tuple[Any, set[Cutoff]]:
    """Return what a function returns, and the cut-offs that it reads."""
    before = set(_read)
    _read.clear()
    try:
        return decide(), set(_read)
    finally:
        _read.update(before)


def flips(verdict: str, read: set[Cutoff], verdict_of: Callable[[], str]) -> list[str]:
    """Return which moves of the cut-offs in `read` change the `verdict`, a phrase for each.

    `verdict_of` decides again.
    """
    return [
        f"{moved_verdict} with {value:.3g} instead of {cutoff.number:.3g}"
        for cutoff, value, moved_verdict in each_move(read, verdict_of)
        if moved_verdict != verdict
    ]


def each_move(read: set[Cutoff], decide: Callable[[], Any]) -> Iterator[tuple[Cutoff, float, Any]]:
    """Yield each move of the cut-offs in `read`: the cut-off, its value, what `decide` returns."""
    for cutoff in sorted(read):
        for factor in MOVES:
            _moved[cutoff] = factor
            try:
                moved = cutoff.value, decide()
            finally:
                _moved.clear()
            yield cutoff, *moved


def once(measure: Callable) -> Callable:
    """Let deciding functions measure the same datasets once, however often they decide.

    What reads a cut-off is measured again while this cut-off is moved.
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
                stored[key] = result, read, arguments  # kept too: no other object gets the same id
        _read.update(read)
        return result

    return measured
