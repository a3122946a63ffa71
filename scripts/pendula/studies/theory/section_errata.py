"""Where the paper errs or leaves a gap, each with the numbers that show it."""

from typing import Any

from pendula.ledger.section import Ledger, load
from pendula.report.results import Results
from pendula.report.words import case_in_words, symbols


def gather(results: Results, ledger: Ledger) -> dict[str, Any]:
    """Return the errors found by the checks, and all that the ledger could not reproduce."""
    return {
        "constant": _constant(results),
        "time": _time(ledger),
        "case": _case(results),
        "depth": results.quote("checks/negative_depth", _first_negative(results)),
        "captions": [(n, ledger.verdict(f"fig{n}_caption")) for n in (5, 6)],
        "caption": ledger.because("fig5_caption"),
        "missed": _missed(results),
    }


def _constant(results: Results) -> dict[str, Any]:
    source = "checks/theorem_3_constant"
    check = results[source]
    return {
        "sites": results.quote(source, int(check["smallest"])),
        "printed": results.quote(source, float(check["printed"].min())),
        "corrected": results.quote(source, float(check["corrected"].min())),
        "fails": float(check["printed"].min()) < 0 <= float(check["corrected"].min()),
    }


def _time(ledger: Ledger) -> dict[str, Any]:
    return {
        "printed": ledger.quote("printed_time", "order", 2),
        "right": ledger.quote("slow_time", "order", 2),
        "verdict": ledger.verdict("printed_time"),
    }


def _case(results: Results) -> dict[str, Any]:
    source = "checks/theorem_2_case"
    check = results[source]
    numbers = ("start", "delta_0", "depth", "barrier", "widened_delta_0", "widened_bound")
    case = results["checks/cases"].sel(case="fig3_small")
    return {
        "name": case_in_words(float(case["omega"]), str(case["initial"].values)),
        "shallow": bool(check["depth"] < check["barrier"]),
        "covered": bool(check["start"] <= check["delta_0"]),
        "covered_widened": bool(check["start"] <= check["widened_delta_0"]),
        **{name: results.quote(source, float(check[name]), 4) for name in numbers},
    }


def _first_negative(results: Results) -> float:
    return float(results["checks/negative_depth"]["first_negative"])


def _missed(results: Results) -> list[dict]:
    return [
        {
            "name": row["name"],
            "place": row["place"],
            "says": symbols(row["says"]),
            "because": symbols(row["because"]),
            "data": [results.say(name, name) for name in row["decided_by"]],
        }
        for row in load(results)
        if row["verdict"] == "not reproduced"
    ]
