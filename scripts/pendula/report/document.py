"""The report of a run: the sections of all studies, then those of the ledger and of the run."""

from pendula import studies
from pendula.ledger import section as claims
from pendula.ledger.section import Ledger

from .page import render
from .results import Results, Section
from .sections import Measured, gather_provenance, gather_speed


def write(results: Results, measured: Measured, made: dict) -> str:
    """Return the report as HTML.

    `measured` says where speed was measured, `made` holds what `gather_provenance` takes.
    """
    ledger = Ledger(results)
    of_studies = [
        (section, f"{study}/section.html.j2")
        for study, module in studies.modules("section").items()
        for section in module.SECTIONS
    ]
    own = (
        Section("claims", "What the paper says", lambda *_: claims.gather(results)),
        Section("speed", "Speed against error", lambda *_: gather_speed(results, measured)),
        Section("provenance", "How it was run", lambda *_: gather_provenance(results, **made)),
    )
    sections = [
        {
            "name": section.name,
            "title": section.title,
            "template": template,
            "found": section.gather(results, ledger),
        }
        for section, template in [*of_studies, *((one, "sections.html.j2") for one in own)]
    ]
    return render("report.html.j2", sections=sections, differs=list(results.differs.values()))
