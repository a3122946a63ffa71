"""The page of a comparison: a table of files, and each picture next to the accepted one."""

from base64 import b64encode
from pathlib import Path

from latticode.datasets import complete_or_absent
from latticode.datasets.json_files import write_json

from replication.report import page

from . import ComparisonResult, Status
from .baseline import compare
from .chaos import Trust


def render(verdict: ComparisonResult, results: Path, folder: Path) -> str:
    """Return the page with new pictures from `results`, and accepted ones from `folder`."""
    unlike = [result for result in verdict.findings if result.status != Status.IDENTICAL]
    pictures = {
        name: {"reference": _address(folder / name), "new": _address(results / name)}
        for name, *_ in unlike
        if name.endswith(".png")
    }
    title = f"Figure diff: {verdict.faults} fault{'' if verdict.faults == 1 else 's'}"
    values = {
        "title": title,
        "sections": [],
        "verdict": verdict,
        "differing": unlike,
        "pictures": pictures,
    }
    return page.render("comparison_page.html.j2", Path(__file__).parent, **values)


def _address(path: Path) -> str:
    """Return a PNG as a data URL; empty if there is none or it is damaged."""
    content = path.read_bytes() if path.exists() else b""
    if not content.startswith(b"\x89PNG"):
        return ""
    return f"data:image/png;base64,{b64encode(content).decode()}"


def compare_results(
    results: list[str],
    made: str,
    baseline: str,
    configuration: dict,
    any_bits: bool,
    html: str,
    verdict: str,
    trust: Trust | None = None,
) -> None:
    """Compare files of a run in the folder `made` with a baseline; write a page and a summary.

    The page is written to `html`, the summary to the JSON file `verdict`. For `trust` see
    `baseline.compare`.
    """
    names = [Path(path).relative_to(made).as_posix() for path in results]
    folders = Path(made), Path(baseline)
    comparison = compare(names, *folders, configuration, trust, any_bits)
    with complete_or_absent(html) as partial:
        partial.write_text(render(comparison, *folders), "utf-8")
    write_json(
        verdict,
        {"faults": comparison.faults, "counts": comparison.counts, "lines": comparison.lines},
    )
