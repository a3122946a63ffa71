"""Compares a dataset with that of the baseline, curve by curve.

A variable is split into curves, one for each combination of its named coordinates. Each curve is
compared by the method of the first rule that fits its label. A deviation is counted in units of
what the rule allows, so that more than 1 is a fault by any method.

The rules stand in one table, tests/baseline/tolerances.yaml, and not in the folders of the studies,
because one chaotic case appears in the files of several studies and the first match counts: only
one list, read from top to bottom, shows which rule wins.
"""

from collections.abc import Iterator
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Literal, NamedTuple

import numpy as np
import xarray as xr
import yaml
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from . import DIFFERENT, IDENTICAL, NEARLY, Finding

TOLERANCES = "tolerances.yaml"


class ToleranceError(ValueError):
    """The tolerances cannot be read; the message names the file and says what to do."""


class _Table(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class Bands(_Table):
    """How much statistics of a curve may change beyond the horizon, relatively; None allows all."""

    mean: float | None = Field(None, gt=0)
    standard_deviation: float | None = Field(None, gt=0)
    maximum: float | None = Field(None, gt=0)


class Rule(_Table):
    """How to compare the curves whose label (see `curves`) matches a pattern."""

    labels: list[str] = Field(min_length=1)
    method: Literal["pointwise", "chaotic", "magnitude"]
    """`chaotic` compares pointwise up to the horizon, and by statistics beyond it."""
    limit: float = Field(gt=0)
    """A fraction of the largest value of the curve; for `magnitude`, a number of decades."""
    reason: str = Field(min_length=1)
    horizon: float = 0.0
    """The time tau up to which the curve is compared point by point."""
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
    path = baseline / TOLERANCES
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


VISIBLE = 1e-4
"""A tenth of a pixel in a panel 900 pixels wide, as a fraction of its height or width."""

FLOOR = 1e-12
"""Errors below this count as alike: they are sums of roundings, which have no fixed order."""


class Curve(NamedTuple):
    """The values of one variable for one choice of its named coordinates (case, component, ...)."""

    label: str
    values: np.ndarray
    tau: np.ndarray | None
    """The time of each value in the shape of the values, or None for values without a time."""

    @property
    def largest(self) -> float:
        """Return the largest modulus; words and whole numbers are exact and count as infinite."""
        if self.values.dtype.kind != "f":
            return np.inf
        return float(abs(self.values[np.isfinite(self.values)]).max(initial=0))


class Deviation(NamedTuple):
    """How far a curve is off, in units of what is allowed, and in words."""

    excess: float
    says: str
    moved: bool = False
    """Whether the curve may have moved visibly in an image, although it is within tolerance."""


SAME = Deviation(0.0, "")
WITHIN = Deviation(0.0, "differs, but its statistics are the same", moved=True)


def compare(name: str, accepted: xr.Dataset, made: xr.Dataset, rules: list[Rule]) -> Finding:
    """Return the finding for the dataset `name`: it names the curve that is off the most."""
    stem = name.removesuffix(".nc")
    was, now = ({c.label: c for c in curves(data, stem)} for data in (accepted, made))
    if was.keys() != now.keys():
        return Finding(name, DIFFERENT, _unmatched(was, now))
    compared = {
        label: deviation(was[label], now[label], rule_for(rules, label, was[label].largest))
        for label in was
    }
    found = {label: each for label, each in compared.items() if each != SAME}
    if not found:
        return Finding(name, IDENTICAL)
    worst = max(found, key=lambda label: found[label].excess)
    faults = sum(each.excess > 1 for each in found.values())
    says = _say(worst.partition(":")[2], found[worst], faults)
    moved = any(each.moved for each in found.values())
    return Finding(name, DIFFERENT if faults else NEARLY, says, moved)


def curves(data: xr.Dataset, stem: str) -> Iterator[Curve]:
    """Yield every variable, one curve for each combination of its dimensions that hold words.

    A label reads `figures/fig3:l2 amplitude=large component=A`.
    """
    for name, variable in data.variables.items():
        words = [
            dim for dim in variable.dims if dim in data.coords and data[dim].dtype.kind in "UOT"
        ]
        array = variable.transpose(*words, ...)
        shape = tuple(variable.sizes[dim] for dim in words)
        tau = _times(data, array.dims[len(words) :], array.shape[len(words) :])
        for index in np.ndindex(shape):
            chosen = [f"{d}={data[d].values[i]}" for d, i in zip(words, index, strict=True)]
            yield Curve(" ".join([f"{stem}:{name}", *chosen]), array.values[index], tau)


def _times(data: xr.Dataset, dims: tuple[str, ...], shape: tuple[int, ...]) -> np.ndarray | None:
    """Return the times along the first dimension that has them, in the given shape."""
    for axis, dim in enumerate(dims):
        for name in (dim, f"{dim}_tau"):
            if name.endswith("tau") and name in data.variables and data[name].ndim == 1:
                along = [-1 if place == axis else 1 for place in range(len(dims))]
                return np.broadcast_to(data[name].values.reshape(along), shape)
    return None


def _unmatched(was: dict[str, Curve], now: dict[str, Curve]) -> str:
    """Return in words which curves only one of the two datasets has."""
    gone, new = ([x for x in a if x not in b] for a, b in ((was, now), (now, was)))
    said = []
    for labels, verb in ((gone, "is gone"), (new, "is new")):
        if labels:
            more = f" (and {len(labels) - 1} more)" if len(labels) > 1 else ""
            said.append(f"{labels[0].partition(':')[2]} {verb}{more}")
    return ", ".join(said)


def _say(label: str, found: Deviation, faults: int) -> str:
    others = f" (and {faults - 1} more curves)" if faults > 1 else ""
    allowed = " is allowed" if found != WITHIN and np.isfinite(found.excess) else ""
    return f"{label} {found.says}{allowed}{others}"


def deviation(reference: Curve, new: Curve, rule: Rule) -> Deviation:
    """Return how far `new` is from `reference` under this rule."""
    if reference.values.shape != new.values.shape:
        says = f"has the shape {new.values.shape} in place of {reference.values.shape}"
        return Deviation(np.inf, says)
    if reference.values.dtype.kind != new.values.dtype.kind:
        return Deviation(np.inf, "holds values of another type")
    if reference.values.dtype.kind != "f":
        return _exact(reference.values, new.values)
    if np.array_equal(reference.values, new.values, equal_nan=True):
        return SAME
    if not np.array_equal(*map(_without_finite, (reference.values, new.values)), equal_nan=True):
        return Deviation(np.inf, "has gaps (NaN) or infinities elsewhere")
    return METHODS[rule.method](reference, new, rule)


def _without_finite(values: np.ndarray) -> np.ndarray:
    """Return the values with 0 for every finite one: what is left are gaps and infinities."""
    return np.where(np.isfinite(values), 0, values)


def _exact(reference: np.ndarray, new: np.ndarray) -> Deviation:
    unlike = np.atleast_1d(reference != new)
    if not unlike.any():
        return SAME
    was, now = np.atleast_1d(reference)[unlike][0], np.atleast_1d(new)[unlike][0]
    return Deviation(np.inf, f"is {now!s} in place of {was!s}")


def _pointwise(reference: Curve, new: Curve, rule: Rule) -> Deviation:
    """Return the largest difference, as a fraction of the largest value of the curve."""
    was, now = (np.atleast_1d(c.values).astype(float) for c in (reference, new))
    difference = np.nan_to_num(abs(now - was))
    scale = reference._replace(values=was).largest or 1.0
    place = np.unravel_index(difference.argmax(), difference.shape)
    off = difference[place] / scale
    tau = "" if reference.tau is None else f" at tau = {np.atleast_1d(reference.tau)[place]:.4g}"
    says = f"is off by {off:.2g} of its scale{tau}, {rule.limit:.2g}"
    return Deviation(off / rule.limit, says, moved=off > VISIBLE)


def _chaotic(reference: Curve, new: Curve, rule: Rule) -> Deviation:
    """Compare pointwise up to the horizon, and by statistics beyond it."""
    if reference.tau is None:
        return _by_statistics(reference.values, new.values, rule)
    trusted = reference.tau <= rule.horizon
    early = [Curve(c.label, np.where(trusted, c.values, 0), c.tau) for c in (reference, new)]
    before = _pointwise(*early, rule)
    if before.excess > 1 or trusted.all():
        return before
    beyond = _by_statistics(reference.values[~trusted], new.values[~trusted], rule)
    return max(before, beyond, key=lambda found: found.excess)._replace(moved=True)


def _by_statistics(reference: np.ndarray, new: np.ndarray, rule: Rule) -> Deviation:
    """Compare each statistic that has a band, relative to its value in the reference."""
    found, finite = [], np.isfinite(reference)
    reference, new = reference[finite], new[finite]
    if not reference.size:
        return SAME
    for name, measure in STATISTICS.items():
        band = getattr(rule.bands, name)
        was, now = float(measure(reference)), float(measure(new))
        if band is None or was == now:
            continue
        off = abs(now - was) / (abs(was) or 1.0)
        says = f"has the {name.replace('_', ' ')} {now:.4g} in place of {was:.4g}, {band:.2g} of it"
        found.append(Deviation(off / band, says, moved=True))
    return max(found, default=WITHIN, key=lambda each: each.excess)


def _magnitude(reference: Curve, new: Curve, rule: Rule) -> Deviation:
    """Compare the sizes of errors, as a factor; below the floor all sizes count as alike."""
    was, now = (max(curve.largest, FLOOR) for curve in (reference, new))
    decades = abs(np.log10(now / was))
    says = f"is of size {now:.2g} in place of {was:.2g}, a factor of {10**rule.limit:.2g}"
    return Deviation(decades / rule.limit, says, moved=True)


STATISTICS = {
    "mean": np.mean,
    "standard_deviation": np.std,
    "maximum": lambda values: np.max(abs(values)),
}
METHODS = {"pointwise": _pointwise, "chaotic": _chaotic, "magnitude": _magnitude}
