"""A browser without a screen; where it, or what drives it, is missing, the tests are skipped."""

import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest
from helpers import package, skip
from made_pages import make_article, make_live_page

FLAGS = (
    "--headless=new",
    "--no-sandbox",
    "--disable-gpu",
    "--no-first-run",
    "--hide-scrollbars",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--window-size=1280,900",
)


def chromium() -> tuple[str, str]:
    """Return the paths of the browser and of its driver, or skip the test."""
    names = (("chromium", "chromium-browser", "google-chrome"), ("chromedriver",))
    programs = [next(filter(None, map(shutil.which, choice)), None) for choice in names]
    if not all(programs):
        skip("there is no browser with a driver", "apt-get install chromium chromium-driver")
    return programs[0], programs[1]


def driver(folder: Path, *flags: str):
    """Return a started browser that keeps a record of its messages and of its requests."""
    webdriver = package("selenium.webdriver", "-r tests/browser/requirements.txt")
    browser, program = chromium()
    options = webdriver.ChromeOptions()
    for flag in (*FLAGS, f"--user-data-dir={folder}", *flags):
        options.add_argument(flag)
    options.binary_location = browser
    options.set_capability("goog:loggingPrefs", {"performance": "ALL", "browser": "ALL"})
    service = webdriver.ChromeService(executable_path=program)
    return webdriver.Chrome(options=options, service=service)


@pytest.fixture(scope="session")
def browser(tmp_path_factory) -> Iterator:
    """Return a browser, started before the run that the tests need: it may not be there."""
    started = driver(tmp_path_factory.mktemp("profile"))
    yield started
    started.quit()


@pytest.fixture(scope="session")
def live_page(browser, tmp_path_factory) -> Path:
    """Return the path of the live page on the paper's cases."""
    return make_live_page(tmp_path_factory.mktemp("pages"))


@pytest.fixture(scope="session")
def article_page(live_page) -> Path:
    """Return the path of the article, beside the live page."""
    return make_article(live_page)


@pytest.fixture(scope="session")
def address(browser, full_run) -> str:
    """Return the address of the report of the quick run."""
    return (full_run / "results/report.html").resolve().as_uri()


@pytest.fixture
def report(browser, address):
    """Return the browser with the report just opened, on a wide screen."""
    browser.get_log("browser"), browser.get_log("performance")
    browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
    browser.get(address)
    return browser
