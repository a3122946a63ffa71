"""The pages in Firefox: cards by pointer and key, the filters of the report, and the same bits."""

import json

import pytest
from firefox import Firefox
from latticode.datasets.json_files import load_json
from waiting import wait_for

ESCAPE, ENTER, RIGHT = "\ue00c", "\ue007", "\ue014"
IS_OPEN = "document.getElementById('panel').matches(':popover-open')"
BOUND = "document.querySelector('a.n[href$=\"fig4_large.nc.bound\"]')"


@pytest.fixture(scope="module")
def firefox(tmp_path_factory):
    started = Firefox(tmp_path_factory.mktemp("firefox"))
    yield started
    started.quit()


def test_cards_open_by_pointer_and_key(firefox, article_page):
    firefox.open(article_page.as_uri())
    firefox.run(f"{BOUND}.scrollIntoView({{block: 'center'}})")
    box = json.loads(firefox.run(f"JSON.stringify({BOUND}.getClientRects()[0])"))
    firefox.point_at(box["x"] + 3, box["y"] + box["height"] / 2)
    wait_for(lambda: firefox.run(IS_OPEN))
    assert "snakemake certified" in firefox.run("document.getElementById('panel').textContent")
    firefox.press(ESCAPE)
    wait_for(lambda: not firefox.run(IS_OPEN))
    firefox.run(f"{BOUND}.focus()")
    firefox.press(ENTER)
    wait_for(lambda: firefox.run("document.activeElement.id") == "panel")


@pytest.mark.parametrize("figure", [2, 3, 4])
def test_a_live_figure_has_the_bits_of_the_dataset(firefox, article_page, figure):
    firefox.open(article_page.as_uri())
    section = f"document.querySelector('#figure-{figure} + .run')"
    firefox.run(f"{section}.open = true")
    answer = f"{section}.querySelector('[data-part=answer]').textContent"
    bits = f"the bits of trajectories/fig{figure}_small.nc at all 2001 times."
    wait_for(lambda: bits in firefox.run(answer))


def test_all_cases_of_the_live_page_have_the_accepted_bits(firefox, live_page):
    firefox.open(f"{live_page.as_uri()}#same-bits")
    wait_for(lambda: firefox.run("document.getElementById('same-bits').textContent") == "6 of 6")


def test_claims_of_the_report_are_filtered(firefox, full_run):
    firefox.open((full_run / "results/report.html").resolve().as_uri())
    rows = load_json(full_run / "results/claims.json")["rows"]
    firefox.run("document.getElementById('kind').value = 'theorem'; filter()")
    visible = firefox.run("document.querySelectorAll('.claim:not([hidden])').length")
    assert visible == sum(row["kind"] == "theorem" for row in rows) > 0


def test_keys_choose_on_a_map_of_the_report_and_open_the_case(firefox, full_run):
    firefox.open((full_run / "results/report.html").resolve().as_uri())
    firefox.run("document.getElementById('more').querySelector('details').open = true")
    link = "document.getElementById('figures/stability_chart').querySelector('.map a')"
    firefox.run(f"{link}.focus()")
    firefox.press(RIGHT)
    address = firefox.run(f"{link}.href")
    assert address.endswith("live.html#case=fig4_small&omega=2.1&gamma=1.5")
    firefox.press(ENTER)
    wait_for(lambda: firefox.run("location.href").startswith(address))
