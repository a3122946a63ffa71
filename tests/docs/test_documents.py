"""The README and docs/ say what the accepted results say, and no number in them is typed.

Each page that quotes results is what its template gives. A template, and a page without one, holds
no digit and no number word outside of an expression, save where a rule below allows it: a name that
contains a digit, or a value that defines what the sentence is about. What expressions name comes
from facts.py.
"""

import re
from pathlib import Path

import facts
import numpy as np
import render
from pendula.varied import VARIATION, numbers_in

ROOT = Path(__file__).resolve().parents[2]
TEMPLATES = render.PAGES
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]

LEFT_OUT = [
    r"```.*?```",  # code: tests run the commands, the YAML and the notebook
    r"^    [^\n]*$",  # commands and code
    r"`[^`\n]*(\n[^`\n]+)?`",  # names of files, cases and commands
    r"\]\([^)]*\)",  # where a link leads
    r"\{\{.*?\}\}",  # facts
    # formulas; an inline one has no number of more digits but what the paper prints, and the last
    # detuning of a study
    r"\$\$.*?\$\$|\$(?:[^$\d]|\d(?![\d.])|0\.1\)|10\^\{-6\}|5\.5)+\$",
    r"^## References.*",
    r"\{%.*?%\}",
]
NAMES = [
    r"Fig(s|ure)?\s\d+(( to|,| and)\s\d+)*",
    r"\[\d\]",  # a reference
    r"^\| \d(?=,? )",  # a figure of the paper, in the table of figures
    r"Lemma \d|Table \d",
    r"Theorems?\s\d(\s(to|and)\s\d)?|Sections?\s\d( to \d)?",
    r"\bl2²?\b",  # a norm
    r"ode45|DOP853",
    r"netCDF-4|HDF5",
    r"Python 3\.11",  # the least version, which pyproject.toml says as well
    r"381 \(2017\) 3884|381,\n3884.3892 \(2017\)|arXiv[ :]1708\.06134",  # where the paper stands
    r"10\.1016/j\.physleta\.2017\.10\.021",
]
DEFINITIONS = [
    r"Ω = -?\d( and -?\d)?",  # the detuning of a case
    r"A = B = 0",
    r"printed 0\.1|order of\" 10⁻⁶",  # what the paper prints
]
WORDS = (
    r"\b(three|four|five|six|seven|eight|nine|ten|eleven|twelve|twenty|hundred|thousand|million|"
    r"twice|double|quarter|per cent)\b"
)
ALLOWED_WORDS = [
    r"double precision|double nearest",  # the type of a number
    r"twice the frequency",  # how the chain is driven
]


def strip(text: str, patterns: list[str]) -> str:
    """Return the text without what the patterns match."""
    for pattern in patterns:
        text = re.sub(pattern, " ", text, flags=re.DOTALL | re.MULTILINE)
    return text


def typed_numbers(text: str) -> list[str]:
    """Return the lines of a template on which a number stands that no rule allows."""
    left = strip(text, [*LEFT_OUT, *DEFINITIONS, *NAMES])
    words = strip(text, [*LEFT_OUT, *ALLOWED_WORDS])
    return [
        *(line.strip() for line in left.splitlines() if re.search(r"[\d½²³⁰¹⁴-⁹₀-₉]", line)),
        *(line.strip() for line in words.splitlines() if re.search(WORDS, line, re.IGNORECASE)),
    ]


def test_each_page_is_what_its_template_gives():
    texts = render.render()
    stale = [page.name for page in texts if page.read_text(encoding="utf-8") != texts[page]]
    assert stale == [], "run `python docs/render.py`"


def test_no_number_is_typed():
    texts = {page.name: TEMPLATES.get(page, page).read_text(encoding="utf-8") for page in PAGES}
    assert {name: typed_numbers(text) for name, text in texts.items() if typed_numbers(text)} == {}


def test_a_typed_number_is_found():
    typed = (
        "1.7 per unit of τ",
        "Fig 3 shows 35 %",
        "is 10⁻⁶",
        "nine in\nten runs",
        "at Ω = -4 to τ = 400",
    )
    assert [text for text in typed if not typed_numbers(text)] == []


def test_every_link_leads_to_a_file():
    links = []
    for page in [*PAGES, ROOT / "ARCHITECTURE.md"]:
        text = strip(page.read_text(encoding="utf-8"), [r"```.*?```", r"`[^`\n]*`"])
        links += [
            page.parent / link for link in re.findall(r"\]\(([^)#]+)", text) if "://" not in link
        ]
    assert links and [str(link) for link in links if not link.exists()] == []


def test_the_readme_is_one_page_and_leads_to_every_document():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    assert len(text.splitlines()) <= 100 and text.count("![") == 3
    for page in PAGES:
        assert page.name == "README.md" or f"(docs/{page.name})" in text


def test_the_readme_names_every_figure():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    figures = {path.stem for path in (ROOT / "tests/baseline/figures").glob("*.png")}
    numbered = {f"fig{number}" for number in re.findall(r"^\| (\d)", text, re.MULTILINE)}
    assert figures <= numbered | set(re.findall(r"`(\w+)`", text))


def test_a_choice_that_is_left_out_changes_no_bit_of_its_number():
    accepted, compared = facts.Accepted(), set()
    for study in facts.LONG_STUDIES:
        data = accepted[f"quoted/{study}"]
        for name in set(numbers_in(data)) & set(facts.WITHOUT_EFFECT):
            for label in map(str, data[VARIATION].values):
                with_choice = data[f"{name}_varied"].sel({VARIATION: label})
                choice = label.partition(" = ")[0]
                if choice in facts.WITHOUT_EFFECT[name]:
                    measured = with_choice.notnull()
                    np.testing.assert_array_equal(
                        with_choice.where(measured), data[name].where(measured)
                    )
                    compared.add((name, choice))
    assert compared == {
        (name, choice) for name, choices in facts.WITHOUT_EFFECT.items() for choice in choices
    }


def test_choices_of_numbers_are_written_in_words():
    data = facts.Accepted()["quoted/chaos"]
    assert facts.choice_in_words("window = (25.0, 60.0)") == "window of τ = 25 to 60"
    assert facts.choices_of(data["life"]).count("=") == 6  # of seven, less the level
    assert "_" not in "".join(map(facts.choices_of, map(data.get, numbers_in(data))))
