"""The page of a comparison: a table of findings, and reference and new side by side of pictures."""

from pathlib import Path

from pendula.report import page

from . import Status, Verdict


def render(verdict: Verdict, made: Path, folder: Path) -> str:
    """Return the page; images are read from below `made` and from the baseline's folder."""
    told = [found for found in verdict.findings if found.status != Status.IDENTICAL]
    pictures = {
        name: {"reference": _address(folder / name), "new": _address(made / name)}
        for name, *_ in told
        if name.endswith(".png")
    }
    shown = {"verdict": verdict, "told": told, "pictures": pictures}
    return page.render("comparison_page.html.j2", Path(__file__).parent, **shown)


def _address(path: Path) -> str:
    """Return the address of a picture, or nothing where there is none to be shown."""
    content = path.read_bytes() if path.exists() else b""
    return page.address_of(content) if content.startswith(page.SIGNATURE) else ""
