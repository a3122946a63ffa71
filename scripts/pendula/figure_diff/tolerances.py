"""What may differ from the baseline: a table of rules with reasons, and measured spreads.

The rules stand in one table, tests/baseline/tolerances.yaml, and not in the folders of the studies,
because one chaotic case appears in the files of several studies and the first match counts: only
one list, read from top to bottom, shows which rule wins. A rule says which curves another rounding
moves, and why. How far it moves them is measured: `benchmarks/spreads.py` makes everything many
times over and keeps what it found in tests/baseline/spreads.nc.
"""

import re
from collections.abc import Iterator
from fnmatch import translate
from functools import cache
from pathlib import Path
from typing import Literal, NamedTuple

import numpy as np
import yaml
from pydantic import BaseModel, ConfigDict, Field, ValidationError
from scipy.special import stdtrit

from pendula.datasets.netcdf import read

from .structure import COUNTS, STATISTICS

TOLERANCES, SPREADS = "tolerances.yaml", "spreads.nc"

FALSE_ALARMS = 0.01
"""The chance that one comparison of a whole right reproduction names any curve by mistake. It is
divided by the number of all statistics that are compared (Bonferroni), and holds as far as their
spreads have Student's law; `benchmarks/spreads.py` widens those that have a heavier tail."""

NEEDS_A_REASON = 0.1
"""An allowance above this fraction has to be defended in words (`wide` in the table)."""

MOST_GROWTH = 1000.0
"""By this factor at most may errors of rounding grow. Some residuals are zero in one run of the
ensemble and not in another, so that their measured spreads would allow a factor of a million."""

TOGETHER = "all curves together"
"""In place of the words of a label: the mean of a statistic over all curves of one variable."""


class ToleranceError(ValueError):
    """The tolerances cannot be read; the message names the file and says what to do."""


class _Table(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class Rule(_Table):
    """How to compare the curves whose label (see `compare_curves.curves`) matches a pattern."""

    name: str = Field(min_length=1)
    """What these curves are, for people; spreads.nc refers to it."""
    labels: list[str] = Field(min_length=1)
    method: Literal["pointwise", "chaotic", "size"]
    """`chaotic`: pointwise up to the horizon, by statistics beyond it; `size`: the largest only."""
    reason: str = Field(min_length=1)
    """Why these curves do not keep their points."""
    wide: str = ""
    """Why a statistic may change by more than NEEDS_A_REASON."""
    logs: bool = False
    """Whether the logarithms of the moduli are compared: of errors, whose law has a heavy tail."""
    widest: bool = False
    """Whether each curve may change as the most changeable of its variable does: where a curve
    crosses a threshold early in one run of many, a spread of few runs says nothing."""
    below: float = float("inf")
    """The rule holds only for curves whose largest value is smaller than this."""

    def fits(self, label: str, largest: float) -> bool:
        """Return whether this rule holds for the curve `label` with this largest value."""
        small = largest < self.below or self.below == float("inf")
        return small and _pattern(tuple(self.labels)).match(label) is not None


@cache
def _pattern(labels: tuple[str, ...]) -> re.Pattern:
    return re.compile("|".join(map(translate, labels)))


REGULAR = Rule(
    name="regular",
    labels=["*"],
    method="pointwise",
    reason="regular: other roundings give 1e-9, and the baseline's single precision 6e-8",
)
"""This rule holds for every curve that no rule of the table names."""

REGULAR_LIMIT = 1e-6
"""How far a regular curve may be off, as a fraction of its largest value."""


class _Rules(_Table):
    rules: list[Rule]


def read_rules(baseline: Path) -> list[Rule]:
    """Return the rules in the baseline's folder, then the one for regular curves.

    Without a table every curve counts as regular, which is the strictest comparison. A table that
    cannot be read raises ToleranceError.
    """
    path = baseline / TOLERANCES
    try:
        table = _Rules.model_validate(yaml.load(path.read_text(encoding="utf-8"), yaml.CSafeLoader))
    except FileNotFoundError:
        return [REGULAR]
    except (yaml.YAMLError, ValidationError) as error:
        raise ToleranceError(f"{path} cannot be read; mend these entries:\n{error}") from None
    return [*table.rules, REGULAR]


def rule_for(rules: list[Rule], label: str, largest: float) -> Rule:
    """Return the first of the rules that fits; the last of `read_rules` fits every curve."""
    return next(rule for rule in rules if rule.fits(label, largest))


class Spread(NamedTuple):
    """How right runs differ in one curve: all numbers are those of the curve divided by `scale`."""

    rule: str
    """The name of the rule that held when the spreads were measured."""
    scale: float
    horizon: float
    """Up to this time no two runs differed by a tenth of what regular curves may."""
    allowed: np.ndarray
    """The largest difference of each of STATISTICS between two right runs; NaN: not compared."""
    farthest: np.ndarray
    """The largest value of each of DISTANCES for two right runs; NaN: not compared."""
    copy_of: str
    """The label of a curve that was the same in each run, mostly of another file; or nothing."""

    @property
    def keeps_gaps(self) -> bool:
        """Return whether NaN and infinities stood at the same samples in all runs."""
        return bool((self.allowed[[name in COUNTS for name in STATISTICS]] < 0.5).all())


class Spreads:
    """What the ensemble of whole reproductions allows; a curve without an entry never moved."""

    def __init__(self, entries: dict[str, Spread]):
        """Keep the entries by the labels of their curves."""
        self._entries = entries

    @classmethod
    def of_dataset(cls, data) -> "Spreads":
        """Return what a dataset that `benchmarks/spreads.py` made allows."""
        return cls(_entries(data))

    def bounded(self, rules: list[Rule]) -> "Spreads":
        """Return the same where errors of rounding keep their size up to MOST_GROWTH."""
        sizes = {rule.name for rule in rules if rule.method == "size"}
        most = np.log(MOST_GROWTH)
        return Spreads(
            {
                label: each._replace(allowed=np.minimum(each.allowed, most))
                if each.rule in sizes
                else each
                for label, each in self._entries.items()
            }
        )

    def get(self, label: str) -> Spread | None:
        """Return what is allowed for the curve `label`, or None where no run moved it."""
        return self._entries.get(label)

    def of(self, label: str, rule: Rule) -> Spread | None:
        """Return what is allowed for a curve; a size that never moved may move as the others do."""
        return self.get(label) or (self.get(rule.name) if rule.method == "size" else None)

    def __iter__(self) -> Iterator[Spread]:
        return iter(self._entries.values())


def allowed_change(spread: np.ndarray, freedom: np.ndarray, tests: int) -> np.ndarray:
    """Return how much a statistic of two right runs may differ.

    `spread` is its standard deviation over right runs, known with `freedom` degrees of freedom; the
    difference of two runs has sqrt(2) of it. `tests` such numbers are compared, of either sign.
    """
    return np.sqrt(2) * spread * -stdtrit(freedom, FALSE_ALARMS / tests / 2)


def allowed_distance(
    mean: np.ndarray, spread: np.ndarray, freedom: np.ndarray, tests: int, members: int
) -> np.ndarray:
    """Return how far two right runs may be apart (the logarithm of a distance).

    `mean` and `spread` are those of the distance over all pairs of `members` runs. The distance of
    a new pair differs from that mean by its own chance and by that of the mean.
    """
    return mean + np.sqrt(1 + 1 / members) * spread * -stdtrit(freedom, FALSE_ALARMS / tests)


def _entries(data) -> dict[str, Spread]:
    """Return the entries by label."""
    spread, apart = data["spread"].values, data["apart_spread"].values
    tests = int(np.isfinite(spread).sum() + np.isfinite(apart).sum())
    allowed = allowed_change(spread, data["freedom"].values, tests)
    mean, freedom = data["apart_mean"].values, data["apart_freedom"].values
    farthest = allowed_distance(mean, apart, freedom, tests, data.attrs["members"])
    about = (data[name].values for name in ("rule", "scale", "horizon"))
    columns = (*about, allowed, farthest, data["copy_of"].values)
    return {
        label: Spread(*row)
        for label, row in zip(data["curve"].values, zip(*columns, strict=True), strict=True)
    }


class Tolerances(NamedTuple):
    """The rules, and what was measured."""

    rules: list[Rule]
    spreads: Spreads


def read_tolerances(baseline: Path) -> Tolerances:
    """Return what the baseline's folder allows; without a file of spreads, nothing moves."""
    path = baseline / SPREADS
    spreads = Spreads.of_dataset(read(path)) if path.exists() else Spreads({})
    rules = read_rules(baseline)
    return Tolerances(rules, spreads.bounded(rules))


class Allowance(NamedTuple):
    """What one rule lets one statistic change, as a fraction of it or of the scale of the curve."""

    rule: Rule
    statistic: str
    largest: float
    """Of all curves of the rule."""
    median: float

    @property
    def needs_a_reason(self) -> bool:
        """Return whether the table has to say why so much is allowed."""
        return self.largest > NEEDS_A_REASON


def allowances(rules: list[Rule], spreads: Spreads) -> list[Allowance]:
    """Return for each rule and statistic what its curves may change."""
    found = []
    for rule in rules:
        allowed = np.array([each.allowed for each in spreads if each.rule == rule.name])
        for column, (name, meaning) in enumerate(STATISTICS.items()):
            of_this = allowed[:, column] if allowed.size else allowed
            of_this = of_this[np.isfinite(of_this)]
            if name not in COUNTS and of_this.size:
                is_log = rule.logs or meaning.startswith("log")
                with np.errstate(over="ignore"):
                    fractions = np.expm1(of_this) if is_log else of_this
                found.append(Allowance(rule, name, fractions.max(), float(np.median(fractions))))
    return found
