"""How a study declares a claim, how its function reads datasets, and the verdicts on all claims."""

import math
from collections.abc import Callable, Mapping
from functools import cache
from typing import NamedTuple

from pendula import studies

from .criterion import Finding, UndecidableError, undecided

# ASSUME: the paper's words for sizes, one measure for each word wherever it stands, so
# that none is fitted to the numbers of one row. "Comparable", "the same level", "no drastic
# difference": within a factor of 2; "grows", "mix up" likewise. "Significantly larger", "large":
# by a factor of 3. "Do not change much", "saturates", "no significant" or "no visible
# difference": by less than 25 %. "Does not change": by less than 2 %; what changes by more than
# that in one direction "decreases". "Nearly monotonic": three of four steps.
FACTOR, MUCH, CHANGE, CONSTANT, NEARLY_ALL = 2.0, 3.0, 0.25, 0.02, 0.75

SETTLED = 10.0
"""The paper takes its statistics from here on: its time windows start at tau = 10."""
FEWEST = 6
"""A sweep with fewer half-widths decides nothing."""


class Claim(NamedTuple):
    """A sentence of the paper, and the function that decides it.

    `needs` names the datasets that decide it: paths below results/ without their ending.
    """

    name: str
    place: str
    says: str
    needs: tuple[str, ...]
    decide: Callable


def claim(place: str, says: str, needs: tuple[str, ...]) -> Callable:
    """Return a decorator: the function, which takes the datasets in `needs`, decides this claim.

    The claim has the name of the function.
    """

    def declare(function: Callable) -> Callable:
        function.claim = Claim(function.__name__, place, says, needs, function)
        return function

    return declare


def _in(folder: str) -> Callable[..., tuple[str, ...]]:
    """Return a function that takes names and returns those of the datasets in a folder."""
    return lambda *names: tuple(f"{folder}/{name}" for name in names)


checks, runs = _in("checks"), _in("trajectories")
sweeps, unbounded = _in("sweeps"), _in("unbounded")
SMALL = runs("fig2_small", "fig3_small", "fig4_small")
LARGE = runs("fig2_large", "fig3_large", "fig4_large")


def late(trajectory, start: float = SETTLED):
    """Return the trajectory from tau = `start` on, which must leave as long a time again."""
    end = float(trajectory["tau"][-1])
    if end < 2.0 * start:
        raise UndecidableError(f"the run ends at tau = {end:g}, before {2.0 * start:g}")
    return trajectory.sel(tau=slice(start, None))


def halves(trajectory):
    """Return the two halves of the late part."""
    settled = late(trajectory)
    middle = 0.5 * (float(settled["tau"][0]) + float(settled["tau"][-1]))
    return settled.sel(tau=slice(None, middle)), settled.sel(tau=slice(middle, None))


def swept(sweep, norm: str, statistic: str, window: str, quantity: str = "pair"):
    """Return the half-widths of a sweep and one statistic of a norm of the pair at each."""
    if window not in sweep["window"].values:
        raise UndecidableError(f"the sweep has no window {window}")
    values = sweep[norm].sel(quantity=quantity, statistic=statistic, window=window).values
    if len(values) < FEWEST:
        raise UndecidableError("the sweep has fewer than six half-widths")
    return sweep["half_width"].values, values


def number(check, name: str, **selection) -> float:
    """Return one number of a check's dataset."""
    return float(check[name].sel(selection).values)


@cache
def all_claims() -> tuple[Claim, ...]:
    """Return the claims of all studies in the order of the paper.

    Each module of claims names the SECTION of the paper with which it begins; modules of one
    section come in the order of the list of studies.
    """
    modules = sorted(studies.all_modules("claims"), key=lambda module: module.SECTION)
    return tuple(
        function.claim
        for module in modules
        for function in vars(module).values()
        if hasattr(function, "claim")
    )


def needed() -> list[str]:
    """Return every dataset that the ledger reads, once each, in the order of the claims."""
    return list(dict.fromkeys(name for claim in all_claims() for name in claim.needs))


def decide(claim: Claim, sources: Mapping) -> Finding:
    """Return the finding of one claim; without its datasets it cannot be decided."""
    absent = [name for name in claim.needs if name not in sources]
    if absent:
        return undecided({}, f"{', '.join(absent)} was not made")
    try:
        return claim.decide(*(sources[name] for name in claim.needs))
    except UndecidableError as reason:
        return undecided({}, str(reason))


def evaluate(sources: Mapping) -> list[dict]:
    """Return every claim with its verdict, ready for JSON, from {dataset name: opened dataset}."""
    return [_row(claim, decide(claim, sources)) for claim in all_claims()]


def _row(claim: Claim, finding: Finding) -> dict:
    home = claim.decide.__module__.removeprefix(f"{studies.__name__}.")
    return {
        "name": claim.name,
        "place": claim.place,
        "says": claim.says,
        "decided_by": list(claim.needs),
        "function": f"{home}.{claim.decide.__name__}",
        "measured": {name: plain(value) for name, value in finding.measured.items()},
        "criterion": str(finding.criterion or ""),
        "verdict": str(finding.verdict),
        "because": finding.because,
    }


def plain(value: float) -> float | str:
    """Return a number as JSON can hold it: six digits, the infinite as a word."""
    return float(f"{value:.6g}") if math.isfinite(value) else "infinite" if value > 0 else "none"
