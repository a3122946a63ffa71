"""The pages by axe-core, a checker of accessibility that other people maintain."""

from importlib.util import find_spec
from pathlib import Path

import pytest
from helpers import skip
from test_report_in_browser import open_all, resize

THEMES = "light", "dark"
WIDTHS = 1280, 700, 390
PACKAGE = "axe_playwright_python"
"""It is installed for the script that it holds; the package itself is not imported."""


@pytest.fixture(scope="module")
def axe() -> str:
    spec = find_spec(PACKAGE)
    if spec is None:
        skip("axe-core is not there", "pip install -r tests/browser/requirements.txt")
    return (Path(spec.origin).parent / "axe.min.js").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def pages(full_run, live_page, article_page) -> dict[str, Path]:
    return {"article": article_page, "live": live_page, "report": full_run / "results/report.html"}


def find_violations(browser, axe: str) -> list[str]:
    """Return the rule, and an example, of each fault on the page that is open."""
    browser.execute_cdp_cmd("Runtime.evaluate", {"expression": axe})
    violations = browser.execute_async_script("""
    const [done] = arguments;
    axe.run({ resultTypes: ["violations"] }).then(({ violations }) =>
      done(violations.map(({ id, nodes }) => `${id}: ${nodes[0].html.slice(0, 200)}`)),
      (error) => done([`axe-core failed: ${error.message}`]));
    """)
    return violations


@pytest.mark.parametrize("name", ["article", "live", "report"])
def test_a_page_has_no_fault_in_both_themes_and_at_three_widths(browser, axe, pages, name):
    browser.set_script_timeout(600)
    faults = set()
    for theme in THEMES:
        features = [{"name": "prefers-color-scheme", "value": theme}]
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": features})
        for width in WIDTHS:
            resize(browser, width)
            browser.get(pages[name].as_uri())
            if name == "report":  # the article has hundreds of cards alike
                open_all(browser)
            faults.update(find_violations(browser, axe))
    assert faults == set()


def test_a_fault_is_found(browser, axe, tmp_path):
    page = tmp_path / "faulty.html"
    page.write_text("<title>T</title><main><h1>T</h1><img src='x.png'></main>", encoding="utf-8")
    browser.get(page.as_uri())
    assert any(fault.startswith("image-alt") for fault in find_violations(browser, axe))
