"""The article: its PDF, its page, its metadata, and the notice in its place on other runs."""

import re

import pytest
import yaml
from facts import BASELINE, Accepted
from helpers import ROOT
from html_tags import Tags
from pendula.article.write import ARTICLE
from replication.article import render
from replication.article.numbers import KEPT
from replication.ledger.rows import load


@pytest.fixture(scope="module")
def page() -> str:
    """Return the page of the accepted results."""
    return ARTICLE.page(Accepted())


def test_equal_articles_have_equal_bytes_and_the_pages_that_a_journal_wants():
    text = ARTICLE.source(Accepted(), "/figures/{}.png")  # the baseline has no PDF
    one, other = (ARTICLE.typeset(text, BASELINE) for _ in range(2))
    assert one == other
    date = yaml.safe_load((ROOT / "CITATION.cff").read_text())["date-released"]
    assert f"D:{date:%Y%m%d}".encode() in one and b"/Author" in one
    assert 6 <= int(re.search(rb"/Count (\d+)", one)[1]) <= 9
    assert "width:" not in "".join(re.findall(r"image\(.*", ARTICLE.convert(text, "typst")))


def test_the_page_asks_no_network_and_its_formulas_are_set(page):
    assert "default-src &#39;none&#39;" in page
    head = {tag["name"]: tag["content"] for tag in Tags(page).all("meta") if "name" in tag}
    date = str(yaml.safe_load((ROOT / "CITATION.cff").read_text())["date-released"])
    assert head["citation_publication_date"] == head["dcterms.date"] == date
    assert head["citation_author"] == "The pendula maintainers" and head["citation_title"]
    assert set(re.findall(r'src="([^,"]*)', page)) == {"data:image/png;base64"}
    assert "<ol" not in page  # a line that begins with a number and a full stop is no list
    assert page.count("<math") > 50 and "$" not in re.sub(r'src="[^"]*"', "", page)
    told = re.sub(r"<[^>]*>", " ", page)
    assert not re.findall(r"\b(?:nan|inf|None|Undefined)\b", told)


def test_each_linked_number_leads_to_its_dataset(page):
    links = re.findall(r'href="([^"]*\.nc)" class="n"', page)
    assert len(links) > 80
    assert all((BASELINE / link.removeprefix(f"{KEPT}/")).exists() for link in links)


def test_the_metadata_have_what_the_journal_asks_for():
    found = yaml.safe_load(ARTICLE.describe(ARTICLE.source(Accepted(), "")))
    required = (
        "title authors affiliations keywords code data replication abstract bibliography type"
    )
    required += " domain language review contributors dates article journal"
    assert list(found) == required.split()
    assert found["title"].startswith("[Re] ") and len(found["abstract"].split()) > 100
    assert all({"name", "orcid", "email", "affiliations"} == one.keys() for one in found["authors"])
    assert {key for one in found["replication"] for key in one} == {"cite", "bib", "url", "doi"}


def test_a_run_of_other_cases_has_a_notice():
    other = Accepted()
    other.differs = {"cases.fig2_small.omega": "fig2_small.omega (1 in place of 8)"}
    text = ARTICLE.markdown(other)
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
