"""The chance that another correct run changes a verdict, since chaotic numbers differ between runs.

Correct runs differ in last bits or seeds, and so in each chaotic number. A verdict that changes in
one run of twenty is worthless. Statistical tests therefore use the level `RARE`, and the numbers of
other criteria must be far from their limits.

The distance is measured in several correct runs. A number changes the verdict if its margin to the
limit changes sign. The chance that this happens in one more run follows from Student's t, with the
mean and the scatter of the margin. The chance is zero for a number that is the same in all runs.
"""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from math import sqrt
from typing import NamedTuple

import numpy as np
from latticode.measures.confidence import chance_below

from .criterion import Finding, Verdict
from .cutoff import Cutoff

RARE = Cutoff(1e-5, "the chance of an error of the test: no right run of 10,000 may turn a verdict")
ALLOWED = 1e-4
"""Largest allowed chance that a correct run changes a verdict, or the outcome of a control."""
SAME = 1e-12
"""Relative scatter up to which numbers count as the same, because it is only rounding."""


class Chance(NamedTuple):
    """The chance that one more correct run changes a verdict, and the number most likely to do so.

    `nearest` is the name of this number, empty if no number can change the verdict.
    """

    value: float
    nearest: str = ""


def chance_to_cross(rooms: Sequence[float]) -> float:
    """Return the chance that one more sample has the opposite sign of all samples `rooms`.

    Infinite samples are left out: they come from tests on means without scatter.
    """
    finite = np.abs([room for room in rooms if np.isfinite(room)])
    if len(finite) < 2:
        return 0.0
    mean, scatter = float(finite.mean()), float(finite.std(ddof=1))
    if scatter <= SAME * mean:
        return 0.0
    return chance_below(-mean / (scatter * sqrt(1.0 + 1.0 / len(finite))), len(finite) - 1)


def chance_to_turn(findings: Sequence[Finding]) -> Chance:
    """Return the chance that one more correct run has another verdict than `findings`.

    The verdict on a confirmed or undecided claim changes if any of its numbers crosses its limit.
    The verdict on a contradicted claim changes only if all of its failing numbers do.
    """
    verdicts = Counter(finding.verdict for finding in findings)
    if len(verdicts) > 1:
        (_, most), *_ = verdicts.most_common(1)
        return Chance(1.0 - most / len(findings), "verdicts")
    rooms = [finding.criterion.rooms(finding.measured) for finding in findings if finding.criterion]
    if len(rooms) < len(findings):
        return Chance(0.0)
    series = {name: [rooms_of_run[name] for rooms_of_run in rooms] for name in rooms[0]}
    (verdict,) = verdicts
    failing = set.intersection(
        *(set(finding.criterion.failing(finding.measured)) for finding in findings)
    )
    chances = {name: chance_to_cross(row) for name, row in series.items()}
    if verdict in (Verdict.CONFIRMED, Verdict.CAVEAT, Verdict.UNDECIDED):
        nearest = max(chances, key=chances.get)
        return Chance(min(1.0, sum(chances.values())), nearest if chances[nearest] else "")
    if not failing:
        return Chance(1.0, "different numbers in different runs")
    nearest = min(failing, key=chances.get)
    return Chance(chances[nearest], nearest if chances[nearest] else "")


def chance_of_claim(looks: Sequence[Mapping[str, Finding]], moves: Iterable[str]) -> Chance:
    """Return the chance that a correct run changes the verdict on a claim, its caveat included.

    A confirmed claim gets a caveat if a moved cut-off changes its verdict, so for it the moved
    cut-offs count too. `looks` has the findings of each run by name: "" for unmoved cut-offs, and a
    name in `moves` for a moved cut-off.
    """
    unmoved = chance_to_turn([look[""] for look in looks])
    if any(look[""].verdict != Verdict.CONFIRMED for look in looks):
        return unmoved
    moved = [chance_to_turn([look[move] for look in looks]) for move in moves]
    nearest = max([unmoved, *moved], key=lambda chance: chance.value)
    return Chance(min(1.0, unmoved.value + sum(chance.value for chance in moved)), nearest.nearest)
