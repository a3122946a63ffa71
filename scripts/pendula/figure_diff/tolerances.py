"""Reads the tolerances of the comparison from the baseline, and finds the rule for a curve.

The rules stand in one table, tests/baseline/tolerances.yaml, and not in the folders of the studies,
because one chaotic case appears in the files of several studies and the first match counts: only
one list, read from top to bottom, shows which rule wins.
"""

from fnmatch import fnmatchcase
from pathlib import Path
from typing import Literal

import yaml
from pydantic import BaseModel, ConfigDict, Field, ValidationError

FILE = "tolerances.yaml"


class ToleranceError(ValueError):
    """Tolerances that cannot be read; the message names the file and the way out."""


class _Table(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class Bands(_Table):
    """How far the statistics of a curve may move beyond the horizon, relative; None allows all."""

    mean: float | None = Field(None, gt=0)
    standard_deviation: float | None = Field(None, gt=0)
    maximum: float | None = Field(None, gt=0)


class Rule(_Table):
    """How to compare the curves whose label (see `compare_data.curves`) matches a pattern."""

    labels: list[str] = Field(min_length=1)
    method: Literal["pointwise", "chaotic", "magnitude"]
    """`chaotic` compares pointwise up to the horizon, and by statistics beyond it."""
    limit: float = Field(gt=0)
    """A fraction of the largest value of the curve; for `magnitude`, a number of decades."""
    reason: str = Field(min_length=1)
    horizon: float = 0.0
    """In units of tau."""
    bands: Bands = Bands()
    below: float = float("inf")
    """The rule holds only for curves whose largest value is smaller than this."""

    def fits(self, label: str, largest: float) -> bool:
        """Return whether this rule holds for the curve `label` with this largest value."""
        small = largest < self.below or self.below == float("inf")
        return small and any(fnmatchcase(label, pattern) for pattern in self.labels)


REGULAR = Rule(
    labels=["*"],
    method="pointwise",
    limit=1e-6,
    reason="regular: other roundings give 1e-9, and the baseline's single precision 6e-8",
)
"""This rule holds for every curve that no rule of the table names."""


class _Rules(_Table):
    bands: dict[str, Bands] = {}
    """Only for YAML anchors: the rules refer to them."""
    horizons: dict[str, float] = {}
    rules: list[Rule]


def read_rules(baseline: Path) -> list[Rule]:
    """Return the rules in the baseline's folder, then the one for regular curves.

    Without a table every curve counts as regular, which is the strictest comparison. A table that
    cannot be read raises ToleranceError.
    """
    path = baseline / FILE
    try:
        table = _Rules.model_validate(yaml.safe_load(path.read_text(encoding="utf-8")))
    except FileNotFoundError:
        return [REGULAR]
    except (yaml.YAMLError, ValidationError) as error:
        raise ToleranceError(f"{path} cannot be read; mend these entries:\n{error}") from None
    return [*table.rules, REGULAR]


def rule_for(rules: list[Rule], label: str, largest: float) -> Rule:
    """Return the first of the rules that fits; the last of `read_rules` fits every curve."""
    return next(rule for rule in rules if rule.fits(label, largest))
