"""Cut-offs: numbers that decide a verdict, where each comes from, and what follows if one moves.

The paper says "grows" or "comparable" and gives no number. Who decides such a sentence by numbers
has to choose one, and a verdict that hangs on the choice must say so. So a cut-off is no plain
float: while a claim is decided it records that it was read, and it can be moved for a while, so
that the ledger can decide the claim again with each of its cut-offs a third smaller and larger.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
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
        """The number that decides now: it is recorded as read, and moved where a move is on."""
        read = _read.get()
        if read is not None:
            read.add(self)
        moved, factor = _move.get()
        return self.moved(factor) if moved == self else self.number

    def moved(self, factor: float) -> float:
        """Return the number with its distance from the ideal times `factor`."""
        return self.ideal + factor * (self.number - self.ideal)

    def __float__(self) -> float:
        return self.value


_read: ContextVar[set[Cutoff] | None] = ContextVar("_read", default=None)
_move: ContextVar[tuple[Cutoff | None, float]] = ContextVar("_move", default=(None, 1.0))


@contextmanager
def recorded() -> Iterator[set[Cutoff]]:
    """Give the set of cut-offs that are read while the context lasts."""
    read: set[Cutoff] = set()
    token = _read.set(read)
    try:
        yield read
    finally:
        _read.reset(token)


@contextmanager
def moving(cutoff: Cutoff, factor: float) -> Iterator[None]:
    """Move one cut-off while the context lasts."""
    token = _move.set((cutoff, factor))
    try:
        yield
    finally:
        _move.reset(token)


class Flip(NamedTuple):
    """A verdict that is another one where a cut-off has moved to `value`."""

    cutoff: Cutoff
    value: float
    verdict: str

    def __str__(self) -> str:
        return f"{self.verdict} with {self.value:.3g} instead of {self.cutoff.number:.3g}"


def flips(verdict: str, read: set[Cutoff], verdict_of: Callable[[], str]) -> list[Flip]:
    """Return the moves of the cut-offs that a decision has `read` that change its `verdict`.

    `verdict_of` decides again.
    """
    found = []
    for cutoff in sorted(read):
        for factor in MOVES:
            with moving(cutoff, factor), recorded():
                other = verdict_of()
            if other != verdict:
                found.append(Flip(cutoff, cutoff.moved(factor), other))
    return found


def once(measure: Callable) -> Callable:
    """Let a deciding function measure the same datasets once, however often it decides.

    Datasets are the same if they are one object; words and numbers are if they are equal. What
    reads a cut-off changes as that moves, so it is measured each time while that one is moved.
    """
    kept: dict[tuple, tuple] = {}

    @wraps(measure)
    def measured(*given: Any) -> Any:
        key = tuple(one if isinstance(one, str | float | int) else ("", id(one)) for one in given)
        moved, _ = _move.get()
        found, read, _ = kept.get(key, (None, {moved}, ()))
        if moved in read:
            with recorded() as read:
                found = measure(*given)
            if moved not in read:
                kept[key] = found, read, given  # kept too: no other object gets the same id
        for cutoff in read:
            _ = cutoff.value  # the decision has read it too
        return found

    return measured
