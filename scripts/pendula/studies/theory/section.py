"""The report's part on the theory: Lemma 1, Theorems 1 to 3, and every checked number."""

from typing import Any

import numpy as np

from pendula.datasets.checks import broken, deciding
from pendula.ledger.section import Ledger
from pendula.report.results import Results, Section, Table
from pendula.report.words import NORMS, number, symbols, told

from .settings import GROUPS, OBSERVED

CHECKS = [*(name for group in GROUPS.values() for name in group), *OBSERVED]
CHARTS = ("checks/chart", "checks/short_chart")
SHARPNESS, THRESHOLD = "checks/sharpness", "checks/threshold"
FORMS = {
    "theorem_1": "Theorem 1 (by the energy)",
    "theorem_2": "Theorem 2 (by the energy)",
    "theorem_2_ball": "Theorem 2 (C₀δ)",
    "theorem_3": "Theorem 3",
}
"""The bounds by form, as the report names them."""


def gather(results: Results, ledger: Ledger) -> dict[str, Any]:
    """Return the pictures, and tables of exponents, of bounds, and of all checked numbers."""
    rows = [row for name in CHECKS for row in _checked(results, f"checks/{name}")]
    faults = sum(row[3] == "no" for row in rows)
    found, ratios = results[THRESHOLD]["spreading_exponent"].mean("omega"), results[SHARPNESS]
    sites = ratios["sites"].values[[0, -1]]
    return {
        "stability_chart": results.figure("stability_chart", told(
            "Where the chain at rest is unstable: growth rates measured from tiny initial "
            "conditions at {cells} pairs of Ω and γ, the boundaries of the infinite chain and of a "
            "finite one, and the cases that are run.",
            cells=results.quote(CHARTS[0], sum(results[one]["measured"].size for one in CHARTS), 6),
        )),
        "growth_rates": results.figure("growth_rates",
            "Growth rates against those of the exact linear flow, and growth at the threshold."),
        "exponents": Table(
            "Exponents of τ exactly at the threshold, for initial conditions (1 + |n|)⁻ˢ",
            ("s", *NORMS.values()),
            [["one site" if np.isinf(decay) else number(decay),
              *(results.quote(THRESHOLD, float(found.sel(decay=decay, norm=n)), 2) for n in NORMS)]
             for decay in found["decay"].values],
        ),
        "bounds": results.figure("bounds", told(
            "Theorems 1 to 3: what was observed against what they allow. For C₀δ of Theorem 2 the "
            "paper gives no C₀: the inequality of its proof gives {limit} for tiny initial "
            "conditions, and these need {least}.",
            **{one: results.quote(SHARPNESS, float(ratios[f"{one}_constant"]))
               for one in ("limit", "least")},
        )),
        "reached": Table(
            "Part of the bounds that is reached",
            ("bound", *(f"on {number(n)} sites" for n in sites)),
            [[words, *(results.quote(SHARPNESS, float(ratios["reached"].sel(form=form, sites=n)), 4)
                       for n in sites)] for form, words in FORMS.items()],
        ),
        "checks": Table(
            f"{len(rows)} numbers with a tolerance, {faults} of them above it",
            ("quantity", "largest", "tolerance", "holds", "dataset"), rows, folded=True,
        ),
    }  # fmt: skip


def _checked(results: Results, name: str) -> list[list]:
    """Return a row for each number of a check that has a tolerance."""
    check = results[name].to_dict()
    faults = broken(check)
    return [
        [
            symbols(check["data_vars"][variable]["attrs"]["long_name"]),
            results.quote(name, largest),
            results.quote(name, limit),
            "no" if variable in faults else "yes",
            results.say(name, name),
        ]
        for variable, (largest, limit) in deciding(check).items()
    ]


SECTIONS = (Section("theory", "Stability and bounds", gather),)
