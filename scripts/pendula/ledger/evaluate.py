"""The claims ledger: every row of `claims` with the verdict that its function computes."""

from collections.abc import Mapping

import numpy as np

from .claims import CLAIMS
from .row import Claim
from .verdicts import Finding, UndecidableError, undecided


def needed() -> list[str]:
    """Return every dataset that the ledger reads, once each, in the order of the rows."""
    return list(dict.fromkeys(name for claim in CLAIMS for name in claim.needs))


def decide(claim: Claim, sources: Mapping) -> Finding:
    """Return the finding of one row; without its datasets it cannot be decided."""
    absent = [name for name in claim.needs if name not in sources]
    if absent:
        return undecided({}, f"{', '.join(absent)} was not made")
    try:
        return claim.decide(*(sources[name] for name in claim.needs))
    except UndecidableError as reason:
        return undecided({}, str(reason))


def evaluate(sources: Mapping) -> list[dict]:
    """Return every row with its verdict, ready for JSON, from {dataset name: opened dataset}."""
    rows = []
    for claim in CLAIMS:
        finding = decide(claim, sources)
        rows.append(
            {
                "name": claim.name,
                "place": claim.place,
                "says": claim.says,
                "decided_by": list(claim.needs),
                "function": f"{claim.decide.__module__.rsplit('.', 1)[-1]}.{claim.decide.__name__}",
                "measured": {k: plain(v) for k, v in finding.measured.items()},
                "tolerance": finding.tolerance,
                "verdict": str(finding.verdict),
                "because": finding.because,
            }
        )
    return rows


def plain(value: float) -> float | str:
    """Return a number as JSON can hold it: six digits, the infinite as a word."""
    return float(f"{value:.6g}") if np.isfinite(value) else "infinite" if value > 0 else "none"
