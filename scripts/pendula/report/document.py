"""The report of a run: the figures, the claims, and the sections of all studies below them."""

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
    own = [
        Section("speed", "Speed", lambda *_: gather_speed(results, measured)),
        Section("provenance", "How it was run", lambda *_: provenance),
    ]
    with complete_or_absent(html) as partial:
        Path(partial).write_text(write(results, [*all_sections(), *own]), "utf-8")


def all_sections() -> list[Section]:
    """Return the sections of the studies with the claims behind those that are not folded."""
    of_studies = [one for module in studies.modules("section").values() for one in module.SECTIONS]
    ledger = Section("claims", "Claims", claims.gather, opened=True)
    return sorted([*of_studies, ledger], key=lambda section: not section.opened)


def write(results: Results, sections: list[Section]) -> str:
    """Return the report with these sections as HTML."""
    ledger = Ledger(results)
    shown = [{**section._asdict(), "parts": section.gather(results, ledger)}
             for section in sections]  # fmt: skip
    return render("report.html.j2", sections=shown, verdict=claims.summary(results),
                  differs=list(results.differs.values()))  # fmt: skip
