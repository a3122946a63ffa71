"""The report in a real browser: nothing missing, nothing from outside, everything works."""

import base64
import json
import re

import pytest
from helpers import wait_for

PHONE = 600


def resize(browser, width: int) -> None:
    """Make the screen so many pixels wide; narrow ones are a phone's."""
    size = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": width < PHONE}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)


def run(report, script: str):
    return report.execute_script(f"return {script}")


def test_no_errors_and_no_request_but_the_page(report, address):
    assert report.get_log("browser") == []
    events = [json.loads(entry["message"])["message"] for entry in report.get_log("performance")]
    asked = [
        event["params"]["request"]["url"]
        for event in events
        if event["method"] == "Network.requestWillBeSent"
    ]
    assert address in asked
    own = ("data:", "chrome:")  # chrome: is the page of the browser that was open before
    assert {url for url in asked if not url.startswith(own)} == {address}


def test_every_picture_loads(report):
    run(report, "[...document.images].forEach((one) => { one.loading = 'eager' })")
    decoded = "const done = arguments[0]; Promise.all([...document.images].map("
    decoded += "(one) => one.decode())).then(() => done('all'), (fault) => done(String(fault)))"
    assert report.execute_async_script(decoded) == "all"
    widths = run(report, "[...document.images].map((one) => one.naturalWidth)")
    assert len(widths) >= 20 and min(widths) > 0


def open_all(report) -> None:
    """Unfold all folded parts."""
    run(report, "document.querySelectorAll('details').forEach((one) => { one.open = true })")


def test_a_link_to_a_folded_claim_unfolds_it(report):
    folded = "document.querySelector('details .claim')"
    run(report, f"location.hash = {folded}.id")
    wait_for(lambda: run(report, f"{folded}.checkVisibility()"))


def test_a_tap_on_a_picture_shows_it_in_full_size_and_another_closes_it(report):
    resize(report, 390)
    width = "document.querySelector('#figure_fig2 img').clientWidth"
    small, natural = run(report, width), run(report, width.replace("client", "natural"))
    assert small < 390 < natural
    for query, expected in {"a:has(img)": natural, "a.close": small}.items():
        link = report.find_element("css selector", f"#figure_fig2 {query}")
        report.execute_script("arguments[0].click()", link)
        wait_for(lambda expected=expected: abs(run(report, width) - expected) <= 2)
        assert run(report, "document.documentElement.scrollWidth") <= 390


@pytest.mark.parametrize("width", [1280, 600, 390, 320])
def test_the_page_does_not_scroll_sideways(report, width):
    resize(report, width)
    open_all(report)
    assert run(report, "document.documentElement.scrollWidth") <= width
    assert run(report, "document.documentElement.clientWidth") == width


def test_the_pendula_play_and_stop(report):
    open_all(report)
    players = report.find_elements("css selector", ".player")
    assert len(players) > 1
    for place, player in enumerate(players):
        button = player.find_element("css selector", "button")
        slider = f"document.querySelectorAll('.player input')[{place}]"
        run(report, f"{slider}.value = 0")
        report.execute_script("arguments[0].click()", button)
        assert button.text == "Pause"
        wait_for(lambda now=f"Number({slider}.value)": run(report, now) > 0)
        report.execute_script("arguments[0].click()", button)
        assert button.text == "Play" and run(report, f"Number({slider}.value)") > 0
        canvas = f"document.querySelectorAll('.player canvas')[{place}]"
        pixels = f"{canvas}.getContext('2d').getImageData(0, 0, {canvas}.width, 480).data"
        assert run(report, f"new Set({pixels}).size") > 2


def test_it_prints_with_the_still_picture(report):
    open_all(report)
    report.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    for query, display in {"svg.still": "block", "canvas": "none"}.items():
        seen = run(report, f"getComputedStyle(document.querySelector('{query}')).display")
        assert seen == display, query
    printed = report.execute_cdp_cmd("Page.printToPDF", {"paperWidth": 8.27, "paperHeight": 11.69})
    report.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
    pdf = base64.b64decode(printed["data"])
    assert pdf.startswith(b"%PDF") and len(re.findall(rb"/Type\s*/Page\b", pdf)) > 5
