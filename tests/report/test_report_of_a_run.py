"""The whole page, of the quick run that the tests share: it stands alone and links to its data."""

import re

import numpy as np
import pytest
from accepted import BASELINE, settings, texts
from held_digits import blurred, unlike
from helpers import ROOT
from html_tags import Tags
from pendula import studies
from pendula.datasets.json_files import load_json
from pendula.ledger.section import Ledger
from pendula.report import results
from pendula.report.page import Picture
from pendula.report.results import Results


@pytest.fixture(scope="module")
def html(full_run) -> str:
    return (full_run / "results/report.html").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def tags(html) -> Tags:
    return Tags(html)


def test_the_page_is_well_formed_and_small_and_shows_every_claim_once(tags, html):
    assert tags.faults == [] and tags.open == [] and len(html) < 5e6
    assert len(tags.ids) == len(set(tags.ids))
    claims = load_json(BASELINE / "claims.json")["rows"]
    assert html.count('class="claim"') == html.count("data-verdict=") == len(claims)


def test_no_number_is_missing_by_accident_and_nothing_of_the_machine_is_told(html, full_run):
    assert str(full_run) not in html and "/home/" not in html
    text = re.sub(r"<(style|script)>.*?</\1>", " ", html, flags=re.DOTALL)
    # hard cases are named with nan and inf
    text = re.sub(r'<section id="hard_cases">.*?</section>', " ", text, flags=re.DOTALL)
    assert not re.findall(r"\b(?:nan|inf|None|Undefined)\b", re.sub(r"<[^>]*>", " ", text))


def test_every_picture_is_within_and_described(tags):
    pictures = tags.all("img")
    assert len(pictures) >= 20
    for picture in pictures:
        assert picture["src"].startswith("data:image/png;base64,")
        assert len(picture["alt"]) > 20 and int(picture["width"]) > 0 < int(picture["height"])
    alts = [picture["alt"] for picture in pictures]
    assert len(alts) == len(set(alts))


def test_nothing_is_asked_of_the_network(tags, html):
    for tag, attributes in tags.tags:
        for name in ("src", "srcset", "poster", "data", "action"):
            assert not re.match(r"(https?:)?//", attributes.get(name) or ""), (tag, attributes)
    assert [link["href"] for link in tags.all("link")] == ["data:,"]
    styles = " ".join(re.findall(r"<style>(.*?)</style>", html, re.DOTALL))
    assert "url(" not in styles and "@import" not in styles
    outside = {link["href"] for link in tags.all("a") if "//" in link["href"]}
    assert all(re.match(r"https://(doi|arxiv)\.org/", link) for link in outside)


def test_every_link_leads_to_a_file_of_the_run_or_to_a_part_of_the_page(tags, full_run):
    links = {link["href"] for link in tags.all("a") if "//" not in link["href"]}
    assert len([link for link in links if link.endswith(".nc")]) > 50
    for link in links:
        of_project = link.startswith("../")
        place = ROOT / link.removeprefix("../") if of_project else full_run / "results" / link
        assert link[1:] in tags.ids if link.startswith("#") else place.exists(), link


class Blurred(Results):
    """The files of a run with every number moved by half of the last digit that is held."""

    def __getitem__(self, name):
        if name not in self._read:
            self._read[name] = blurred(super().__getitem__(name), np.random.default_rng(len(name)))
        return self._read[name]


def said(kind: type[Results], run) -> dict[str, str]:
    """Return all that the sections of the studies print."""
    files = [str(path) for path in (run / "results").rglob("*") if path.is_file()]
    references = sorted(map(str, (ROOT / "tests/baseline/reference").glob("*.nc")))
    found = kind(files, str(run / "results/report.html"), settings("quick"), None, references)
    ledger = Ledger(found)
    return {
        f"{section.name}{place}": text
        for module in studies.all_modules("section")
        for section in getattr(module, "SECTIONS", ())
        for place, text in texts(section.gather(found, ledger)).items()
    }


def test_the_report_prints_no_digit_that_its_datasets_do_not_hold(full_run, monkeypatch):
    monkeypatch.setattr(results, "picture", lambda path, *words: Picture("", 1, 1, *words))
    before, after = (said(kind, full_run) for kind in (Results, Blurred))
    moved = {place: (text, after.get(place, "")) for place, text in before.items()}
    assert len(before) > 300
    assert {place: pair for place, pair in moved.items() if unlike(*pair)} == {}
