"""The article as PDF, HTML and Markdown, with the metadata that the journal asks for.

Its source, article.md.j2, is Markdown with formulas in TeX. Pandoc turns it into HTML with MathML,
and into the language of Typst, which sets the PDF with the fonts that come with it.
"""

import json
import re
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import pypandoc
import typst
import yaml
from jinja2 import Environment, FileSystemLoader, StrictUndefined
from latticode.datasets import complete_or_absent
from replication.ledger.claim import Origin
from replication.ledger.criterion import REFUTED, Verdict
from replication.ledger.rows import load
from replication.report.results import Results
from replication.report.words import FIRM, Quote

from pendula import RELEASED
from pendula.configuration.paper import in_short

from .crosslinks import alternatives, link_mentions
from .values import KEPT, gather

HERE = Path(__file__).parent
MARKDOWN = "markdown-auto_identifiers"
VECTORS = "/figures/{}.pdf"
"""Where the figures lie for the PDF."""
TITLE = "[Re] Coupled pendula chains under parametric PT-symmetric driving force"
MARKS = {
    "holds": (Verdict.CONFIRMED, Verdict.CAVEAT),
    "fails": REFUTED,
    "undecided": (Verdict.UNDECIDED,),
}
"""How the template marks sentences that rest on a verdict. Every claim of the paper that fails or
cannot be decided must be marked."""


def write_article(
    datasets: list[str], pictures: list[str], ledger: str, kept: list[str],
    differs: Mapping[str, str], html: str, pdf: str, metadata: str,
) -> None:  # fmt: skip
    """Write the three files of the article.

    `kept` are committed files that it quotes. `differs` says where the configuration is not the
    paper's: then there is a notice in place of the article, which would tell of other cases.
    """
    results = Results([*datasets, *pictures, ledger, *kept], html, differs=differs)
    text = source(results, VECTORS)
    made = {
        html: page(results).encode(),
        pdf: typeset(text, _folder(results)),
        metadata: describe(text).encode(),
    }
    for path, content in made.items():
        with complete_or_absent(path) as partial:
            Path(partial).write_bytes(content)


def page(results: Results) -> str:
    """Return the article as a page of HTML that holds its pictures, and links to its data."""

    def linked(value: Any) -> Any:
        return f"[{value.text}]({value.link}){{.n}}" if isinstance(value, Quote) else value

    text = link_mentions(source(results, "figures/{}.png", linked))
    options = ["--mathml", "--embed-resources", f"--resource-path={_folder(results)}"]
    html = _converted(text, "html", "article.html", *options)
    # else readers aloud, and whoever copies a formula, get its TeX as well
    return re.sub(r"<annotation .*?</annotation>", "", html)


def typeset(text: str, folder: Path) -> bytes:
    """Return as PDF the article in Markdown, whose pictures lie in `folder`.

    Equal articles have equal bytes.
    """
    code = _converted(link_mentions(text), "typst", "article.typ")
    for picture, words in alternatives(text):
        alternative = f'"{picture}", alt: {json.dumps(words, ensure_ascii=False)}'
        code = code.replace(f'"{picture}"', alternative)
    return typst.compile(code.encode(), root=folder, ignore_system_fonts=True)


def markdown(results: Results) -> str:
    """Return the article as a page of docs/, with the accepted pictures."""
    return source(results, f"{KEPT}/figures/{{}}.png", captions_below=True)


def describe(text: str) -> str:
    """Return what the journal asks authors of the article in Markdown for, as YAML."""
    given = yaml.safe_load((HERE / "metadata.yaml").read_text(encoding="utf-8"))
    abstract = text.split("**Abstract.**")[1].split("\n\n")[0]
    given |= {"title": TITLE, "abstract": " ".join(abstract.split())}
    return yaml.safe_dump(given, sort_keys=False, allow_unicode=True)


def source(
    results: Results, pictures: str, quoted: Callable[[Any], Any] = str, captions_below=False
) -> str:
    """Return the article in Markdown, or a notice where it would not be true of this run.

    `pictures` says where a figure lies; it is printed as it is drawn. Its caption is a
    paragraph of its own, or a part of it.
    `quoted` writes a number, which may link to its dataset.
    """
    if results.differs:
        return _notice([f"{in_short(list(results.differs.values()))}."])

    def figure(name: str, caller: Callable[[], str]) -> str:
        place = pictures.format(name)
        if captions_below:
            return f"![{name}]({place})\n\n{caller()}\n"
        return f"![{' '.join(caller().split())}]({place})\n\n"

    marked = {mark: set() for mark in MARKS}
    marks = {mark: lambda *claims, found=found: found.update(claims) or ""
             for mark, found in marked.items()}  # fmt: skip
    environment = Environment(
        loader=FileSystemLoader(HERE), undefined=StrictUndefined, finalize=quoted,
        trim_blocks=True, lstrip_blocks=True,
    )  # fmt: skip
    template = environment.get_template("article.md.j2")
    text = template.render(title=TITLE, figure=figure, **marks, **gather(results))
    text = re.sub(r"\$\s=\s+", f"${FIRM}={FIRM}", text)
    text = re.sub(r"(?m)^(\s*\d+)\. ", r"\1\\. ", text)  # else a list would begin there
    wrong = list(_untrue(marked, load(results)))
    return _notice(wrong) if wrong else text


def _untrue(marked: Mapping[str, set[str]], rows: list[dict]) -> Iterator[str]:
    """Yield verdicts that are not those of the article, or that it leaves out."""
    for row in rows:
        told = {mark for mark, claims in marked.items() if row["name"] in claims}
        right = {mark for mark, verdicts in MARKS.items() if row["verdict"] in verdicts}
        left_out = row["origin"] == Origin.PAPER and right - {"holds"} - told
        if told - right or left_out:
            yield f'The verdict on "{row["says"]}" ({row["place"]}) is: {row["verdict"]}.'


def _notice(reasons: list[str]) -> str:
    says = "This run is not the one that the article describes. The report says what it found."
    told = "\n".join(f"- {reason}" for reason in reasons)
    return f"# {TITLE}\n\n**Abstract.** {says}\n\n{told}\n"


def _folder(results: Results) -> Path:
    return results.path("claims.json").resolve().parent


def _converted(text: str, kind: str, template: str, *options: str) -> str:
    """Return Markdown in another language, in the template of this folder."""
    layout = (
        *("--wrap=none", "--syntax-highlighting=none", f"--template={HERE / template}"),
        *(f"--variable=title:{TITLE}", f"--variable=date:{RELEASED}"),
        f"--metadata-file={HERE / 'metadata.yaml'}",
    )
    return pypandoc.convert_text(text, kind, MARKDOWN, [*layout, *options])
