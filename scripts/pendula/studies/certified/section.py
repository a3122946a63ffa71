"""The report's part on proofs: how far computed curves can be from the true ones."""

from typing import Any

from pendula.ledger.section import Ledger
from pendula.report.results import Results, Section
from pendula.report.words import case_in_words, number


def gather(results: Results, ledger: Ledger) -> dict[str, Any]:
    """Return what is proved, topic by topic."""
    return {"curves": _curves(results)}


def _curves(results: Results) -> dict[str, Any]:
    cases = results.settings["certified"]["curves"]["cases"]
    return {
        "head": ["case", "until τ =", "proven bound", "largest distance to the reference"],
        "rows": [_curve(results, f"certified/{case}") for case in cases],
    }


def _curve(results: Results, name: str) -> list:
    one = results[name]
    return [
        case_in_words(one.attrs["omega"], one.attrs["initial"]),
        number(float(one["tau"][-1])),
        results.quote(name, float(one["bound"].max())),
        results.quote(name, float(one["reference_distance"].max())),
    ]


SECTIONS = (Section("certified", "Numbers with a proof", gather),)
