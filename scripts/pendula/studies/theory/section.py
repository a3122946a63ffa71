"""Lemma 1 and Theorems 1 to 3: their pictures, and every number that a check is held to."""

from typing import Any

import numpy as np

from pendula.datasets.checks import broken, deciding
from pendula.ledger.section import Ledger
from pendula.report.numbers import number
from pendula.report.results import Results
from pendula.report.words import symbols


def gather(results: Results, ledger: Ledger, checks: list[str]) -> dict[str, Any]:
    """Return pictures and the table of the checks named in `checks`."""
    rows = [row for name in checks for row in _rows(results, f"checks/{name}")]
    faults = sum(not row["holds"] for row in rows)
    chart = "figures/stability_chart"
    cells = results[chart]["measured"].size + results[chart]["short_measured"].size
    return {
        "rows": [row["cells"] for row in rows],
        "held": len(rows),
        "faults": faults,
        "cells": results.quote(chart, cells, 6),
        "fastest": ledger.quote("stable_below", "fastest"),
        "misclassified": ledger.quote("stable_below", "misclassified"),
        "worst": results.quote("checks/worst", _worst(results)),
        "stability": results.picture("stability_chart", _chart_alt(results, cells)),
        "rates": results.picture("growth_rates", _rates_alt(results)),
        "bounds": results.picture("bounds", _bounds_alt(results)),
    }


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


def _worst(results: Results) -> float:
    return float(results["figures/bounds"]["worst"].max())


def _chart_alt(results: Results, cells: int) -> str:
    data = results["figures/stability_chart"]
    growing = int((data["measured"].values > 0.1 * np.nanmax(data["measured"])).sum())
    return (
        f"Growth rates of tiny data at {cells} pairs of Ω and γ, with the boundaries of the "
        f"infinite chain and of one of {int(data['sites'])} sites; {growing} cells of the larger "
        "chart grow at more than a tenth of the largest rate."
    )


def _rates_alt(results: Results) -> str:
    data = results["figures/growth_rates"]
    apart = float(abs(data["measured"] - data["exact_flow"]).max())
    return (
        f"Measured growth rates against those of the exact linear flow in {data.sizes['cell']} "
        f"cells, at most {number(apart)} apart, and the growth at the threshold."
    )


def _bounds_alt(results: Results) -> str:
    ratios = results["figures/bounds"]["ratio"].values
    return (
        "Observed norms against the bounds of the theorems: the largest P of the paper's cases is "
        f"{number(ratios.min())} to {number(ratios.max())} of its smallest bound."
    )
