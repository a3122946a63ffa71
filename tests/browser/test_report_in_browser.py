"""The report in a real browser: nothing missing, nothing from outside, everything works."""

import json

import pytest
from waiting import wait_for

PHONE = 600


def resize(browser, width: int, height: int = 900) -> None:
    """Make the screen so many pixels large; narrow ones are a phone's."""
    size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < PHONE}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)


def run(report, script: str):
    return report.execute_script(f"return {script}")


def test_no_errors_and_no_request_but_the_page_and_its_pictures(report, address):
    assert report.get_log("browser") == []
    events = [json.loads(entry["message"])["message"] for entry in report.get_log("performance")]
    asked = [
        event["params"]["request"]["url"]
        for event in events
        if event["method"] == "Network.requestWillBeSent"
    ]
    assert address in asked
    own = ("data:", "chrome:")  # chrome: is the page of the browser that was open before
    asked = {url for url in asked if not url.startswith(own)}
    beside = address.replace("report.html", "figures/")
    assert {url for url in asked if not url.startswith(beside)} == {address}


def open_all(report) -> None:
    """Unfold all folded parts."""
    run(report, "document.querySelectorAll('details').forEach((one) => { one.open = true })")


def test_a_link_to_a_folded_claim_unfolds_it(report):
    folded = "document.querySelector('details .claim')"
    run(report, f"location.hash = {folded}.id")
    wait_for(lambda: run(report, f"{folded}.checkVisibility()"))


@pytest.mark.parametrize("width", [1280, 600, 390, 320])
def test_the_page_does_not_scroll_sideways(report, width):
    resize(report, width)
    open_all(report)
    assert run(report, "document.documentElement.scrollWidth") <= width
    assert run(report, "document.documentElement.clientWidth") == width
