"""Links from mentions such as "Figure 3" or "[1]", and alternative texts of pictures.

Both are added to the finished Markdown, which keeps the template readable.
"""

import re
from collections.abc import Iterator
from itertools import count

PLAIN_TEX = {
    r"\Omega": "Ω",
    r"\gamma": "γ",
    r"\varepsilon": "ε",
    r"\lambda": "λ",
    r"\alpha": "\N{GREEK SMALL LETTER ALPHA}",
    r"\delta": "δ",
    r"\tau": "τ",
    r"\mu": "μ",
    r"\ell^2": "ℓ²",
    r"\ell^\infty": "ℓ∞",
    r"\neq": "≠",
    r"\leq": "≤",
    r"\left": "",
    r"\right": "",
    "^2": "²",
    "_0": "₀",
    "_1": "₁",
    "_2": "₂",
    "_n": "ₙ",
}
"""Letters that replace the TeX of captions for screen readers."""
CAPTION = re.compile(r"^\*\*(Figure|Table) (\d+)\.\*\*", re.MULTILINE)
PICTURE = re.compile(r"^!\[(\*\*(?:Figure|Table) (\d+)\.\*\*.*)\]\(([^()\s]+)\)$", re.MULTILINE)
MENTION = re.compile(r"(?<!\*\*)\b(Figure|Table) (\d+)\b(?!\.\*\*)|\[(\d+)\](?![(\[:])")
REFERENCE = re.compile(r"^\[(\d+)\] ", re.MULTILINE)
HEADING = re.compile(r"^(##+) (.+)$", re.MULTILINE)
EQUATION = re.compile(r"^\$\$.+\$\$$", re.MULTILINE)
TABLE = re.compile(r"(?:^\|.*\n)+", re.MULTILINE)
REGION = 'tabindex=0 role=region aria-label="{}"'
"""Attributes that let wide tables get the focus, since arrow keys scroll only focused elements."""


def link_mentions(text: str) -> str:
    """Return the article in Pandoc's Markdown with ids and links.

    Headings, figures, tables, equations and references get ids. Mentions of figures, tables and
    references become links.
    """
    body, heading, references = text.partition("\n## References\n")
    places = {f"{kind.lower()}-{number}" for kind, number in CAPTION.findall(body)}
    places |= {f"figure-{number}" for _, number, _ in PICTURE.findall(body)}
    places |= {f"reference-{number}" for number in REFERENCE.findall(references)}

    def link(mention: re.Match) -> str:
        kind, number, reference = mention.groups()
        place = f"reference-{reference}" if reference else f"{kind.lower()}-{number}"
        words = rf"\[{reference}\]" if reference else f"{kind} {number}"
        return f"[{words}](#{place})" if place in places else mention[0]

    body = "\n".join(
        line if line.startswith(("![", "    ", "$$")) else MENTION.sub(link, line)
        for line in body.split("\n")
    )
    body = CAPTION.sub(r"[**\1 \2.**]{#table-\2}", body)
    body = PICTURE.sub(_describe, body)
    body = _number_equations(_frame_tables(body))
    references = REFERENCE.sub(r"[\\[\1\\]]{#reference-\1} ", references)
    return HEADING.sub(_with_id, f"{body}{heading}{references}")


def alternatives(text: str) -> Iterator[tuple[str, str]]:
    """Yield the path and the alternative text of each picture of the article in Markdown."""
    for caption, _, path in PICTURE.findall(text):
        yield path, describe_caption(caption)


def describe_caption(caption: str) -> str:
    """Return a caption as plain text; raise ValueError for TeX that is not in PLAIN_TEX."""
    for tex, letter in PLAIN_TEX.items():
        caption = caption.replace(tex, letter)
    caption = re.sub(r"\s*\[[^\]]*\]\([^)]*\)\{\.source\}", "", caption)
    caption = re.sub(r"\[([^\]]*)\]\([^)]*\)(\{\.n[^}]*\})?", r"\1", caption)
    words = re.sub(r"[$*{}]", "", caption)
    if "\\" in words:
        raise ValueError(f"add the TeX of this caption to PLAIN_TEX of {__name__}: {words}")
    return " ".join(words.split())


def _frame_tables(body: str) -> str:
    """Put each table into a region, and replace formulas in table headers by letters.

    Accessibility checkers regard a header cell with nothing but MathML as empty.
    """
    numbers = count(1)

    def frame(rows: re.Match) -> str:
        head, line_break, cells = rows[0].partition("\n")
        head = re.sub(r"\$[^$]*\$", lambda formula: f"*{describe_caption(formula[0])}*", head)
        region = REGION.format(f"Table {next(numbers)}")
        return f"::: {{{region}}}\n{head}{line_break}{cells}:::\n"

    return TABLE.sub(frame, body)


def _number_equations(body: str) -> str:
    numbers = count(1)
    region = REGION.format("Equation {}")

    def name(equation: re.Match) -> str:
        number = next(numbers)
        return f"[{equation[0]}]{{#equation-{number} {region.format(number)}}}"

    return EQUATION.sub(name, body)


def _describe(picture: re.Match) -> str:
    caption, number, path = picture.groups()
    words = describe_caption(caption).replace('"', "”")
    return f'![{caption}]({path}){{#figure-{number} alt="{words}"}}'


def _with_id(heading: re.Match) -> str:
    hashes, title = heading.groups()
    name = re.sub(r"\W+", "-", title.lower()).strip("-")
    return f"{hashes} {title} {{#{name}}}"
