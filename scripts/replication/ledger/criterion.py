"""Criteria on measured numbers with their text, and the verdicts that follow from them.

A criterion has one limit: its method `holds` compares numbers with it, and `str` prints it. So the
text in the ledger cannot differ from the limit. NaN satisfies no criterion. A verdict is always
computed from a criterion and numbers.
"""

import math
import operator
from abc import ABC, abstractmethod
from collections.abc import Mapping
from enum import StrEnum
from typing import NamedTuple, SupportsFloat

from latticode.numerics.elementary import log

Measured = Mapping[str, float]
RELATIONS = {"<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge}


class Criterion(ABC):
    """An inequality for the numbers `names`; its text has the limits."""

    names: tuple[str, ...]

    @abstractmethod
    def failing(self, measured: Measured) -> list[str]:
        """Return the names of the numbers that violate the criterion."""

    @abstractmethod
    def rooms(self, measured: Measured) -> dict[str, float]:
        """Return by name the distance of each number to its limit; negative beyond the limit."""

    def holds(self, measured: Measured) -> bool:
        """Return whether all numbers satisfy the criterion."""
        return not self.failing(measured)


class Limit(Criterion):
    """A limit for measured numbers: each of `names` must satisfy `number sign limit`.

    The limit is a number or a `Cutoff`. `label` is printed in place of the names.
    """

    sign: str

    def __init__(self, limit: SupportsFloat, *names: str, label: str = "") -> None:
        self.limit, self.names, self.label = float(limit), names, label

    def is_within(self, value: float) -> bool:
        """Return whether a number satisfies the limit."""
        return RELATIONS[self.sign](value, self.limit)

    def failing(self, measured: Measured) -> list[str]:
        return [name for name in self.names if not self.is_within(measured[name])]

    def room(self, value: float) -> float:
        """Return the distance of a number to the limit; negative beyond the limit."""
        return self.limit - value if self.sign[0] == "<" else value - self.limit

    def rooms(self, measured: Measured) -> dict[str, float]:
        return {name: self.room(measured[name]) for name in self.names}

    @property
    def words(self) -> str:
        """The label of the numbers in print."""
        return self.label or ", ".join(map(with_spaces, self.names))

    def __str__(self) -> str:
        return f"{self.words} {self.sign} {limit_as_text(self.limit)}"


class Below(Limit):
    """Each number is less than the limit."""

    sign = "<"


class AtMost(Limit):
    """No number is above the limit."""

    sign = "<="


class Distance(AtMost):
    """No distance is above the limit.

    Beyond the limit, `room` is -log(distance / limit), because large distances differ by factors
    between runs.
    """

    def room(self, value: float) -> float:
        return super().room(value) if value <= self.limit else -float(log(value / self.limit))


class Above(Limit):
    """Each number is greater than the limit."""

    sign = ">"


class AtLeast(Limit):
    """No number is below the limit."""

    sign = ">="


class WithinFactor(Below):
    """Each number is between 1 / limit and the limit. The limit is above one."""

    def is_within(self, value: float) -> bool:
        return 1.0 / self.limit < value < self.limit

    def room(self, value: float) -> float:
        return float(log(self.limit) - abs(log(value))) if value > 0.0 else -math.inf

    def __str__(self) -> str:
        return f"{limit_as_text(1.0 / self.limit)} < {super().__str__()}"


class Near(Limit):
    """Each number differs from `target` by at most the limit."""

    def __init__(self, target: float, limit: SupportsFloat, *names: str, label: str = "") -> None:
        super().__init__(limit, *names, label=label)
        self.target = float(target)

    def is_within(self, value: float) -> bool:
        return abs(value - self.target) <= self.limit

    def room(self, value: float) -> float:
        return self.limit - abs(value - self.target)

    def __str__(self) -> str:
        if self.target == 0.0:
            return f"|{self.words}| <= {limit_as_text(self.limit)}"
        return f"{self.words} within {limit_as_text(self.limit)} of {limit_as_text(self.target)}"


class AllOf(Criterion):
    """Several criteria, all of which must hold."""

    def __init__(self, *criteria: Criterion) -> None:
        self.names = tuple(
            dict.fromkeys(name for criterion in criteria for name in criterion.names)
        )
        self.criteria = criteria

    def failing(self, measured: Measured) -> list[str]:
        return [name for criterion in self.criteria for name in criterion.failing(measured)]

    def rooms(self, measured: Measured) -> dict[str, float]:
        return {
            name: room
            for criterion in self.criteria
            for name, room in criterion.rooms(measured).items()
        }

    def __str__(self) -> str:
        return ", ".join(map(str, self.criteria))


def limit_as_text(number: float) -> str:
    """Return a limit as text: with up to eight digits if exact, else with four; or "infinity"."""
    if math.isinf(number):
        return "infinity"
    texts = (f"{number:.{digits}g}" for digits in range(4, 9))
    return next((text for text in texts if float(text) == number), f"{number:.4g}")


def with_spaces(name: str) -> str:
    """Return the name of a number as words."""
    return name.replace("_over_", " / ").replace("_", " ")


class Verdict(StrEnum):
    """Verdicts on a sentence of the paper.

    If a sentence fails for another model than the paper's, it does "not carry over". If a case was
    run that is not the paper's, the sentence is "not applicable". A conclusion from a figure may be
    true, and yet "not follow" from the figure.
    """

    CONFIRMED = "confirmed"
    CAVEAT = "confirmed with a caveat"
    NOT_REPRODUCED = "not reproduced"
    NOT_CARRIED = "does not carry over"
    NOT_FOLLOWING = "does not follow"
    UNDECIDED = "cannot be decided"
    NOT_APPLICABLE = "not applicable"


REFUTED = (Verdict.NOT_REPRODUCED, Verdict.NOT_CARRIED, Verdict.NOT_FOLLOWING)
"""The verdicts on a sentence that the numbers contradict."""


class UndecidableError(Exception):
    """Data are not sufficient to decide a claim; the message has the reason."""


class Finding(NamedTuple):
    """The verdict on a claim, with the measured numbers, the criterion and the reason."""

    measured: dict[str, float]
    criterion: Criterion | None
    verdict: Verdict
    because: str


def judge(measured: Measured, criterion: Criterion, caveat: str = "", fails: str = "") -> Finding:
    """Return the finding on a claim: confirmed if the criterion holds, else not reproduced.

    With a `caveat` the claim is confirmed with that caveat. `fails` is the reason if the criterion
    does not hold; by default it lists the failing numbers. If all of these are NaN, the claim is
    undecided.
    """
    numbers = {name: float(value) for name, value in measured.items()}
    if off := dict.fromkeys(criterion.failing(numbers)):
        if all(math.isnan(numbers[name]) for name in off):
            unknown = f"unknown: {', '.join(map(with_spaces, off))}"
            return Finding(numbers, criterion, Verdict.UNDECIDED, unknown)
        reasons = ", ".join(f"{with_spaces(name)} is {numbers[name]:.3g}" for name in off)
        return Finding(numbers, criterion, Verdict.NOT_REPRODUCED, fails or reasons)
    verdict = Verdict.CAVEAT if caveat else Verdict.CONFIRMED
    return Finding(numbers, criterion, verdict, caveat)


def undecided(measured: Measured, because: str, criterion: Criterion | None = None) -> Finding:
    """Return the finding on a claim that the measured numbers cannot decide.

    The claim stays undecided while no number crosses its limit in `criterion`.
    """
    numbers = {name: float(value) for name, value in measured.items()}
    return Finding(numbers, criterion, Verdict.UNDECIDED, because)


def not_applicable(because: str) -> Finding:
    """Return the finding on a claim whose case was not run because the configuration differs."""
    return Finding({}, None, Verdict.NOT_APPLICABLE, because)
