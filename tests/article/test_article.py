"""The article: its PDF, its page, its metadata, and the notice in its place on other runs."""

import re

import pytest
import yaml
from facts import BASELINE, Accepted
from helpers import ROOT
from html_tags import Tags
from pendula.article.write import ARTICLE
from replication.article import render
from replication.article.cards import Cards
from replication.ledger.rows import load

PICTURES = "/figures/{}.png"
"""The pictures of the accepted results, which have no PDF."""


def linked_source() -> tuple[str, Cards]:
    """Return the article in Markdown with links to cards, and these."""
    cards = Cards(Accepted(), ARTICLE.long_studies)
    return ARTICLE.source(Accepted(), PICTURES, cards), cards


def count_pages(pdf: bytes) -> int:
    return int(re.search(rb"/Count (\d+)", pdf)[1])


def without_code(page: str) -> str:
    """Return the page without pictures, scripts and functions."""
    pattern = r'src="[^"]*"|<script.*?</script>|<pre.*?</pre>|<style.*?</style>'
    return re.sub(pattern, "", page, flags=re.DOTALL)


@pytest.fixture(scope="module")
def page() -> str:
    """Return the page of the accepted results."""
    return ARTICLE.page(Accepted())


def test_equal_articles_have_equal_bytes_and_the_pages_that_a_journal_wants():
    text = re.sub(r"\[([^]]*)\]\(#(?:data_|claim_|figures/)[^)]*\)", r"\1", linked_source()[0])
    first, second = (ARTICLE.typeset(text, BASELINE, []) for _ in range(2))
    assert first == second
    date = yaml.safe_load((ROOT / "CITATION.cff").read_text())["date-released"]
    assert f"D:{date:%Y%m%d}".encode() in first and b"/Author" in first
    assert 6 <= count_pages(first) <= 9
    assert "width:" not in "".join(re.findall(r"image\(.*", ARTICLE.convert(text, "typst")))


def minutes_to_read(text: str) -> float:
    """Return how long paragraphs take at 220 words a minute; a formula is a word."""
    formulas = re.compile(r"\$[^$]*\$")
    paragraphs = re.split(r"\n\n+", formulas.sub("x", text))
    markup = ("|", "![", "**Figure", "**Table", "```", "# ")
    words = [paragraph.split() for paragraph in paragraphs if not paragraph.startswith(markup)]
    return sum(map(len, words)) / 220


def test_the_replication_is_read_in_ten_minutes_and_what_is_new_in_another_ten():
    """Without captions, tables and references."""
    text = (ROOT / "docs/article.md").read_text("utf-8").partition("\n## References")[0]
    replication, new = text.split("\n## Beyond the paper")
    assert minutes_to_read(replication) < 10
    assert minutes_to_read(new) < 10


def test_the_page_asks_no_network_and_its_formulas_are_set(page):
    assert "default-src 'none'" in page
    head = {tag["name"]: tag["content"] for tag in Tags(page).all("meta") if "name" in tag}
    date = str(yaml.safe_load((ROOT / "CITATION.cff").read_text())["date-released"])
    assert head["citation_publication_date"] == head["dcterms.date"] == date
    assert head["citation_author"] == "The pendula maintainers" and head["citation_title"]
    assert set(re.findall(r'src="([^,"]*)', page)) == {"data:image/png;base64"}
    assert "<ol" not in page  # a line that begins with a number and a full stop is no list
    assert page.count("<math") > 50 and "$" not in without_code(page)
    words = re.sub(r"<[^>]*>", " ", without_code(page))
    assert not re.findall(r"\b(?:nan|inf|None|Undefined)\b", words)


def test_the_metadata_have_what_the_journal_asks_for():
    metadata = yaml.safe_load(ARTICLE.describe(ARTICLE.source(Accepted(), "")))
    required = (
        "title authors affiliations keywords code data replication abstract bibliography type"
    )
    required += " domain language review contributors dates article journal"
    assert list(metadata) == required.split()
    assert metadata["title"].startswith("[Re] ") and len(metadata["abstract"].split()) > 100
    assert all(
        {"name", "orcid", "email", "affiliations"} == entry.keys() for entry in metadata["authors"]
    )
    assert {key for entry in metadata["replication"] for key in entry} == {
        "cite",
        "bib",
        "url",
        "doi",
    }


def test_a_run_of_other_cases_has_a_notice():
    other_run = Accepted()
    other_run.differs = {"cases.fig2_small.omega": "fig2_small.omega (1 in place of 8)"}
    text = ARTICLE.markdown(other_run)
    assert "fig2_small.omega (1 in place of 8)" in text and "## Introduction" not in text


@pytest.mark.parametrize(
    ("claim", "verdict"),
    [
        ("fig6_caption", "confirmed"),
        ("balance", "not reproduced"),  # of which the article says nothing while it holds
    ],
)
def test_another_verdict_gives_a_notice(monkeypatch, claim, verdict):
    rows = load(Accepted())
    changed = [row | {"verdict": verdict} if row["name"] == claim else row for row in rows]
    monkeypatch.setattr(render, "load", lambda _: changed)
    text = ARTICLE.markdown(Accepted())
    assert text.count(f"is: {verdict}.") == 1 and "## Introduction" not in text
