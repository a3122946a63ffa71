"""The report of a run: the sections of all studies, then those of the ledger and of the run."""

import json
from pathlib import Path

from pendula import studies
from pendula.datasets import complete_or_absent
from pendula.ledger import section as claims
from pendula.ledger.section import Ledger

from .page import render
from .results import Results, Section, link_to
from .sections import Measured, gather_provenance, gather_speed


def write_report(
    datasets: list[str],
    pictures: list[str],
    ledger: str,
    references: list[str],
    speed: list[str],
    speed_is_fresh: bool,
    made_by: dict[str, str],
    settings: str,
    differs: dict[str, str],
    html: str,
) -> None:
    """Write the page `html` on the files of a run, which lie beside it in folders.

    `speed` names the dataset, the table and the pictures of measured times, which are fresh if
    this machine took them. `made_by` has a hash of each function that jobs called. `settings` is
    the configuration as text, and `differs` says where it is not the paper's.
    """
    files = [*datasets, *pictures, ledger, *speed]
    results = Results(files, html, json.loads(settings), differs, references)
    data, table, *drawn = (link_to(path, html) for path in speed)
    measured = Measured(data, table, drawn, speed_is_fresh)
    provenance = gather_provenance(made_by, references, settings, Path(html).parent / "logs")
    with complete_or_absent(html) as partial:
        Path(partial).write_text(write(results, measured, provenance), "utf-8")


def write(results: Results, measured: Measured, provenance: dict) -> str:
    """Return the report as HTML.

    `measured` says where speed was measured, `provenance` what `gather_provenance` returns.
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
        Section("provenance", "How it was run", lambda *_: provenance),
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
