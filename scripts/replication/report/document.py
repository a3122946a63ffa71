"""The report of a run on one HTML page: verdicts, figures, claims, datasets and times."""

from collections import Counter
from collections.abc import Mapping, Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Any, NamedTuple

from latticode.datasets import complete_or_absent
from latticode.datasets.json_files import load_json
from latticode.kernels.sources import describe_machine
from markupsafe import Markup

from replication.ledger.criterion import Verdict
from replication.ledger.rows import counted, counted_origins, on_figure, whether_it_holds
from replication.logs import run_times
from replication.words import number, plainly, symbols

from .described import DescribedDataset, DescribedFigure, MapLink, dataset, figure
from .page import FOLDER, render, script_of_report

FOLDED = (Verdict.NOT_APPLICABLE, Verdict.CAVEAT, Verdict.CONFIRMED)
"""Claims with these verdicts are folded, because readers look for the other claims first."""
PACKAGES = ("snakemake", "xarray", "netCDF4", "matplotlib", "pydantic", "Jinja2")


class ReportedPaper(NamedTuple):
    """The paper of a report: the title of the page, the paper's figures, an introduction.

    `figures` are the names of files in figures/, in the paper's order. `introduction` is HTML that
    follows the counts of verdicts.
    """

    title: str
    figures: tuple[str, ...]
    introduction: str = ""


class PageTable(NamedTuple):
    """A table with its caption; the first cell of each row is a heading."""

    caption: str
    head: tuple[str, ...]
    rows: list[tuple]


class PageSection(NamedTuple):
    """A section of a page; it is folded unless it is `opened`."""

    name: str
    title: str
    opened: bool = True
    lines: Sequence[str] = ()
    tables: Sequence[PageTable] = ()
    figures: Sequence[DescribedFigure] = ()
    claims: Sequence[dict[str, Any]] = ()
    filters: Sequence[tuple[str, str, list[str]]] = ()
    datasets: Mapping[str, list[DescribedDataset]] = {}


def write_report(
    paper: ReportedPaper,
    datasets: Sequence[str],
    figures: Sequence[str],
    ledger: str,
    differs: Mapping[str, str],
    html: str,
    maps: Mapping[str, Sequence[MapLink]] | None = None,
    in_article: Mapping[str, str] | None = None,
) -> None:
    """Write the page `html` on the files of a run, which are in its folder.

    `figures` are the paths of the figures' datasets, which are next to the pictures. `differs`
    describes the differences of the configuration from the paper's. `maps` has links for the points
    of figures by name. `in_article` has addresses in the article by ids of this page.
    """
    folder, rows, maps = Path(html).parent, load_json(ledger)["rows"], maps or {}
    described = {
        path.stem: figure(path, folder, maps.get(path.stem, ())) for path in map(Path, figures)
    }
    of_paper = [described.pop(name) for name in paper.figures]
    numbers = range(1, len(of_paper) + 1)
    sections = [
        PageSection(
            "figures",
            "The figures of the paper",
            tables=[tabulate_figures(rows, of_paper)],
            figures=of_paper,
        ),
        *claim_sections(rows, numbers),
        PageSection("more", "More figures", opened=False, figures=[*described.values()]),
        dataset_section([dataset(Path(path), folder) for path in datasets]),
        run_section(folder / "logs"),
    ]
    write_page(
        html,
        "report.html.j2",
        f"{paper.title}: the paper, {'with other settings' if differs else 'replicated'}",
        sections,
        verdict="; ".join(counted(rows)),
        differs=[*differs.values()],
        introduction=Markup(paper.introduction),
        in_article=in_article or {},
        **script_of_report(),
    )


def write_page(
    html: str,
    template: str,
    title: str,
    sections: Sequence[PageSection],
    folder: Path = FOLDER,
    **values: Any,
) -> None:
    """Write a page with these sections from a template in `folder`."""
    with complete_or_absent(html) as partial:
        page = render(template, folder, title=title, sections=sections, **values)
        Path(partial).write_text(page, encoding="utf-8")


def tabulate_figures(rows: list[dict], figures: Sequence[DescribedFigure]) -> PageTable:
    """Return a table of the paper's figures with the verdicts on its claims about them."""
    return PageTable(
        "The figures of the paper, and whether its claims on them hold for our curves",
        ("figure", "verdict", "claims"),
        [
            _figure_cells(number, described, on_figure(rows, number))
            for number, described in enumerate(figures, 1)
        ],
    )


def _figure_cells(number: int, described: DescribedFigure, rows: list[dict]) -> tuple:
    name = Markup('<a href="#{}">Fig {}</a>: {}').format(described.stem, number, described.headline)
    if not rows:
        return name, whether_it_holds(rows), "none"
    first = {row["verdict"]: row["name"] for row in reversed(rows)}
    count = Counter(row["verdict"] for row in rows)
    links = [
        Markup('<a href="#claim_{}" data-filter="figure={}&verdict={}">{} {}</a>').format(
            first[verdict], number, verdict, count[verdict], verdict
        )
        for verdict in map(str, Verdict)
        if verdict in count
    ]
    return name, whether_it_holds(rows), Markup(", ").join(links)


def claim_sections(rows: list[dict], figures: range) -> list[PageSection]:
    """Return an open section with the claims to read first, and folded sections with the others."""
    unfolded = [row for row in rows if row["verdict"] not in FOLDED]
    title = (
        "Claims that are not reproduced, do not carry over, do not follow, or cannot be decided:"
        f" {counted_origins(unfolded) or 'none'}"
    )
    sections = [
        PageSection(
            "claims",
            title,
            lines=counted(rows),
            claims=[claim_entry(row, figures) for row in unfolded],
            filters=claim_filters(rows, figures),
        )
    ]
    for verdict in FOLDED:
        if same := [row for row in rows if row["verdict"] == verdict]:
            title = f"{len(same)} claims {verdict}: {counted_origins(same)}"
            claims = [claim_entry(row, figures) for row in same]
            name = verdict.replace(" ", "_")
            sections.append(PageSection(name, title, opened=False, claims=claims))
    return sections


def claim_filters(rows: list[dict], figures: range) -> list[tuple[str, str, list[str]]]:
    """Return the filters of claims: key, label and values of each."""
    verdicts = {row["verdict"] for row in rows}
    return [
        ("verdict", "Verdict", [verdict for verdict in map(str, Verdict) if verdict in verdicts]),
        ("figure", "Figure", [str(number) for number in figures if on_figure(rows, number)]),
        ("section", "Section", sorted({str(row["section"]) for row in rows}, key=int)),
        ("kind", "Kind", sorted({row["kind"] for row in rows})),
    ]


def claim_entry(row: dict, figures: range) -> dict[str, Any]:
    """Return a row of the ledger with numbers and symbols formatted for a page."""
    because = row["because"]
    return {
        **{key: row[key] for key in ("name", "place", "kind", "verdict", "section", "function")},
        "figures": [number for number in figures if on_figure([row], number)],
        **{key: symbols(row[key]) for key in ("says", "criterion")},
        "because": symbols(because[:1].upper() + because[1:]),
        "measured": [(plainly(key), _number(value)) for key, value in row["measured"].items()],
        "thresholds": [
            f"{_number(cutoff['value'])} ({symbols(cutoff['from'])})" for cutoff in row["cutoffs"]
        ],
        "controls": [
            control | {"fed": symbols(control["fed"]), "because": symbols(control["because"])}
            for control in row["controls"]
        ],
        "data": row["decided_by"],
    }


def _number(value: float | str) -> str:
    return symbols(value) if isinstance(value, str) else number(value, 4)


def dataset_section(datasets: Sequence[DescribedDataset]) -> PageSection:
    """Return a section with all datasets by folder."""
    by_folder: dict[str, list[DescribedDataset]] = {}
    for described in datasets:
        by_folder.setdefault(described.link.partition("/")[0], []).append(described)
    title = f"{len(datasets)} datasets"
    return PageSection("datasets", title, opened=False, datasets=by_folder)


def run_section(logs: Path) -> PageSection:
    """Return a section with the versions of a run, and the times from its logs."""
    times = run_times(logs)
    total = sum(seconds for _, seconds, _ in times)
    versions = describe_machine() | {name: version(name) for name in PACKAGES}
    caption = (
        f"Wall times and largest memory of the jobs, some of them parallel: {total:.0f} s in all, "
        "start-up included"
    )
    jobs = [(name, f"{seconds:.1f}", memory) for name, seconds, memory in times]
    return PageSection(
        "run",
        "How it was run",
        opened=False,
        tables=[
            PageTable("Processor and versions", ("name", "value"), [*versions.items()]),
            PageTable(caption, ("job", "s", "MB"), jobs),
        ],
    )
