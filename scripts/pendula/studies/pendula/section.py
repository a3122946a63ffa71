"""The report's part on the pendula: a block for each topic."""

from typing import Any

from pendula.ledger.section import Ledger
from pendula.report.results import Results, Section

from .phases_section import film, phases
from .remainder_section import remainder
from .threshold_section import threshold


def gather(results: Results, ledger: Ledger) -> dict[str, Any]:
    """Return what each topic of the study tells, by the name of the topic."""
    return {
        "threshold": threshold(results),
        "remainder": remainder(results),
        "phases": phases(results),
        "film": film(results),
    }


SECTIONS = (Section("pendula", "The pendula themselves", gather),)
