"""A page of HTML that holds its style, its script and its pictures, and asks no network."""

from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

HERE = Path(__file__).parent


def render(template: str, folder: Path = HERE / "templates", **values) -> str:
    """Return the page of `template` in `folder`, which extends base.html.j2, filled with values.

    The templates of this package are found from every folder. Text is escaped, and a value that the
    template names and nobody gave is an error.
    """
    loader = FileSystemLoader([folder, HERE / "templates"])
    environment = Environment(
        loader=loader, autoescape=True, undefined=StrictUndefined, trim_blocks=True,
        lstrip_blocks=True,
    )  # fmt: skip
    inlined = {name: Markup(_text(name)) for name in ("style.css", "script.js")}
    environment.globals |= {"style": inlined["style.css"], "script": inlined["script.js"]}
    return environment.get_template(template).render(**values)


def _text(name: str) -> str:
    return (HERE / name).read_text(encoding="utf-8")
