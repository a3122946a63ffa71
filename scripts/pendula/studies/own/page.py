"""The report of one's own cases and sweeps: everything on the page comes from their datasets."""

from pathlib import Path
from typing import Any

from pendula import __version__
from pendula.report.provenance import versions

from . import section_cases as own_cases
from . import section_sweeps as own_sweeps


def gather(cases: list[str], sweeps: dict[str, str], folder: Path) -> dict[str, Any]:
    """Return what own.html.j2 shows: `cases` by name, `sweeps` with the case that each repeats.

    Links are seen from `folder`, where the page will lie.
    """
    shown = [own_cases.gather(case, folder) for case in cases]
    trusted = {case["name"]: case["divergence_time"] for case in shown}
    return {
        "cases": shown,
        "sweeps": [own_sweeps.gather(name, case, folder, trusted) for name, case in sweeps.items()],
        "versions": {"pendula": __version__, **versions()},
    }
