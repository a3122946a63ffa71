"""The comparison as one page of HTML that holds its pictures and asks nothing of the network."""

from collections import Counter
from collections.abc import Sequence
from html import escape
from pathlib import Path

from .findings import IDENTICAL, NEARLY, STATUSES, Finding
from .page_pictures import difference, embedded, thumbnail
from .page_style import STYLE


def render(findings: Sequence[Finding], made: Path, folder: Path, note: str) -> str:
    """Return the page; pictures are read from below `made` and from the baseline's folder."""
    counts = Counter(finding.status for finding in findings)
    faults = sum(finding.is_fault for finding in findings)
    verdict = _count(faults, "fault") if faults else "no faults"
    tally = " ".join(
        f'<a class="{_slug(s) if counts[s] else "none_of"}" href="#{_slug(s)}">{counts[s]} {s}</a>'
        for s in STATUSES
    )
    sections = [_section(s, [f for f in findings if f.status == s], made, folder) for s in STATUSES]
    return (
        f'<!doctype html>\n<html lang="en"><head><meta charset="utf-8">\n'
        f"<title>Figure diff: {verdict}</title>\n<style>{STYLE}</style></head>\n<body>\n"
        f'<h1>Figure diff: {verdict}</h1>\n<p class="tally">{tally}</p>\n<p>{escape(note)}</p>\n'
        + "".join(sections)
        + "</body></html>\n"
    )


def _section(status: str, findings: list[Finding], made: Path, folder: Path) -> str:
    if not findings:
        return ""
    drawn = [finding for finding in findings if finding.name.endswith(".png")]
    told = [finding for finding in findings if finding not in drawn]
    head = f'<h2 id="{_slug(status)}" class="{_slug(status)}">{status.capitalize()}</h2>\n'
    return head + _list(told, status) + _shown(drawn, status, made, folder)


def _list(findings: list[Finding], status: str) -> str:
    if not findings:
        return ""
    rows = "".join(
        f"<tr><td>{escape(f.name)}</td><td>{escape(f.says)}</td></tr>\n" for f in findings
    )
    opened = "" if status in (IDENTICAL, NEARLY) else " open"
    summary = f"<summary>{_count(len(findings), 'dataset')}</summary>"
    return f"<details{opened}>{summary}\n<table>{rows}</table></details>\n"


def _shown(findings: list[Finding], status: str, made: Path, folder: Path) -> str:
    if status == IDENTICAL:
        shown = [_figure(thumbnail(made / f.name), f.name) for f in findings]
        return f'<div class="thumbnails">{"".join(shown)}</div>\n'
    return "".join(_side_by_side(finding, made, folder) for finding in findings)


def _side_by_side(finding: Finding, made: Path, folder: Path) -> str:
    paths = [path / finding.name for path in (folder, made)]
    three = {
        "reference": embedded(paths[0]),
        "new": embedded(paths[1]),
        "difference (grey: same, red: gone, blue: new)": difference(*paths),
    }
    shown = "".join(_figure(address, name) for name, address in three.items())
    head = f"<h3>{escape(finding.name)}</h3><p>{escape(finding.says)}</p>"
    return f'{head}<div class="three">{shown}</div>\n'


def _figure(address: str, caption: str) -> str:
    title = escape(caption)
    image = f'<img src="{address}" alt="{title}">' if address else '<p class="none">none</p>'
    return f"<figure>{image}<figcaption>{title}</figcaption></figure>"


def _count(number: int, word: str) -> str:
    return f"{number} {word}" if number == 1 else f"{number} {word}s"


def _slug(status: str) -> str:
    return status.replace(" ", "_")
