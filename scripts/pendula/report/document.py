"""The whole report: every section gathered from the results, put into the template."""

from pendula.ledger import section as claims
from pendula.studies.chaos import section as chaos
from pendula.studies.chaos import section_pictures as chaos_pictures
from pendula.studies.hard_cases import section as hard_cases
from pendula.studies.paper import (
    section_motion as motion,
)
from pendula.studies.paper import (
    section_norms as norms,
)
from pendula.studies.paper import (
    section_solvers as solvers,
)
from pendula.studies.paper import (
    section_sweeps as sweeps,
)
from pendula.studies.theory import section as theory
from pendula.studies.theory import section_errata as errata
from pendula.studies.unbounded import section as growth

from . import page, provenance, speed
from .results import Results

CONTENTS = {
    "figures": "The figures",
    "motion": "The chain in motion",
    "claims": "What the paper says",
    "errata": "Errata",
    "theory": "Stability and bounds",
    "chaos": "What can be trusted",
    "growth": "Growth without bound",
    "solvers": "The paper's solvers",
    "speed": "Speed against error",
    "hard_cases": "Hard cases",
    "provenance": "How it was run",
}
"""The sections in their order: the names of their templates, and their titles."""


def write(results: Results, checks: list[str], measured: speed.Measured, made: dict) -> str:
    """Return the report as HTML.

    `checks` names the checks of the theory, `measured` where speed was measured, and `made` holds
    what `provenance.gather` takes.
    """
    ledger = claims.Ledger(results)
    values = {
        "chain": norms.chain(results),
        "norms": norms.gather(results),
        "sweeps": sweeps.gather(results),
        "motion": motion.gather(results),
        "claims": claims.gather(results),
        "errata": errata.gather(results, ledger),
        "theory": theory.gather(results, ledger, checks),
        "chaos": chaos.gather(results) | {"pictures": chaos_pictures.gather(results)},
        "growth": growth.gather(results, ledger),
        "solvers": solvers.gather(results),
        "speed": speed.gather(results, measured),
        "hard_cases": hard_cases.gather(results),
        "provenance": provenance.gather(results, **made),
    }
    return page.render("report.html.j2", contents=CONTENTS, **values)
