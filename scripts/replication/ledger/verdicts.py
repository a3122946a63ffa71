"""The verdict on each claim, with the outcomes of its controls."""

import math
from collections.abc import Iterable, Mapping
from typing import Any

from replication.differences import NO_DIFFERENCES, Differences

from .claim import Claim, ClaimControl, Wrong
from .criterion import REFUTED, Finding, UndecidableError, Verdict, not_applicable, undecided
from .cutoff import each_move, flips, reading
from .missing import missing


def needed(claims: Iterable[Claim]) -> list[str]:
    """Return the names of all datasets that claims and their controls read, in order of use."""
    names: list[str] = []
    for claim in claims:
        names += claim.needs
        names += [name for control in claim.controls for name in control.names]
    return list(dict.fromkeys(names))


def decide(claim: Claim, sources: Mapping) -> Finding:
    """Return the finding on a claim, undecided if one of its datasets is missing."""
    absent = [name for name in claim.needs if name not in sources]
    if absent:
        return undecided({}, f"{', '.join(absent)} was not made")
    try:
        finding = claim.decide(*(sources[name] for name in claim.needs))
    except UndecidableError as reason:
        return undecided({}, str(reason))
    if finding.verdict in REFUTED:
        return finding._replace(verdict=claim.refuted)
    lacking = missing(claim.needs, sources, claim.on) if confirmed(finding) else ""
    return undecided(finding.measured, lacking) if lacking else finding


def feed(claim: Claim, control: ClaimControl, sources: Mapping) -> Finding:
    """Return the finding of the claim's function on the datasets of a control."""
    absent = [name for name in (*claim.needs, *control.names) if name not in sources]
    if absent:
        return undecided({}, f"{', '.join(absent)} was not made")

    def replace(name: str, wrong: Wrong) -> Any:
        if isinstance(wrong, str):
            return sources[wrong]
        if isinstance(wrong, tuple):
            source, change = wrong
            return change(sources[name], sources[source])
        return wrong(sources[name])

    try:
        fed = {name: replace(name, wrong) for name, wrong in control.fed.items()}
    except UndecidableError as reason:
        return undecided({}, str(reason))
    return decide(claim, {**sources, **fed})


def look(claim: Claim, sources: Mapping) -> dict[str, Finding]:
    """Return all findings on a claim by name: unchanged, with moved cut-offs, and of controls.

    The name is "" if nothing is changed. For a moved cut-off it is the value with the origin, for a
    control its description.
    """
    finding, cutoffs = reading(lambda: decide(claim, sources))
    moves = {
        f"{value:.4g} instead of {cutoff.number:.4g} ({cutoff.origin})": finding_when_moved
        for cutoff, value, finding_when_moved in each_move(cutoffs, lambda: decide(claim, sources))
    }
    controls = {control.description: feed(claim, control, sources) for control in claim.controls}
    return {"": finding} | moves | controls


def passes(control: ClaimControl, finding: Finding) -> bool | None:
    """Return whether a control has the required outcome, None if it is not applicable.

    A rejection counts only if it rests on numbers: missing data or NaN would reject every claim.
    """
    if finding.verdict == Verdict.NOT_APPLICABLE:
        return None
    if control.confirms:
        return confirmed(finding)
    judged = finding.criterion.names if finding.criterion else ()
    known = not any(math.isnan(finding.measured[name]) for name in judged)
    return finding.verdict in REFUTED and known


def confirmed(finding: Finding) -> bool:
    """Return whether a claim is confirmed, with a caveat or without."""
    return finding.verdict in (Verdict.CONFIRMED, Verdict.CAVEAT)


def why_not_applicable(
    differences: Differences, claim: Claim, control: ClaimControl | None = None
) -> str:
    """Return why a claim or its control is not applicable; empty if it is applicable."""
    of_claim = differences.reason(claim.needs, claim.on)
    if of_claim or control is None:
        return of_claim
    of_same = differences.reason(claim.needs, control.on) if control.on else ""
    return of_same or differences.reason(control.names, control.on)


def evaluate(
    claims: Iterable[Claim], sources: Mapping, differences: Differences = NO_DIFFERENCES
) -> list[dict]:
    """Return a row for each claim with its verdict, ready for JSON; `sources` are datasets by name.

    A row lists the cut-offs that change the verdict if moved by a third. If a control has the wrong
    outcome, the claim is undecided. A claim or a control that depends on a key with `differences`
    from the paper's configuration is not applicable.
    """
    return [_row(claim, sources, differences) for claim in claims]


def _row(claim: Claim, sources: Mapping, differences: Differences) -> dict:
    why = why_not_applicable(differences, claim)
    if why:
        finding, cutoffs, moved = not_applicable(why), set(), []
    else:
        finding, cutoffs = reading(lambda: decide(claim, sources))
        moved = flips(finding.verdict, cutoffs, lambda: str(decide(claim, sources).verdict))
    controls = [
        (control, not_applicable(why) if why else feed(claim, control, sources))
        for control in claim.controls
        for why in (why_not_applicable(differences, claim, control),)
    ]
    finding = _severe(finding, moved, controls)
    return {
        "name": claim.name,
        "section": claim.section,
        "place": claim.place,
        "origin": str(claim.origin),
        "says": claim.statement,
        "kind": str(claim.kind),
        "decided_by": list(claim.needs),
        "function": f"{claim.decide.__module__}.{claim.name}",
        "measured": {name: as_json(value) for name, value in finding.measured.items()},
        "criterion": str(finding.criterion or ""),
        "verdict": str(finding.verdict),
        "because": finding.because,
        "cutoffs": [
            {"value": as_json(cutoff.number), "from": cutoff.origin} for cutoff in sorted(cutoffs)
        ],
        "rests_on": moved,
        "controls": [
            {
                "fed": control.description,
                "must": control.must,
                "verdict": str(fed.verdict),
                "because": fed.because,
                "passes": passes(control, fed),
            }
            for control, fed in controls
        ],
    }


def _severe(
    finding: Finding, moved: list[str], controls: list[tuple[ClaimControl, Finding]]
) -> Finding:
    """Return the finding: undecided if a control fails, with a caveat if a cut-off changes it."""
    failed = next(((c, fed) for c, fed in controls if passes(c, fed) is False), None)
    if failed is not None and finding.verdict != Verdict.UNDECIDED:
        control, fed = failed
        wrong = f"{control.description}: must {control.must}, found: {fed.verdict}"
        return undecided(finding.measured, f"its function fails a control: {wrong}")
    if not moved:
        return finding
    rests = f"depends on the cut-off: {'; '.join(moved)}"
    because = f"{finding.because}; {rests}" if finding.because else rests
    verdict = Verdict.CAVEAT if finding.verdict == Verdict.CONFIRMED else finding.verdict
    return finding._replace(because=because, verdict=verdict)


def as_json(value: float) -> float | str:
    """Return a number for JSON: to six digits if it is finite, else "infinite" or "none"."""
    return float(f"{value:.6g}") if math.isfinite(value) else "infinite" if value > 0 else "none"
