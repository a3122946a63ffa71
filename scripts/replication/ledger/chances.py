"""How likely another right run turns a verdict: chaos draws other numbers in each of them.

Two right runs differ in last bits or seeds, and so in each number that rests on chaos. A claim
whose verdict one of twenty of them turns has no verdict. So a test that true data fail by chance
takes the level `RARE`, and the numbers of other criteria must lie far from their limits.

How far is measured by several right runs: a number turns where its room within its limit changes
sign, and the chance of that in one more run is that of Student's t, by the mean and the scatter of
its room over the runs. A number that is the same in all runs has no chance of it.
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
"""No larger may be the chance that a right run turns a verdict, or the outcome of a control."""
SAME = 1e-12
"""Numbers that scatter by a smaller part of their mean differ by rounding alone."""


class Chance(NamedTuple):
    """The chance that one more right run turns a verdict, and the number that is nearest to it.

    `nearest` is empty where no number can do so.
    """

    value: float
    nearest: str = ""


def chance_to_cross(rooms: Sequence[float]) -> float:
    """Return the chance that one more draw has another sign than `rooms`, which share theirs.

    Some may be infinite, as that of a test on means without scatter: then the others decide.
    """
    finite = np.abs([room for room in rooms if np.isfinite(room)])
    if len(finite) < 2:
        return 0.0
    mean, scatter = float(finite.mean()), float(finite.std(ddof=1))
    if scatter <= SAME * mean:
        return 0.0
    return chance_below(-mean / (scatter * sqrt(1.0 + 1.0 / len(finite))), len(finite) - 1)


def chance_to_turn(findings: Sequence[Finding]) -> Chance:
    """Return the chance that one more right run comes to another verdict than these, which agree.

    A verdict that holds falls with any of its numbers, and one that the numbers contradict holds
    only if all that fail do. What cannot be decided changes with any number.
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
        return Chance(1.0, "numbers that fail in turn")
    nearest = min(failing, key=chances.get)
    return Chance(chances[nearest], nearest if chances[nearest] else "")


def chance_of_claim(looks: Sequence[Mapping[str, Finding]], moves: Iterable[str]) -> Chance:
    """Return the chance that a right run turns a claim, with its cut-offs and with moved ones.

    Moves count where the verdict is confirmed: it has a caveat if one of them turns it. `looks`
    has the findings of each run, with the cut-offs as "", and by the names of the `moves`.
    """
    unmoved = chance_to_turn([look[""] for look in looks])
    if any(look[""].verdict != Verdict.CONFIRMED for look in looks):
        return unmoved
    moved = [chance_to_turn([look[move] for look in looks]) for move in moves]
    nearest = max([unmoved, *moved], key=lambda chance: chance.value)
    return Chance(min(1.0, unmoved.value + sum(chance.value for chance in moved)), nearest.nearest)
