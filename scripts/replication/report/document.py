"""The report of a run: verdicts, figures, claims, datasets and times, as the files tell them."""

import re
from collections import Counter
from collections.abc import Mapping
from importlib.metadata import version
from pathlib import Path
from typing import Any, NamedTuple

from latticode.datasets import complete_or_absent
from latticode.datasets.json_files import load_json
from latticode.kernels.sources import describe_machine
from markupsafe import Markup
from pendula.sources import TOOK

from replication.ledger.criterion import Verdict
from replication.ledger.rows import counted, counted_origins, on_figure, whether_it_holds

from .described import Dataset, Figure, dataset, figure
from .page import render, script_of_report
from .words import number, plainly, symbols

TITLE = "Coupled pendula under a PT-symmetric drive"
PAPERS = [f"fig{n}" for n in range(1, 7)]
FOLDED = (Verdict.NOT_APPLICABLE, Verdict.CAVEAT, Verdict.CONFIRMED)
"""Claims with these verdicts are folded; readers look for the others first."""
PACKAGES = ("snakemake", "xarray", "netCDF4", "matplotlib", "pydantic", "Jinja2")


class Table(NamedTuple):
    """A table with its caption; the first cell of a row is its head."""

    caption: str
    head: tuple[str, ...]
    rows: list[tuple]


class Section(NamedTuple):
    """A part of a page under a heading; it is folded unless it is `opened`."""

    name: str
    title: str
    opened: bool = True
    lines: list[str] = []
    tables: list[Table] = []
    figures: list[Figure] = []
    claims: list[dict[str, Any]] = []
    filters: list[tuple[str, str, list[str]]] = []
    datasets: Mapping[str, list[Dataset]] = {}


def write_report(
    datasets: list[str], figures: list[str], ledger: str, differs: Mapping[str, str], html: str
) -> None:
    """Write the page `html` on the files of a run, which lie beside it in folders.

    `figures` are their datasets, each beside its picture. `differs` says where the configuration is
    not the paper's.
    """
    folder = Path(html).parent
    shown = {Path(path).stem: figure(Path(path), folder) for path in figures}
    rows = load_json(ledger)["rows"]
    papers = [shown.pop(name) for name in PAPERS]
    sections = [
        Section("figures", "The figures of the paper", tables=[_overview(rows, papers)],
                figures=papers),
        *_claims(rows),
        Section("more", "More figures", False, figures=[*shown.values()]),
        _datasets([dataset(Path(path), folder) for path in datasets]),
        _run(folder / "logs"),
    ]  # fmt: skip
    title = f"{TITLE}: the paper, {'with other settings' if differs else 'replicated'}"
    first = {"verdict": "; ".join(counted(rows)), "differs": [*differs.values()]}
    write_page(html, "report.html.j2", title, sections, **first, **script_of_report())


def write_page(html: str, template: str, title: str, sections: list[Section], **values) -> None:
    """Write the page of a template with these sections."""
    with complete_or_absent(html) as partial:
        page = render(template, title=title, sections=sections, **values)
        Path(partial).write_text(page, encoding="utf-8")


def _overview(rows: list[dict], figures: list[Figure]) -> Table:
    """Return Figs 1 to 6 with the verdicts on the paper's claims about them, all with links."""
    return Table(
        "Whether what the paper says of each figure holds for our curves, and its claims",
        ("figure", "verdict", "claims"),
        [_of_figure(which, one, on_figure(rows, which)) for which, one in enumerate(figures, 1)],
    )


def _of_figure(which: int, shown: Figure, rows: list[dict]) -> tuple:
    name = Markup('<a href="#{}">Fig {}</a>: {}').format(shown.stem, which, shown.headline)
    if not rows:
        return name, whether_it_holds(rows), "none"
    first = {row["verdict"]: row["name"] for row in reversed(rows)}
    count = Counter(row["verdict"] for row in rows)
    links = [
        Markup('<a href="#claim_{}" data-filter="figure={}&verdict={}">{} {}</a>').format(
            first[verdict], which, verdict, count[verdict], verdict
        )
        for verdict in map(str, Verdict)
        if verdict in count
    ]
    return name, whether_it_holds(rows), Markup(", ").join(links)


def _claims(rows: list[dict]) -> list[Section]:
    """Return the claims that are not confirmed, and those of each other verdict folded."""
    others = [row for row in rows if row["verdict"] not in FOLDED]
    title = (
        "Claims that are not reproduced, do not carry over, do not follow, or cannot be decided:"
        f" {counted_origins(others) or 'none'}"
    )
    shown = {"lines": counted(rows), "claims": list(map(_claim, others))}
    found = [Section("claims", title, **shown, filters=_filters(rows))]
    for verdict in FOLDED:
        if same := [row for row in rows if row["verdict"] == verdict]:
            title = f"{len(same)} claims {verdict}: {counted_origins(same)}"
            claims = list(map(_claim, same))
            found.append(Section(verdict.replace(" ", "_"), title, False, claims=claims))
    return found


def _filters(rows: list[dict]) -> list[tuple[str, str, list[str]]]:
    """Return the choices by which a reader filters claims: key, label and values of each."""
    figures = [str(n) for n in range(1, len(PAPERS) + 1) if on_figure(rows, n)]
    verdicts = {row["verdict"] for row in rows}
    return [
        ("verdict", "Verdict", [verdict for verdict in map(str, Verdict) if verdict in verdicts]),
        ("figure", "Figure", figures),
        ("section", "Section", sorted({str(row["section"]) for row in rows}, key=int)),
        ("kind", "Kind", sorted({row["kind"] for row in rows})),
    ]


def _claim(row: dict) -> dict[str, Any]:
    """Return a row of the ledger as a page shows it."""
    because = row["because"]
    return {
        **{key: row[key] for key in ("name", "place", "kind", "verdict", "section", "function")},
        "figures": [n for n in range(1, len(PAPERS) + 1) if on_figure([row], n)],
        **{key: symbols(row[key]) for key in ("says", "criterion")},
        "because": symbols(because[:1].upper() + because[1:]),
        "measured": [(plainly(key), _value(value)) for key, value in row["measured"].items()],
        "thresholds": [
            f"{_value(one['value'])} ({symbols(one['from'])})" for one in row["cutoffs"]
        ],
        "controls": [
            one | {"fed": symbols(one["fed"]), "because": symbols(one["because"])}
            for one in row["controls"]
        ],
        "data": row["decided_by"],
    }


def _value(value: float | str) -> str:
    return symbols(value) if isinstance(value, str) else number(value, 4)


def _datasets(found: list[Dataset]) -> Section:
    """Return all datasets by their folders."""
    by_folder: dict[str, list[Dataset]] = {}
    for one in found:
        by_folder.setdefault(one.link.partition("/")[0], []).append(one)
    return Section("datasets", f"{len(found)} datasets", False, datasets=by_folder)


def _run(logs: Path) -> Section:
    """Return the versions and the times of a run whose logs lie below a folder."""
    times = run_times(logs)
    total = sum(seconds for _, seconds, _ in times)
    versions = describe_machine() | {name: version(name) for name in PACKAGES}
    return Section(
        "run", "How it was run", False,
        tables=[
            Table("Processor and versions", ("what", "which"), [*versions.items()]),
            Table(
                f"Wall times and largest memory of the jobs: {total:.0f} s in all, start-up "
                "included; several ran side by side", ("job", "s", "MB"),
                [(name, f"{seconds:.1f}", memory) for name, seconds, memory in times],
            ),
        ],
    )  # fmt: skip


def run_times(logs: Path) -> list[tuple[str, float, str]]:
    """Return the wall time in s and the memory in MB of each job with a log, the longest first."""
    found = []
    for log in sorted(logs.rglob("*.log")):
        last = log.read_text(encoding="utf-8", errors="replace").rstrip().rpartition("\n")[2]
        if took := re.match(rf"{TOOK}([\d.]+) s, largest memory: (\d+) MB", last):
            name = log.relative_to(logs).with_suffix("").as_posix()
            found.append((name, float(took[1]), took[2]))
    return sorted(found, key=lambda job: (-job[1], job[0]))
