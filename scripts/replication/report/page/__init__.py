"""HTML pages that contain their style and load nothing from a network."""

import base64
import hashlib
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

FOLDER = Path(__file__).parent


def render(template: str, folder: Path = FOLDER, **values: Any) -> str:
    """Return the page of a template filled with values, with its style and the style's hash.

    The template is in `folder` or in `templates` of this package. Text is escaped. A missing value
    of the template is an error.
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
    """Return the script that filters claims and its hash, as values of the report's template."""
    script = (FOLDER / "report.js").read_text(encoding="utf-8")
    return {"script": Markup(script), "script_hash": digest(script)}


def digest(text: str) -> str:
    """Return the hash that a Content-Security-Policy needs to allow this style or script."""
    return base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()
