"""An article as PDF, HTML and Markdown, with the metadata that a journal asks for.

Its source is Markdown with formulas in TeX. Pandoc turns it into HTML with MathML, and into the
language of Typst, which sets the PDF with the fonts that come with it.
"""

import json
import re
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import pypandoc
import typst
import yaml
from jinja2 import Environment, FileSystemLoader, StrictUndefined
from latticode.datasets import complete_or_absent

from replication.differences import in_short
from replication.ledger.claim import Origin
from replication.ledger.criterion import REFUTED, Verdict
from replication.ledger.rows import load
from replication.report.results import Results
from replication.report.words import FIRM, Quote

from .crosslinks import alternatives, link_mentions
from .numbers import KEPT

LAYOUTS = Path(__file__).parent
MARKDOWN = "markdown-auto_identifiers"
VECTORS = "/figures/{}.pdf"
"""Where the figures lie for the PDF."""
MARKS = {
    "holds": (Verdict.CONFIRMED, Verdict.CAVEAT),
    "fails": REFUTED,
    "undecided": (Verdict.UNDECIDED,),
}
"""How the template marks sentences that rest on a verdict. Every claim of the paper that fails or
cannot be decided must be marked."""


class Article(NamedTuple):
    """The article of one replication.

    `folder` holds its source article.md.j2 and the journal's metadata.yaml, `gather` returns the
    functions and numbers that the source names. `navigation` are the links above the page in HTML,
    `rights` the sentence on licenses below the PDF.
    """

    folder: Path
    title: str
    released: str
    gather: Callable[[Results], Mapping[str, Any]]
    navigation: str = ""
    rights: str = ""

    def write(self, results: Results, html: str, pdf: str, metadata: str) -> None:
        """Write the page, the PDF and the journal's metadata."""
        text = self.source(results, VECTORS)
        contents = {
            html: self.page(results).encode(),
            pdf: self.typeset(text, _folder(results)),
            metadata: self.describe(text).encode(),
        }
        for path, content in contents.items():
            with complete_or_absent(path) as partial:
                Path(partial).write_bytes(content)

    def page(self, results: Results) -> str:
        """Return the article as a page of HTML that holds its pictures, and links to its data."""

        def linked(value: Any) -> Any:
            return f"[{value.text}]({value.link}){{.n}}" if isinstance(value, Quote) else value

        text = link_mentions(self.source(results, "figures/{}.png", linked))
        options = ["--mathml", "--embed-resources", f"--resource-path={_folder(results)}"]
        html = self.convert(text, "html", *options)
        # else readers aloud, and whoever copies a formula, get its TeX as well
        return re.sub(r"<annotation .*?</annotation>", "", html)

    def typeset(self, text: str, folder: Path) -> bytes:
        """Return as PDF the article in Markdown, whose pictures lie in `folder`.

        Equal articles have equal bytes.
        """
        code = self.convert(link_mentions(text), "typst")
        for picture, words in alternatives(text):
            alternative = f'"{picture}", alt: {json.dumps(words, ensure_ascii=False)}'
            code = code.replace(f'"{picture}"', alternative)
        return typst.compile(code.encode(), root=folder, ignore_system_fonts=True)

    def markdown(self, results: Results) -> str:
        """Return the article as a page of docs/, with the accepted pictures."""
        return self.source(results, f"{KEPT}/figures/{{}}.png", captions_below=True)

    def describe(self, text: str) -> str:
        """Return the journal's metadata of the article in Markdown, as YAML."""
        metadata = yaml.safe_load((self.folder / "metadata.yaml").read_text(encoding="utf-8"))
        abstract = text.split("**Abstract.**")[1].split("\n\n")[0]
        metadata |= {"title": self.title, "abstract": " ".join(abstract.split())}
        return yaml.safe_dump(metadata, sort_keys=False, allow_unicode=True)

    def source(
        self,
        results: Results,
        pictures: str,
        quoted: Callable[[Any], Any] = str,
        captions_below: bool = False,
    ) -> str:
        """Return the article in Markdown, or a notice where it would not be true of this run.

        `pictures` is the path of a figure by its name, such as "figures/{}.png". `captions_below`
        makes its caption a paragraph of its own. `quoted` writes a number, which may link to its
        dataset.
        """
        if results.differs:
            return self._notice([f"{in_short(list(results.differs.values()))}."])

        def figure(name: str, caller: Callable[[], str]) -> str:
            place = pictures.format(name)
            if captions_below:
                return f"![{name}]({place})\n\n{caller()}\n"
            return f"![{' '.join(caller().split())}]({place})\n\n"

        marked: dict[str, set[str]] = {mark: set() for mark in MARKS}
        marks = {mark: _recorder(claims) for mark, claims in marked.items()}
        environment = Environment(
            loader=FileSystemLoader(self.folder),
            undefined=StrictUndefined,
            finalize=quoted,
            trim_blocks=True,
            lstrip_blocks=True,
        )
        template = environment.get_template("article.md.j2")
        text = template.render(title=self.title, figure=figure, **marks, **self.gather(results))
        text = re.sub(r"\$\s=\s+", f"${FIRM}={FIRM}", text)
        text = re.sub(r"(?m)^(\s*\d+)\. ", r"\1\\. ", text)  # else a list would begin there
        wrong = list(_untrue(marked, load(results)))
        return self._notice(wrong) if wrong else text

    def _notice(self, reasons: list[str]) -> str:
        summary = (
            "This run is not the one that the article describes. The report shows its results."
        )
        listed = "\n".join(f"- {reason}" for reason in reasons)
        return f"# {self.title}\n\n**Abstract.** {summary}\n\n{listed}\n"

    def convert(self, text: str, kind: str, *options: str) -> str:
        """Return Markdown as "html" or "typst", in the layout of this folder."""
        layout = LAYOUTS / {"html": "article.html", "typst": "article.typ"}[kind]
        settings = [
            "--wrap=none",
            "--syntax-highlighting=none",
            f"--template={layout}",
            f"--variable=title:{self.title}",
            f"--variable=date:{self.released}",
            f"--variable=navigation:{self.navigation}",
            f"--variable=rights:{self.rights}",
            f"--metadata-file={self.folder / 'metadata.yaml'}",
        ]
        return pypandoc.convert_text(text, kind, MARKDOWN, [*settings, *options])


def _recorder(claims: set[str]) -> Callable[..., str]:
    """Return a function of a template that notes names of claims, and prints nothing."""

    def record(*names: str) -> str:
        claims.update(names)
        return ""

    return record


def _untrue(marked: Mapping[str, set[str]], rows: list[dict]) -> Iterator[str]:
    """Yield verdicts that are not those of the article, or that it leaves out."""
    for row in rows:
        stated = {mark for mark, claims in marked.items() if row["name"] in claims}
        right = {mark for mark, verdicts in MARKS.items() if row["verdict"] in verdicts}
        left_out = row["origin"] == Origin.PAPER and right - {"holds"} - stated
        if stated - right or left_out:
            yield f'The verdict on "{row["says"]}" ({row["place"]}) is: {row["verdict"]}.'


def _folder(results: Results) -> Path:
    return results.path("claims.json").resolve().parent
