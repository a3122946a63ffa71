"""An article as PDF, HTML and Markdown, with the metadata that a journal requires.

Its source is Markdown with formulas in TeX. Pandoc converts it to HTML with MathML, and to Typst,
which typesets the PDF with its own fonts.
"""

import json
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
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
from replication.results import Results
from replication.words import FIRM

from .cards import Card, Cards, functions_of
from .crosslinks import alternatives, link_mentions
from .page import LiveParts, complete_page
from .quoted import BASELINE, LongStudies
from .sources import Printed, Source

LAYOUTS = Path(__file__).parent
MARKDOWN = "markdown-auto_identifiers"
PICTURES = "figures/{}.png"
"""Pattern of the paths of figures in the page's source."""
LINK_TO_CARD = re.compile(r"\[([^\[\]]*)\]\(#[^()]*\)\{[^{}]*\}")
PICTURE_LINK = re.compile(r"\]\((figures/[^)]+)\.png\)")
MARKS = {
    "holds": (Verdict.CONFIRMED, Verdict.CAVEAT),
    "fails": REFUTED,
    "undecided": (Verdict.UNDECIDED,),
}
"""Functions of the template that mark a sentence, with the verdicts that each allows. The article
must mark each claim of the paper that fails or is undecided."""
TO_CARD = "data and code"
"""The text of the link from a caption to the card of its figure."""


class Article(NamedTuple):
    """The article of one replication.

    `folder` contains its source article.md.j2 and the journal's metadata.yaml. `gather` returns the
    functions and numbers that the source uses. `long_studies` are the studies that the source
    quotes. `navigation` is HTML: the links at the top of the page. `rights` is the sentence on
    licenses at the end of the PDF.
    """

    folder: Path
    title: str
    released: str
    gather: Callable[[Results], Mapping[str, Any]]
    long_studies: LongStudies = {}
    navigation: str = ""
    rights: str = ""

    def write(
        self, results: Results, html: str, pdf: str, metadata: str, live: LiveParts | None = None
    ) -> None:
        """Write the page with its `live` figures, the PDF, and the journal's metadata."""
        text, cards = self._link(results, PICTURES)
        folder, vectors = _folder(results), PICTURE_LINK.sub(r"](/\1.pdf)", text)
        with ThreadPoolExecutor(1) as pool:  # Typst and Pillow release Python's lock
            document = pool.submit(self.typeset, vectors, folder, cards)
            contents = {
                html: self._lay_out(text, folder, cards, live).encode(),
                metadata: self.describe(text).encode(),
                pdf: document.result(),
            }
        for path, content in contents.items():
            with complete_or_absent(path) as partial:
                Path(partial).write_bytes(content)

    def _link(self, results: Results, pictures: str) -> tuple[str, list[Card]]:
        """Return the article in Markdown with links to cards, and these cards."""
        cards = Cards(results, self.long_studies)
        text = self.source(results, pictures, cards)
        return text, cards.describe()

    def page(self, results: Results, live: LiveParts | None = None) -> str:
        """Return the article as an HTML page with its pictures and a card for each number."""
        text, cards = self._link(results, PICTURES)
        return self._lay_out(text, _folder(results), cards, live)

    def _lay_out(self, text: str, folder: Path, cards: list[Card], live: LiveParts | None) -> str:
        html = self.convert(text, "html", "--mathml", "--standalone")
        return complete_page(html, folder, cards, live)

    def pdf(self, results: Results, pictures: str) -> bytes:
        """Return the article as PDF, with an appendix on the origin of its numbers.

        `pictures` is the pattern of figures' paths, such as PICTURES, from the folder of results.
        """
        text, cards = self._link(results, pictures)
        return self.typeset(text, _folder(results), cards)

    def typeset(self, text: str, folder: Path, cards: Iterable[Card]) -> bytes:
        """Return the PDF of an article in Markdown; `folder` is the root of its pictures' paths.

        Equal articles give equal bytes.
        """
        code = self.convert(text, "typst")
        for picture, words in alternatives(text):
            alternative = f'"{picture}", alt: {json.dumps(words, ensure_ascii=False)}'
            code = code.replace(f'"{picture}"', alternative)
        appendix = json.dumps(self.appendix(list(cards)), ensure_ascii=False)
        return typst.compile(
            code.encode(),
            root=folder,
            ignore_system_fonts=True,
            sys_inputs={"appendix": appendix},
        )

    def appendix(self, cards: list[Card]) -> dict[str, list]:
        """Return the content of the appendix of the PDF."""
        return {
            "cards": list(map(_entry, cards)),
            "functions": [[code.short_name, code.file] for code in functions_of(cards)],
            "studies": [[study.command, name] for name, study in self.long_studies.items()],
        }

    def markdown(self, results: Results) -> str:
        """Return the article as a page of docs/, with the accepted pictures."""
        return self.source(results, f"../{BASELINE}/figures/{{}}.png")

    def describe(self, text: str) -> str:
        """Return the journal's metadata of the article in Markdown, as YAML, without links."""
        metadata = yaml.safe_load((self.folder / "metadata.yaml").read_text(encoding="utf-8"))
        abstract = text.split("**Abstract.**")[1].split("\n\n")[0]
        abstract = LINK_TO_CARD.sub(r"\1", abstract)
        metadata |= {"title": self.title, "abstract": " ".join(abstract.split())}
        return yaml.safe_dump(metadata, sort_keys=False, allow_unicode=True)

    def source(self, results: Results, pictures: str, cards: Cards | None = None) -> str:
        """Return the article in Markdown, or a notice if it would not be true of this run.

        `pictures` is the pattern of figures' paths, such as "figures/{}.png". If `cards` are given,
        numbers, verdicts and figures link to their cards, and pictures have captions. Otherwise
        there are no such links, and captions are paragraphs.
        """
        if results.differs:
            return self._notice([f"{in_short(list(results.differs.values()))}."])
        marked: dict[str, set[str]] = {mark: set() for mark in MARKS}
        environment = Environment(
            loader=FileSystemLoader(self.folder),
            undefined=StrictUndefined,
            finalize=lambda value: _write_value(value, cards),
            trim_blocks=True,
            lstrip_blocks=True,
        )
        text = environment.get_template("article.md.j2").render(
            title=self.title,
            figure=lambda name, caller: _picture(name, pictures.format(name), caller(), cards),
            **{mark: _recorder(claims, cards) for mark, claims in marked.items()},
            **self.gather(results),
        )
        text = re.sub(r"\$\s=\s+", f"${FIRM}={FIRM}", text)
        text = re.sub(r"(?m)^(\s*\d+)\. ", r"\1\\. ", text)  # or Pandoc would make a numbered list
        wrong = list(_untrue(marked, load(results)))
        if wrong and cards:
            cards.clear()
        return self._notice(wrong) if wrong else text

    def _notice(self, reasons: list[str]) -> str:
        summary = (
            "This run is not the one that the article describes. The report shows its results."
        )
        listed = "\n".join(f"- {reason}" for reason in reasons)
        return f"# {self.title}\n\n**Abstract.** {summary}\n\n{listed}\n"

    def convert(self, text: str, kind: str, *options: str) -> str:
        """Return Markdown converted to the `kind` "html" or "typst", with its template."""
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
        return pypandoc.convert_text(link_mentions(text), kind, MARKDOWN, [*settings, *options])


def _write_value(value: Any, cards: Cards | None) -> str:
    """Return a value of the template as Markdown, with a link to its card if there are cards."""
    if isinstance(value, list):
        return "".join(_write_value(entry, cards) for entry in value)
    if not isinstance(value, Printed) or cards is None:
        return str(value)
    card = cards.note(value)
    if cards.is_sign(value):
        return f'[{value.text}](#{card}){{.v aria-label="{cards.verdict(value)}"}}'
    row = cards.row_of(value)
    place = "" if row is None else f" data-row={row}"
    return f"[{value.text}](#{card}){{.n{place}}}"


def _picture(name: str, path: str, caption: str, cards: Cards | None) -> str:
    """Return a figure as Markdown; with cards it gets a caption that ends with a link."""
    if cards is None:
        return f"![{name}]({path})\n\n{caption}\n"
    card = cards.note(Printed("", Source(figure=name)))
    return f"![{' '.join(caption.split())} [{TO_CARD}](#{card}){{.source}}]({path})\n\n"


def _recorder(claims: set[str], cards: Cards | None) -> Callable[..., list[Printed]]:
    """Return a function for the template that adds names to `claims` and prints their verdicts."""

    def record(*names: str) -> list[Printed]:
        claims.update(names)
        return [cards.sign(name) for name in names] if cards else []

    return record


def _untrue(marked: Mapping[str, set[str]], rows: list[dict]) -> Iterator[str]:
    """Yield a sentence for each verdict that contradicts the article, or that it must mark."""
    for row in rows:
        stated = {mark for mark, claims in marked.items() if row["name"] in claims}
        right = {mark for mark, verdicts in MARKS.items() if row["verdict"] in verdicts}
        left_out = row["origin"] == Origin.PAPER and right - {"holds"} - stated
        if stated - right or left_out:
            yield f'The verdict on "{row["says"]}" ({row["place"]}) is: {row["verdict"]}.'


def _entry(card: Card) -> dict[str, str]:
    """Return a card's entry in the appendix of the PDF."""
    return {
        "id": card.id,
        "texts": ", ".join(card.texts),
        "title": card.title,
        "verdict": card.verdict,
        "criterion": card.criterion,
        "data": card.files[0].text,
        "function": card.code.short_name,
    }


def _folder(results: Results) -> Path:
    return results.path("claims.json").resolve().parent
