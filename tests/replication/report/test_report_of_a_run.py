"""The whole page, of the quick run that the tests share: it shows all files, and links to them."""

import re

import pytest
from helpers import ROOT
from html_tags import Tags
from latticode.datasets.json_files import load_json


@pytest.fixture(scope="module")
def html(full_run) -> str:
    return (full_run / "results/report.html").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def tags(html) -> Tags:
    return Tags(html)


def test_the_page_is_well_formed_and_shows_every_claim_figure_and_dataset(tags, html, full_run):
    results = full_run / "results"
    assert tags.faults == [] and tags.open == [] and len(html) < 2e6
    assert len(tags.ids) == len(set(tags.ids))
    rows = load_json(results / "claims.json")["rows"]
    assert {name for name in tags.ids if name.startswith("claim_")} == {
        f"claim_{row['name']}" for row in rows
    }
    drawn = {path.stem for path in (results / "figures").glob("*.png")}
    drawn -= {name for name in drawn if name.startswith(("speed", "cost"))}
    assert {name for name in tags.ids if name.startswith("figures/")} == {
        f"figures/{n}" for n in drawn
    }
    needed = {f"data_{name}.nc" for row in rows for name in row["decided_by"]}
    assert needed <= set(tags.ids)


def test_no_number_is_missing_by_accident_and_nothing_of_the_machine_is_told(html, full_run):
    assert str(full_run) not in html and "/home/" not in html and str(ROOT) not in html
    text = re.sub(r"<style>.*?</style>", " ", html, flags=re.DOTALL)
    # hard cases are named with nan and inf
    text = re.sub(r'id="data_checks/hard_cases.nc".*?</details>', " ", text, flags=re.DOTALL)
    assert not re.findall(r"\b(?:nan|inf|None|Undefined)\b", re.sub(r"<[^>]*>", " ", text))


def test_every_picture_is_there_and_described(tags, full_run):
    pictures = tags.all("img")
    assert len(pictures) >= 17
    for picture in pictures:
        assert (full_run / "results" / picture["src"]).exists()
        assert len(picture["alt"]) > 20 and int(picture["width"]) > 0 < int(picture["height"])


def test_every_link_leads_to_a_file_of_the_run_or_to_a_part_of_the_page(tags, full_run):
    links = {link["href"] for link in tags.all("a") if "//" not in link["href"]}
    assert len([link for link in links if link.endswith(".nc")]) > 50
    for link in links:
        place = full_run / "results" / link.partition("#")[0]
        assert link[1:] in tags.ids if link.startswith("#") else place.exists(), link
