"""Compares a dataset with that of the baseline, curve by curve, where its bits are not the same.

A variable is split into curves, one for each combination of its named coordinates. Each curve is
compared by the method of the first rule that fits its label. A deviation is counted in units of
what is allowed, so that more than 1 is a fault by any method.
"""

from collections.abc import Callable, Iterator, Mapping
from typing import NamedTuple

import numpy as np
import xarray as xr

from pendula.datasets.netcdf import DatasetError

from . import DIFFERENT, IDENTICAL, NEARLY, Finding
from .structure import DISTANCES, STATISTICS, describe, distances
from .tolerances import REGULAR_LIMIT, TOGETHER, Rule, Spread, Spreads, Tolerances, rule_for

VISIBLE = 1e-4
"""A tenth of a pixel in a panel 900 pixels wide, as a fraction of its height or width."""

SMALLEST = 2.0**-53
"""Where moduli are compared by their logarithms, smaller ones count as this rounding error of 1."""


MOST_OVER = 100.0
"""The logarithm of the largest factor that is counted: no number overflows."""


class Curve(NamedTuple):
    """The values of one variable for one choice of its named coordinates (case, component, ...)."""

    label: str
    values: np.ndarray
    """Any dimensions; that of time is the last."""
    tau: np.ndarray | None
    """The times along the last dimension, or None for values without a time."""

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
    visible: bool = False
    """Whether the curve may have moved so far that a picture shows it."""


SAME = Deviation(0.0, "")


def compare(
    name: str,
    accepted: xr.Dataset,
    made: xr.Dataset,
    tolerances: Tolerances,
    made_too: Callable[[str], xr.Dataset] | None = None,
) -> Finding:
    """Return the finding for the dataset `name`: it names the curve that is off the most.

    `made_too` returns another dataset of the run by its name, so that copies can be compared.
    """
    rules, spreads = tolerances
    stem = name.removesuffix(".nc")
    was, now = ({c.label: c for c in curves(data, stem)} for data in (accepted, made))
    if was.keys() != now.keys():
        return Finding(name, DIFFERENT, _unmatched(was, now))
    found = {}
    for label, curve in was.items():
        rule = rule_for(rules, label, curve.largest)
        found[label] = deviation(curve, now[label], rule, spreads.of(label, rule))
    means = (together(found, rules, spreads) for found in (was, now))
    found |= dict(_together(*means, spreads))
    if made_too is not None:
        found |= _copies(now, spreads, made_too)
    found = {label: each for label, each in found.items() if each != SAME}
    if not found:
        return Finding(name, IDENTICAL)
    worst = max(found, key=lambda label: found[label].excess)
    faults = sum(each.excess > 1 for each in found.values())
    others = f" (and {faults - 1} more curves)" if faults > 1 else ""
    says = f"{worst.partition(':')[2]} {found[worst].says}{others}"
    visible = any(each.visible for each in found.values())
    return Finding(name, DIFFERENT if faults else NEARLY, says, visible)


def curves(data: xr.Dataset, stem: str) -> Iterator[Curve]:
    """Yield every variable, one curve for each combination of its dimensions that hold words.

    A label reads `figures/fig3:l2 amplitude=large component=A`.
    """
    variables = dict(data.variables)
    values = {name: variable.values for name, variable in variables.items()}
    for name, variable in variables.items():
        dims = variable.dims
        words = [dim for dim in dims if dim in values and values[dim].dtype.kind in "UOT"]
        timed, tau = _times(values, [dim for dim in dims if dim not in words])
        others = [dim for dim in dims if dim not in (*words, *timed)]
        array = values[name].transpose([dims.index(dim) for dim in (*words, *others, *timed)])
        for index in np.ndindex(array.shape[: len(words)]):
            chosen = [f"{dim}={values[dim][i]}" for dim, i in zip(words, index, strict=True)]
            yield Curve(" ".join([f"{stem}:{name}", *chosen]), array[index], tau)


def _times(
    values: Mapping[str, np.ndarray], dims: list[str]
) -> tuple[list[str], np.ndarray | None]:
    """Return the first dimension that has times (in a list, or an empty one), and its times."""
    for dim in dims:
        for name in (dim, f"{dim}_tau"):
            if name.endswith("tau") and name in values and values[name].ndim == 1:
                return [dim], values[name]
    return [], None


def _unmatched(was: dict[str, Curve], now: dict[str, Curve]) -> str:
    """Return in words which curves only one of the two datasets has."""
    gone, new = ([x for x in a if x not in b] for a, b in ((was, now), (now, was)))
    said = []
    for labels, verb in ((gone, "is gone"), (new, "is new")):
        if labels:
            more = f" (and {len(labels) - 1} more)" if len(labels) > 1 else ""
            said.append(f"{labels[0].partition(':')[2]} {verb}{more}")
    return ", ".join(said)


def deviation(reference: Curve, new: Curve, rule: Rule, spread: Spread | None) -> Deviation:
    """Return how far `new` is from `reference` under this rule and the measured spread."""
    was, now = reference.values, new.values
    if was.shape != now.shape:
        return Deviation(np.inf, f"has the shape {now.shape} in place of {was.shape}")
    if was.dtype.kind != now.dtype.kind:
        return Deviation(np.inf, "holds values of another type")
    if np.array_equal(was, now, equal_nan=was.dtype.kind == "f"):
        return SAME
    moves = rule.method != "pointwise" and spread is not None
    if was.dtype.kind != "f" and not (moves and was.dtype.kind in "iub"):
        return _exact(was, now)
    if not moves:
        return _gaps(was, now) or _pointwise(reference, new)
    return _chaotic(reference, new, rule, spread)


def _exact(was: np.ndarray, now: np.ndarray) -> Deviation:
    unlike = np.atleast_1d(was != now)
    was, now = np.atleast_1d(was)[unlike][0], np.atleast_1d(now)[unlike][0]
    return Deviation(np.inf, f"is {now!s} in place of {was!s}")


def _gaps(was: np.ndarray, now: np.ndarray) -> Deviation | None:
    """Return a fault unless NaN and both infinities are where they were."""
    finite = np.isfinite(was) & np.isfinite(now)
    if np.array_equal(np.where(finite, 0, was), np.where(finite, 0, now), equal_nan=True):
        return None
    says = "has gaps (NaN or infinity) elsewhere or of another sign"
    return Deviation(np.inf, says, visible=True)


def _pointwise(reference: Curve, new: Curve, until: int | None = None) -> Deviation:
    """Return the largest difference of the first samples, as a fraction of the largest value."""
    was, now = (np.atleast_1d(c.values).astype(float)[..., :until] for c in (reference, new))
    finite = np.isfinite(was)
    difference = _distance(np.where(finite, was, 0), np.where(finite, now, 0))
    if not difference.size:
        return SAME
    place = np.unravel_index(difference.argmax(), difference.shape)
    off = float(difference[place]) / (reference.largest or 1.0)
    tau = "" if reference.tau is None else f" at tau = {reference.tau[place[-1]]:.4g}"
    says = f"is off by {off:.2g} of its scale{tau}, {REGULAR_LIMIT:.2g} is allowed"
    return Deviation(off / REGULAR_LIMIT, says, visible=off > VISIBLE)


def _distance(was: np.ndarray, now: np.ndarray) -> np.ndarray:
    """Return abs(now - was): 0 where both are NaN, infinite where only one of them is a number."""
    with np.errstate(invalid="ignore"):
        apart = abs(now - was)
    same = (was == now) | (np.isnan(was) & np.isnan(now))
    return np.where(same, 0.0, np.where(np.isnan(apart), np.inf, apart))


def _chaotic(reference: Curve, new: Curve, rule: Rule, spread: Spread) -> Deviation:
    """Compare pointwise up to the horizon, and by statistics and distances beyond it."""
    start = trusted(reference, spread.horizon)
    if spread.keeps_gaps and (fault := _gaps(reference.values, new.values)):
        return fault
    was, now = (lines(curve, rule) / spread.scale for curve in (reference, new))
    found = [
        _pointwise(reference, new, start),
        _by_statistics(describe(was, start), describe(now, start), spread),
        _by_distance(distances(was, now, start), spread),
    ]
    return max(found, key=lambda each: each.excess)._replace(visible=True)


def _by_statistics(was: np.ndarray, now: np.ndarray, spread: Spread) -> Deviation:
    """Return the statistic that changed the most, in units of what its spread allows."""
    off = _distance(was, now)
    free = ~np.isfinite(spread.allowed) & np.isfinite(off)
    with np.errstate(invalid="ignore", divide="ignore"):
        excess = np.where(
            free | (off == 0), 0.0, np.where(np.isinf(off), np.inf, off / spread.allowed)
        )
    worst = int(excess.argmax())
    name = list(STATISTICS)[worst]
    says = (
        f"has the {name} {now[worst]:.4g} in place of {was[worst]:.4g} ({STATISTICS[name]}), "
        f"a change by {spread.allowed[worst]:.2g} is allowed"
    )
    return Deviation(float(excess[worst]), says, visible=True)


def _by_distance(apart: np.ndarray, spread: Spread) -> Deviation:
    """Return the distance that is the largest, in units of what two right runs may be apart."""
    over = np.where(np.isfinite(spread.farthest), apart - spread.farthest, -np.inf)
    excess = np.where(np.isnan(over), np.inf, np.exp(np.minimum(over, MOST_OVER)))
    worst = int(excess.argmax())
    says = (
        f"is apart by {np.exp(apart[worst]):.2g} of its scale "
        f"({list(DISTANCES.values())[worst].removeprefix('log of the ')}), "
        f"{np.exp(min(spread.farthest[worst], MOST_OVER)):.2g} is allowed"
    )
    return Deviation(float(excess[worst]), says, visible=True)


def together(found: dict[str, Curve], rules: list[Rule], spreads: Spreads) -> dict[str, np.ndarray]:
    """Return the mean statistics over all chaotic curves of each variable that has several.

    A factor that all curves share stands out of the mean, which scatters less than one curve.
    """
    of_variable: dict[str, list[np.ndarray]] = {}
    for label, curve in found.items():
        if spread := spreads.get(label):
            rule = rule_for(rules, label, curve.largest)
            told = describe(lines(curve, rule) / spread.scale, trusted(curve, spread.horizon))
            of_variable.setdefault(label.partition(" ")[0], []).append(told)
    many = {name: rows for name, rows in of_variable.items() if len(rows) > 1}
    return {f"{name} {TOGETHER}": np.mean(rows, 0) for name, rows in many.items()}


def _together(was: dict[str, np.ndarray], now: dict[str, np.ndarray], spreads: Spreads):
    for label in was.keys() & now.keys():
        if (spread := spreads.get(label)) and not np.array_equal(
            was[label], now[label], equal_nan=True
        ):
            yield label, _by_statistics(was[label], now[label], spread)


def _copies(
    now: dict[str, Curve], spreads: Spreads, made_too: Callable[[str], xr.Dataset]
) -> dict[str, Deviation]:
    """Return the faults of chaotic curves that are the same as another in every right run.

    A figure shows a trajectory that a file of its own holds, so a change of one of them alone is
    found, however small it is beside what chaos changes.
    """
    found, others = {}, {}
    for label, curve in now.items():
        spread = spreads.get(label)
        if spread is None or not spread.copy_of:
            continue
        stem = spread.copy_of.partition(":")[0]
        if stem not in others:
            others[stem] = _curves_of(stem, made_too)
        other = others[stem].get(spread.copy_of)
        if other is not None and not np.array_equal(curve.values, other.values, equal_nan=True):
            says = f"is not the same as {spread.copy_of}, but in a right run it is a copy of it"
            found[label] = Deviation(np.inf, says, visible=True)
    return found


def _curves_of(stem: str, made_too: Callable[[str], xr.Dataset]) -> dict[str, Curve]:
    """Return the curves of another dataset; of one that is missing or damaged, none."""
    try:
        return {each.label: each for each in curves(made_too(f"{stem}.nc"), stem)}
    except DatasetError:
        return {}


def trusted(curve: Curve, horizon: float) -> int:
    """Return how many samples of a curve lie up to the horizon of trust."""
    return 0 if curve.tau is None else int((curve.tau <= horizon).sum())


def lines(curve: Curve, rule: Rule) -> np.ndarray:
    """Return what is compared of a curve, in the shape (row, sample)."""
    values = np.atleast_1d(curve.values).astype(float)
    values = values.reshape(-1, values.shape[-1])
    if rule.method == "size":
        values = np.array([[curve.largest]])
    return np.log(np.maximum(abs(values), SMALLEST)) if rule.logs else values
