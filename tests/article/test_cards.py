"""Cards: what the article prints says where it comes from, and each of its links works alone."""

import re
import subprocess

import numpy as np
import pytest
from facts import BASELINE, Accepted
from helpers import ROOT
from html_tags import Tags
from latticode.datasets.json_files import load_json
from latticode.datasets.netcdf import read
from pendula.article.write import ARTICLE
from replication.article import sources
from replication.article.cards import Cards, tabulate
from replication.article.page import places_of
from replication.article.quoted import copy_of, copy_quoted, original_of
from replication.article.sources import Printed, Source, code_of, printed
from replication.words import symbols
from test_article import PICTURES, count_pages, linked_source

MOST_PAGES = 15
"""Nine of the article and six of the appendix."""
LARGEST = 4_000_000
"""Bytes of the page."""


@pytest.fixture(scope="module")
def page() -> str:
    return ARTICLE.page(Accepted())


@pytest.fixture(scope="module")
def cards() -> Cards:
    """Return the cards of all that the accepted article prints."""
    return linked_source()[1]


def links_of(page: str, kind: str) -> list[dict]:
    return [link for link in Tags(page).all("a") if link.get("class") == kind]


def test_each_number_verdict_and_figure_leads_to_its_card(page):
    ids = Tags(page).ids
    assert len(ids) == len(set(ids))
    numbers, signs, figures = (links_of(page, kind) for kind in ("n", "v", "source"))
    assert len(numbers) > 250 and len(signs) > 60 and len(figures) == page.count("<figure ")
    for link in (*numbers, *signs, *figures):
        assert link["href"].removeprefix("#") in ids
    assert {link["aria-label"] for link in signs} >= {"confirmed", "cannot be decided"}
    assert "tests/" not in "".join(link["href"] for link in Tags(page).all("a"))
    assert len(page.encode()) < LARGEST


def test_the_report_finds_places_of_the_article_by_its_own_ids(page, tmp_path):
    (tmp_path / "article.html").write_text(page, encoding="utf-8")
    places = places_of(tmp_path / "article.html")
    ids = {f"article.html#{name}" for name in Tags(page).ids}
    assert set(places.values()) <= ids and len(places) > 100
    assert places["figures/fates"] == "article.html#figure-8"
    assert {f"claim_{name}" for name in ("theorem_2", "energy_small")} <= places.keys()
    assert "data_checks/trust.nc.horizon" in places


@pytest.mark.parametrize(
    ("text", "card"),
    [
        ("77", "data_claims.json.verdicts"),  # statements
        ("32", "data_claims.json.verdicts"),  # of them with a caveat
        ("8.3 × 10⁻¹¹", "data_quoted/proofs/fig4_large.nc.bound"),
        ("2.6 × 10⁻¹⁴", "data_certified/breathers.nc.radius"),
        ("1.71 (1.64 to 1.77)", "data_checks/lyapunov.nc.exponent"),
        ("44", "data_quoted/reproduction.json"),  # seconds
        ("28", "data_quoted/reproduction.json"),
    ],
)
def test_a_headline_number_has_a_card(page, text, card):
    html = page.replace("\N{NO-BREAK SPACE}", " ")
    targets = re.findall(rf'<a href="#([^"]*)" class="n"[^>]*>{re.escape(text)}</a>', html)
    assert card in targets


def test_a_card_says_value_error_code_and_command(cards):
    by_id = {card.id: card for card in cards.describe()}
    study = read(BASELINE / "quoted/unbounded.nc")
    card = by_id["data_quoted/unbounded.nc.exponent"]
    assert card.is_long and card.command == "snakemake unbounded"
    assert card.title == symbols(study["exponent"].attrs["long_name"])
    assert card.table.head == ("detuning Ω", "value", "error", "statistical error")
    values = [float(row[1].replace("−", "-")) for row in card.table.rows]
    np.testing.assert_allclose(values, study["exponent"], rtol=1e-4)
    assert len(card.variations.rows) == int(study["exponent_varied"].notnull().any("omega").sum())
    assert card.code.name == study.attrs["computed_by"]
    assert "def vary_numbers(" in card.code.text
    number = printed("", "quoted/unbounded", "exponent", {"omega": 0.0})
    assert card.table.rows[cards.row_of(number)][0] == "0"


def test_the_card_of_a_claim_says_its_sentence_verdict_and_criterion(cards):
    rows = {row["name"]: row for row in load_json(BASELINE / "claims.json")["rows"]}
    of_claims = [card for card in cards.describe() if card.verdict]
    assert len(of_claims) > 60
    for card in of_claims:
        row = rows[card.id.removeprefix("claim_")]
        assert card.verdict == row["verdict"] and card.code.name == row["function"]
        assert len(card.table.rows) == len(row["measured"])
        assert card.claims[0].address == f"report.html#{card.id}"


def test_the_counts_of_claims_are_those_of_the_ledger(cards):
    (card,) = (card for card in cards.describe() if card.id == "data_claims.json.verdicts")
    rows = load_json(BASELINE / "claims.json")["rows"]
    total = sum(int(cell) for _, *cells in card.table.rows for cell in cells)
    assert total == len(rows)


def test_every_file_that_a_card_links_to_lies_below_the_results(cards, tmp_path):
    """The copies are made, and all other files are those of a full run."""
    addresses = {link.address for card in cards.describe() for link in card.files} - {""}
    quoted = {address for address in addresses if address.startswith("quoted/")}
    assert len(quoted) >= 10
    copy_quoted(
        [str(ROOT / original_of(name)) for name in quoted],
        [str(tmp_path / name) for name in quoted],
    )
    assert all((tmp_path / name).stat().st_size for name in quoted)
    of_run = load_json(BASELINE / "hashes.json")["files"]
    assert [name for name in addresses - quoted if name not in of_run] == []


@pytest.mark.parametrize(
    "original",
    ["tests/baseline/quoted/chaos.nc", "tests/baseline/proofs/fig2_small.nc"],
)
def test_a_copy_leads_back_to_its_original(original):
    assert original_of(copy_of(original)) == original and (ROOT / original).exists()


def test_the_pdf_has_an_appendix_with_an_entry_for_each_card(cards):
    pdf = ARTICLE.pdf(Accepted(), PICTURES)
    assert count_pages(pdf) <= MOST_PAGES
    assert pdf.count(b"/Dest") + pdf.count(b"/GoTo") > 250
    assert {entry["id"] for entry in ARTICLE.appendix(cards.describe())["cards"]} == {
        card.id for card in cards.describe()
    }


def test_git_knows_the_file_of_a_function_by_its_id():
    code = code_of("replication.article.sources.code_of")
    content = (ROOT / code.file).read_bytes()
    assert code.text.startswith("@cache\ndef code_of(") and code.text in content.decode()
    by_git = subprocess.run(
        ["git", "hash-object", code.file], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert by_git.stdout.startswith(code.blob)


def test_a_function_that_was_renamed_since_has_its_name_alone():
    assert code_of("pendula.studies.gone.made") == sources.Code("pendula.studies.gone.made")


def test_a_long_table_shows_the_printed_rows_alone():
    study = read(BASELINE / "quoted/unbounded.nc")
    table = tabulate(study, "distance", [{"omega": 0.0, "noise": "1e-16"}])
    assert [row[:2] for row in table.rows] == [("10⁻¹⁶", "0")]


def test_other_sources_have_other_cards():
    sources_of_cards = [
        Source("checks/trust", "horizon"),
        Source("checks/trust", "difference"),
        Source("checks/trust"),
        Source(claim="balance"),
        Source(figure="fig2"),
    ]
    assert len({source.card for source in sources_of_cards}) == len(sources_of_cards)
    assert str(Printed("5", sources_of_cards[0])) == "5"
