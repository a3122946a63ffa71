"""Pages of HTML that hold their style, and ask no network."""

import base64
import hashlib
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

FOLDER = Path(__file__).parent


def render(template: str, folder: Path = FOLDER, **values) -> str:
    """Return the page of a template filled with values, with its style and the style's hash.

    The template lies in `folder` or in this package, which has that of a page with sections. Text
    is escaped; a value that the template names and nobody gave is an error.
    """
    environment = Environment(
        loader=FileSystemLoader([folder, FOLDER / "templates"]),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    style = (FOLDER / "style.css").read_text(encoding="utf-8")
    common = {"style": Markup(style), "style_hash": digest(style), "script": "", "in_article": {}}
    return environment.get_template(template).render(**common | values)


def script_of_report() -> dict[str, str]:
    """Return the script that filters the claims of a report, and its hash, for its template."""
    script = (FOLDER / "report.js").read_text(encoding="utf-8")
    return {"script": Markup(script), "script_hash": digest(script)}


def digest(text: str) -> str:
    """Return the hash by which a Content-Security-Policy allows a style or a script."""
    return base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()
