"""The report in a real browser: nothing missing, nothing from outside, everything works."""

import json
import re

import numpy as np
import pytest
from latticode.datasets.json_files import load_json
from replication.ledger.rows import on_figure
from waiting import wait_for

PHONE = 600
SHIFT, ENTER, RIGHT, UP = "\ue008", "\ue007", "\ue014", "\ue013"


def resize(browser, width: int, height: int = 900) -> None:
    """Make the screen so many pixels large; narrow ones are a phone's."""
    size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < PHONE}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)


def run(report, script: str):
    return report.execute_script(f"return {script}")


def test_no_errors_and_no_request_but_the_page_and_its_pictures(report, address):
    assert report.get_log("browser") == []
    events = [json.loads(entry["message"])["message"] for entry in report.get_log("performance")]
    requested = [
        event["params"]["request"]["url"]
        for event in events
        if event["method"] == "Network.requestWillBeSent"
    ]
    assert address in requested
    inside = ("data:", "chrome:")  # chrome: is the page of the browser that was open before
    requested = {url for url in requested if not url.startswith(inside)}
    pictures = address.replace("report.html", "figures/")
    assert {url for url in requested if not url.startswith(pictures)} == {address}


def visible_claims(report) -> list[str]:
    """Return the names of the claims that are not filtered out, with their parts unfolded."""
    shown_names = "document.querySelectorAll('.claim:not([hidden])')"
    return run(report, f"[...{shown_names}].map((one) => one.id.slice(6))")


@pytest.mark.parametrize(
    ("control", "value", "keep"),
    [
        ("verdict", "confirmed", lambda row: row["verdict"] == "confirmed"),
        ("section", "4", lambda row: row["section"] == 4),
        ("kind", "theorem", lambda row: row["kind"] == "theorem"),
        ("figure", "5", lambda row: row in on_figure([row], 5)),
        ("search", "Theorem 2", lambda row: "theorem 2" in (row["place"] + row["says"]).lower()),
    ],
)
def test_claims_are_filtered(report, full_run, control, value, keep):
    rows = load_json(full_run / "results/claims.json")["rows"]
    expected = {row["name"] for row in rows if keep(row)}
    set_value = f"document.getElementById('{control}').value = '{value}'; filter();"
    report.execute_script(set_value)
    shown_names = set(visible_claims(report))
    assert expected and (
        expected == shown_names if control != "search" else expected <= shown_names
    )
    assert len(shown_names) < len(rows)
    assert run(report, "shown_count.textContent") == f"{len(shown_names)} of {len(rows)} claims"
    report.find_element("css selector", ".filters button").click()
    wait_for(lambda: len(visible_claims(report)) == len(rows))


def test_a_count_in_the_table_of_figures_shows_all_claims_that_it_counts(report, full_run):
    rows = load_json(full_run / "results/claims.json")["rows"]
    for link in report.find_elements("css selector", "a[data-filter]"):
        count = int(link.text.split()[0])
        report.execute_script("arguments[0].click()", link)
        names = visible_claims(report)
        assert len(names) == count
        verdicts = {row["verdict"] for row in rows if row["name"] in names}
        assert verdicts == {link.text.partition(" ")[2]}
        seen = "(name) => document.getElementById(`claim_${name}`).checkVisibility()"
        assert run(report, f"{names}.every({seen})")


def test_a_phone_needs_fewer_than_forty_screens(report):
    resize(report, 360, 740)
    assert run(report, "document.documentElement.scrollHeight / innerHeight") < 40


def open_all(report) -> None:
    """Unfold all folded parts."""
    run(report, "document.querySelectorAll('details').forEach((one) => { one.open = true })")


def test_a_link_to_a_folded_claim_unfolds_it(report):
    folded = "document.querySelector('details .claim')"
    run(report, f"location.hash = {folded}.id")
    wait_for(lambda: run(report, f"{folded}.checkVisibility()"))


def open_map(report, figure: str, panel: int = 0):
    """Return a panel of a figure that is a map, in the middle of the window."""
    open_all(report)
    maps = report.find_element("id", f"figures/{figure}").find_elements("css selector", ".map a")
    report.execute_script("arguments[0].scrollIntoView({block: 'center'})", maps[panel])
    return maps[panel]


def numbers_in(address: str) -> dict[str, float]:
    return {key: float(value) for key, value in re.findall(r"[#&](\w+)=(-?[\d.]+)", address)}


@pytest.mark.parametrize(
    ("figure", "panel", "place", "expected"),
    [
        ("stability_chart", 0, (0.75, 0.4), {"omega": 6, "gamma": 1.2}),
        ("fates", 0, (0.1, 0.3), {"a_re": 0.7, "b_re": 2.1, "omega": -4}),
    ],
)
def test_a_click_on_a_map_opens_the_case_there_in_the_live_page(
    report, figure, panel, place, expected
):
    link = open_map(report, figure, panel)
    box = report.execute_script("return arguments[0].getBoundingClientRect().toJSON()", link)
    across, up = place
    point = {"x": box["x"] + across * box["width"], "y": box["y"] + (1 - up) * box["height"]}
    for kind in ("mouseMoved", "mousePressed", "mouseReleased"):
        event = {"type": kind, **point, "button": "left", "clickCount": 1}
        report.execute_cdp_cmd("Input.dispatchMouseEvent", event)
    wait_for(lambda: "/live.html#" in report.current_url)
    wait_for(lambda: run(report, "typeof settings === 'object' && !isSolving"))
    numbers = numbers_in(report.current_url)
    assert {key: numbers[key] for key in expected} == pytest.approx(expected, abs=0.05)
    settings = run(report, "settings")
    assert {key: settings[key] for key in expected} == {key: numbers[key] for key in expected}
    assert run(report, "byId('fault').textContent") == ""


def test_keys_choose_on_a_map_and_open_the_case(report):
    link = open_map(report, "stability_chart")
    first = numbers_in(link.get_attribute("href"))
    link.send_keys(RIGHT, UP, SHIFT + UP)
    second = numbers_in(link.get_attribute("href"))
    steps = [second[key] - first[key] for key in ("omega", "gamma")]
    np.testing.assert_allclose(steps, (0.1, 0.11), atol=1e-6)
    assert link.accessible_name == f"Ω = {second['omega']:g}, γ = {second['gamma']:g}"
    address = link.get_attribute("href")
    link.send_keys(ENTER)
    wait_for(lambda: report.current_url.startswith(address))


def test_without_scripts_a_map_is_a_picture(report):
    report.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": True})
    try:
        report.refresh()
        figure = report.find_element("id", "figures/stability_chart")
        hidden = figure.find_elements("css selector", ".map, .chosen")
        assert len(hidden) == 2 and not any(element.is_displayed() for element in hidden)
        assert figure.find_elements("css selector", "a[href='figures/stability_chart.png'] img")
    finally:
        report.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": False})


@pytest.mark.parametrize("width", [1280, 600, 390, 320])
def test_the_page_does_not_scroll_sideways(report, width):
    resize(report, width)
    open_all(report)
    assert run(report, "document.documentElement.scrollWidth") <= width
    assert run(report, "document.documentElement.clientWidth") == width
