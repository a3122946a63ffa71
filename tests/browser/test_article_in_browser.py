"""The article in a browser: its cards by pointer, key and finger, and its figures that run."""

import base64
import re

import numpy as np
import pytest
from latticode.datasets.netcdf import read
from latticode.measures.difference import first_above, norm_difference
from latticode.simulation.simulate import simulate
from made_pages import BASELINE, problem_of
from test_report_in_browser import resize, run
from waiting import wait_for

ESCAPE, ENTER, TAB = "\ue00c", "\ue007", "\ue004"
BOUND = 'a.n[href$="fig4_large.nc.bound"]'
"""The links of the proven bound, a headline number."""


@pytest.fixture
def article(browser, article_page):
    """Return the browser with the article just opened; afterwards nothing may be wrong with it."""
    browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
    browser.get("about:blank")
    browser.get_log("browser")
    browser.get(article_page.as_uri())
    yield browser
    assert browser.get_log("browser") == []


def find(article, selector: str):
    """Return the first element of a selector, in the middle of the window."""
    element = article.find_element("css selector", selector)
    article.execute_script("arguments[0].scrollIntoView({block: 'center'})", element)
    return element


def is_open(article) -> bool:
    return run(article, "document.getElementById('panel').matches(':popover-open')")


def panel_text(article) -> str:
    return run(article, "document.getElementById('panel').textContent")


def point_at(article, element) -> None:
    """Move the mouse onto an element in the window."""
    box = article.execute_script("return arguments[0].getClientRects()[0].toJSON()", element)
    move = {"type": "mouseMoved", "x": box["x"] + 2, "y": box["y"] + box["height"] / 2}
    article.execute_cdp_cmd("Input.dispatchMouseEvent", move)


def test_a_card_shows_while_the_pointer_is_on_its_number_or_on_the_card(article):
    point_at(article, find(article, BOUND))
    wait_for(lambda: is_open(article))
    assert "snakemake certified" in panel_text(article) and "certify_curve" in panel_text(article)
    point_at(article, article.find_element("id", "panel"))
    article.execute_async_script("setTimeout(arguments[0], 600)")
    assert is_open(article)
    point_at(article, find(article, "h1"))
    wait_for(lambda: not is_open(article))


def test_a_card_is_reached_and_left_by_keys(article):
    number = find(article, BOUND)
    article.execute_script("arguments[0].focus({focusVisible: true})", number)
    wait_for(lambda: is_open(article))
    number.send_keys(ESCAPE)
    assert not is_open(article)
    number.send_keys(ENTER)
    assert is_open(article) and run(article, "document.activeElement.id") == "panel"
    article.find_element("id", "panel").send_keys(TAB)
    assert run(article, "document.activeElement.closest('#panel') !== null")
    article.switch_to.active_element.send_keys(ESCAPE)
    assert not is_open(article)
    assert run(article, "document.activeElement.className") == "n"


def test_a_card_opens_by_a_tap_inside_the_screen_of_a_phone(article):
    resize(article, 390, 844)
    article.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": True})
    number = find(article, BOUND)
    box = article.execute_script("return arguments[0].getClientRects()[0].toJSON()", number)
    point = {"x": box["x"] + 2, "y": box["y"] + box["height"] / 2}
    for kind, points in (("touchStart", [point]), ("touchEnd", [])):
        event = {"type": kind, "touchPoints": points}
        article.execute_cdp_cmd("Input.dispatchTouchEvent", event)
    wait_for(lambda: is_open(article))
    box = run(article, "document.getElementById('panel').getBoundingClientRect().toJSON()")
    article.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": False})
    assert box["left"] >= 0 and box["right"] <= 390 and box["top"] >= 0 and box["bottom"] <= 844


@pytest.mark.parametrize(
    ("selector", "words"),
    [
        ('a[href="#reference-4"]', "Solving Ordinary Differential Equations I"),
        ('a[href="#figure-8"]', "Fate of an excited central pair"),
        ('a[href="#table-2"]', "Lyapunov exponents"),
        ("a.v", "Criterion: "),
        ('a.source[href="#figures/fig3"]', "draw_norms"),
        ('a.n[href="#data_claims.json.verdicts"]', "confirmed with a caveat"),
    ],
)
def test_a_click_shows_what_a_link_leads_to(article, selector, words):
    article.execute_script("arguments[0].click()", find(article, selector))
    assert is_open(article) and words in panel_text(article)


def test_the_row_of_the_number_is_marked_and_the_function_is_shown(article):
    number = find(article, 'a.n[href="#data_checks/lyapunov.nc.exponent"]')
    article.execute_script("arguments[0].click()", number)
    row = run(article, "document.querySelector('#panel .printed').textContent")
    study = read(BASELINE / "checks/lyapunov.nc")
    assert row.startswith("fig3_large")
    assert f"{float(study['exponent'].sel(case='fig3_large')):.4g}"[:4] in row
    article.execute_script("document.querySelector('#panel a[href^=\"#code_\"]').click()")
    assert panel_text(article).strip().startswith("measure_lyapunov in scripts/pendula/studies/")


def test_without_scripts_a_number_leads_to_its_card(article):
    """As it does for a reader who follows the address with the card's name."""
    article.get(article.current_url.partition("#")[0] + "#data_checks/trust.nc.horizon")
    card = "document.getElementById('data_checks/trust.nc.horizon')"
    wait_for(lambda: run(article, f"{card}.checkVisibility()"))


def open_run(article, figure: int):
    """Open the live figure below a figure, and return it."""
    section = find(article, f"#figure-{figure} + .run")
    article.execute_script("arguments[0].open = true", section)
    return section


def set_control(article, section, name: str, value) -> None:
    article.execute_script(
        "const [section, name, value] = arguments; const part ="
        " section.querySelector(`[data-part='${name}']`);"
        "if (typeof value === 'boolean') part.checked = value; else part.value = value;"
        "section.querySelector('[data-part=answer]').textContent = '';"
        "part.dispatchEvent(new Event('input', { bubbles: true }));",
        section,
        name,
        value,
    )


def answer_of(section) -> str:
    """Return what a live figure says when its run is there."""
    answer = section.find_element("css selector", "[data-part=answer]")
    wait_for(lambda: answer.text)
    return answer.text


@pytest.mark.parametrize("figure", [2, 3, 4])
@pytest.mark.parametrize("size", ["small", "large"])
def test_a_live_figure_has_the_bits_of_the_dataset(article, figure, size):
    section = open_run(article, figure)
    set_control(article, section, "case", f"fig{figure}_{size}")
    bits = f"the bits of trajectories/fig{figure}_{size}.nc at all 2001 times."
    wait_for(lambda: bits in answer_of(section))


def test_a_live_figure_reports_other_bits_and_their_time(article, article_page):
    """A page whose mark of fig2_small at its output 1200 is another."""
    text = article_page.read_text(encoding="utf-8")
    marks = re.search(r'"name": "fig2_small".*?"marks": "([^"]*)"', text)[1]
    content = bytearray(base64.b64decode(marks))
    content[4 * 1200] ^= 1
    edited = article_page.with_name("other_bits.html")
    edited.write_text(text.replace(marks, base64.b64encode(content).decode()), encoding="utf-8")
    article.get(edited.as_uri())
    words = "the bits of ode45 differ from trajectories/fig2_small.nc from τ = 30 on."
    assert words in answer_of(open_run(article, 2))


@pytest.mark.parametrize(("step", "perturbation"), [(1, 1e-12), (7, 1e-6), (12, 1e-1)])
def test_the_slider_shows_when_a_perturbed_run_leaves_the_first(article, step, perturbation):
    section = open_run(article, 3)
    set_control(article, section, "case", "fig3_large")
    set_control(article, section, "perturbation", step)
    problem = problem_of("fig3_large")
    first, second = (
        simulate(problem.changed(initial=problem.initial * factor))
        for factor in (1, 1 + perturbation)
    )
    difference = norm_difference(first.linf, first.l2, second.linf, second.l2)
    time = first_above(first.tau, difference, 0.01)
    wait_for(lambda: f"from ode45's by 1 % of full scale at τ = {time:.4g}." in answer_of(section))


@pytest.mark.parametrize("layer", ["run", "ode45", "reference", "ensemble"])
def test_each_layer_is_two_curves_a_panel_that_can_be_left_out(article, layer):
    section = open_run(article, 4)
    answer_of(section)
    counts = {}
    for is_shown in (True, False):
        set_control(article, section, layer, is_shown)
        answer_of(section)
        selector = "[data-part=linf] polyline:is(.a, .b)"
        counts[is_shown] = len(section.find_elements("css selector", selector))
    assert counts[True] == counts[False] + 2


def test_a_click_on_the_map_of_fates_opens_that_case_in_the_live_page(article, live_page):
    section = find(article, ".maps")
    article.execute_script("arguments[0].open = true", section)
    canvas = section.find_element("css selector", "canvas")
    wait_for(lambda: section.find_element("css selector", "output").text)
    for place in ((0.2, 0.1), (0.72, 0.15), (0.9, 0.9)):
        article.execute_script(
            """
        const [canvas, [across, up]] = arguments;
        const { left, top, width, height } = canvas.getBoundingClientRect();
        const at = { clientX: left + across * width, clientY: top + (1 - up) * height };
        canvas.dispatchEvent(new MouseEvent("click", { bubbles: true, ...at }));
        """,
            canvas,
            place,
        )
        link = section.find_element("css selector", "a").get_attribute("href")
        a0, b0 = (float(re.search(rf"{name}_re=([\d.]+)", link)[1]) for name in "ab")
        np.testing.assert_allclose((a0, b0), np.multiply(place, 7.0), atol=0.05)
        study = read(BASELINE / "quoted/breathers.nc")
        fate = study["fate"].sel(omega=-4.0).sel(a0=a0, b0=b0, method="nearest")
        words = ("disperses", "stays localised", "moves away", "spreads")[int(fate)]
        output = section.find_element("css selector", "output").text
        assert output == f"This motion {words}."
    assert link.startswith(live_page.as_uri())


def test_pictures_stay_without_scripts(article):
    article.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": True})
    try:
        article.refresh()
        seen = article.find_elements("css selector", "figure img")
        assert len(seen) >= 11 and all(picture.is_displayed() for picture in seen)
        assert not article.find_element("css selector", ".run").is_displayed()
    finally:
        article.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": False})


@pytest.mark.parametrize("width", [1280, 600, 390, 320])
def test_the_article_does_not_scroll_sideways(article, width):
    resize(article, width)
    article.execute_script("document.querySelectorAll('details').forEach((d) => { d.open = true })")
    assert run(article, "document.documentElement.scrollWidth") <= width
