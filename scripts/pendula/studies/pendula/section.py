"""The report's part on the pendula: a block for each topic."""

from typing import Any

from pendula.ledger.section import Ledger
from pendula.report.results import Results, Section

from .phases_section import film, phases
from .remainder_section import remainder
from .threshold_section import threshold

HOLD = ("pendula_norms", "same_sea")
"""Claims whose sentences the part on the phases has, where they hold."""


def gather(results: Results, ledger: Ledger) -> dict[str, Any]:
    """Return what each topic of the study tells, by the name of the topic."""
    return {
        "threshold": threshold(results),
        "remainder": remainder(results),
        "phases": phases(results) | {name: ledger.holds(name) for name in HOLD},
        "film": film(results),
    }


SECTIONS = (Section("pendula", "The pendula themselves", gather),)
