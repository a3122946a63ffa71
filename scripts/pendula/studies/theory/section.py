"""The report's part on the theory: errata, Lemma 1, Theorems 1 to 3, and every checked number."""

from typing import Any

import numpy as np

from pendula.datasets.checks import broken, deciding
from pendula.ledger.claim import Origin
from pendula.ledger.criterion import Verdict
from pendula.ledger.section import Ledger, load
from pendula.problem import write_initial
from pendula.report.results import Results, Section
from pendula.report.words import Quote, case_in_words, number, symbols

from .settings import GROUPS, OBSERVED

CHECKS = [*(name for group in GROUPS.values() for name in group), *OBSERVED]
CHARTS = ("checks/chart", "checks/short_chart")


def gather_errata(results: Results, ledger: Ledger) -> dict[str, Any]:
    """Return the errors found by the checks, and the paper's claims that are not reproduced."""
    return {
        "constant": _constant(results),
        "time": {
            "printed": ledger.quote("slow_time", "order_without_the_half", 2),
            "right": ledger.quote("slow_time", "order", 2),
            "known": bool(np.isfinite(ledger.value("slow_time", "order"))),
        },
        "case": _case(results),
        "bootstrap": _bootstrap(results, ledger),
        "captions": [
            (n, ledger.because(f"fig{n}_caption") or ledger.verdict(f"fig{n}_caption"))
            for n in (5, 6)
        ],
        "missed": _missed(results),
    }


def _bootstrap(results: Results, ledger: Ledger) -> dict[str, Any]:
    source = "checks/bootstrap"
    check = results[source]
    numbers = ("allowed_power", "breaking", "barrier_power")
    quoted = {name: results.quote(source, float(check[name])) for name in numbers}
    return quoted | {"verdict": ledger.verdict("bootstrap")}


def _constant(results: Results) -> dict[str, Any]:
    source = "checks/theorem_3_constant"
    check = results[source]
    printed, corrected = (float(check[name].min()) for name in ("printed", "corrected"))
    return {
        "sites": results.quote(source, int(check["smallest"])),
        "printed": results.quote(source, printed),
        "corrected": results.quote(source, corrected),
        "fails": printed < 0 <= corrected,
    }


def _case(results: Results) -> dict[str, Any]:
    source = "checks/theorem_2_case"
    check = results[source]
    numbers = ("start", "delta_0", "depth", "barrier", "widened_delta_0", "widened_bound")
    given = results.settings["theory"]["theorem_2_case"]
    initial = write_initial({0: tuple(map(complex, given["pair"]))})
    return {
        "name": case_in_words(given["constants"]["omega"], initial),
        "of_paper": not results.apart(source),
        "shallow": bool(check["depth"] < check["barrier"]),
        "covered": bool(check["start"] <= check["delta_0"]),
        "covered_widened": bool(check["start"] <= check["widened_delta_0"]),
        **{name: results.quote(source, float(check[name]), 4) for name in numbers},
    }


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
        if (row["verdict"], row["origin"]) == (Verdict.NOT_REPRODUCED, Origin.PAPER)
    ]


def gather_theory(results: Results, ledger: Ledger) -> dict[str, Any]:
    """Return the pictures, and the table of the numbers that the checks are held to."""
    rows = [row for name in CHECKS for row in _rows(results, f"checks/{name}")]
    faults = sum(not row["holds"] for row in rows)
    cells = sum(results[chart]["measured"].size for chart in CHARTS)
    return {
        "rows": [row["cells"] for row in rows],
        "held": len(rows),
        "faults": faults,
        "cells": results.quote(CHARTS[0], cells, 6),
        "unsorted": ledger.because("stable_below"),
        "fastest": ledger.quote("stable_below", "fastest"),
        "misclassified": ledger.quote("stable_below", "misclassified"),
        "reached": _reached(results),
        "least": _constant_of(results, "least_constant"),
        "limit": _constant_of(results, "limit_constant"),
        "exponents": _exponents(results),
        "stability": results.picture("stability_chart", _chart_alt(results, cells)),
        "rates": results.picture("growth_rates", _rates_alt(results)),
        "bounds": results.picture("bounds", _bounds_alt(results)),
    }


FORMS = {
    "theorem_1": "Theorem 1 (by the energy)",
    "theorem_2": "Theorem 2 (by the energy)",
    "theorem_2_ball": "Theorem 2 (C₀δ)",
    "theorem_3": "Theorem 3",
}
"""The bounds by form, as the report names them."""


def _reached(results: Results) -> list[list]:
    """Return the rows of a table: a form of the bounds, and what part of it is reached."""
    source = "checks/sharpness"
    ratios = results[source]["reached"]
    sites = ratios["sites"].values[[0, -1]]
    return [
        [words, *(results.quote(source, float(ratios.sel(form=form, sites=n)), 4) for n in sites)]
        for form, words in FORMS.items()
    ]


def _constant_of(results: Results, name: str) -> Quote:
    return results.quote("checks/sharpness", float(results["checks/sharpness"][name]))


def _exponents(results: Results) -> list[list]:
    """Return the rows of a table: how data decay, and the measured exponents of their growth."""
    source = "checks/threshold"
    found = results[source]["spreading_exponent"].mean("omega")
    return [
        [
            "one site" if np.isinf(decay) else number(decay),
            *(results.quote(source, float(found.sel(decay=decay, norm=n)), 2) for n in NORMS),
        ]
        for decay in found["decay"].values
    ]


NORMS = ("l2", "linf")


def _rows(results: Results, name: str) -> list[dict]:
    check = results[name].to_dict()
    faults = broken(check)
    return [
        {
            "holds": variable not in faults,
            "cells": [
                symbols(check["data_vars"][variable]["attrs"]["long_name"]),
                results.quote(name, largest),
                results.quote(name, limit),
                "no" if variable in faults else "yes",
                results.say(name, name),
            ],
        }
        for variable, (largest, limit) in deciding(check).items()
    ]


def _chart_alt(results: Results, cells: int) -> str:
    data = results[CHARTS[0]]
    growing = int((data["measured"].values > 0.1 * np.nanmax(data["measured"])).sum())
    return (
        f"Growth rates of tiny data at {cells} pairs of Ω and γ, with the boundaries of the "
        f"infinite chain and of one of {int(data['sites'])} sites; {growing} cells of the larger "
        "chart grow at more than a tenth of the largest rate."
    )


def _rates_alt(results: Results) -> str:
    charts = [results[name] for name in CHARTS]
    apart = max(float(abs(one["measured"] - one["exact_flow"]).max()) for one in charts)
    cells = sum(one["measured"].size for one in charts)
    return (
        f"Measured growth rates against those of the exact linear flow in {cells} "
        f"cells, at most {number(apart)} apart, and the growth at the threshold."
    )


def _bounds_alt(results: Results) -> str:
    ratios = results["checks/cases"]["ratio"].values
    return (
        "Observed norms against the bounds of the theorems: the largest P of the cases is "
        f"{number(ratios.min())} to {number(ratios.max())} of its smallest bound."
    )


SECTIONS = (
    Section("errata", "Errata, and claims that are not reproduced", gather_errata),
    Section("theory", "Stability and bounds", gather_theory),
)
