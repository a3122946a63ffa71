"""The live page in a browser: it gets the accepted bits, and agrees with the library."""

import csv
import json

import numpy as np
import pytest
import yaml
from helpers import ROOT, snakemake
from latticode.datasets.netcdf import read
from latticode.measures.difference import first_above, norm_difference
from latticode.simulation.simulate import simulate
from made_pages import problem_of
from pendula.studies.breathers.fates import is_localised, power_by_distance
from test_report_in_browser import resize, run
from waiting import wait_for


def open_page(browser, address: str, motion: str = "reduce") -> None:
    """Open the page anew for a reader who asks for little motion, or for one who does not."""
    asked = {"features": [{"name": "prefers-reduced-motion", "value": motion}]}
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", asked)
    browser.get("about:blank")
    browser.get_log("browser"), browser.get_log("performance")
    browser.get(address)
    settle(browser)


@pytest.fixture
def live(browser, live_page):
    """Return the browser with the page just opened; afterwards nothing may be wrong with it."""
    browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
    open_page(browser, live_page.as_uri())
    yield browser
    assert browser.get_log("browser") == [] and text(browser, "fault") == ""
    messages = [json.loads(entry["message"])["message"] for entry in browser.get_log("performance")]
    requests = [
        entry["params"] for entry in messages if entry["method"] == "Network.requestWillBeSent"
    ]
    asked = {entry["request"]["url"] for entry in requests}
    assert {url for url in asked if not url.startswith(("data:", "blob:"))} == {live_page.as_uri()}


def text(page, name: str) -> str:
    return run(page, f"document.getElementById('{name}').textContent")


def settle(page) -> None:
    """Wait until a run with the present settings is drawn."""
    wait_for(lambda: run(page, "Boolean(run) && !isSolving"))


def change(page, **settings) -> None:
    page.execute_script("apply({...settings, ...arguments[0]})", settings)
    settle(page)


def test_all_cases_have_the_accepted_bits(live):
    open_page(live, live.current_url.partition("#")[0] + "#same-bits")
    wait_for(lambda: text(live, "same-bits") == "6 of 6")
    settle(live)
    assert text(live, "bits").count("the same at all 2001 times") == 6


WRONG = {
    "energy": "run.energy[1200] *= 1 + 1e-6",
    "norm": "run.linf[1][1200] *= 1 + 1e-6",
    "modulus": "run.modulus = (...at) => modulus(...at) * (1 + 1e-6 * (at.join() === '1,4,1200'))",
}


@pytest.mark.parametrize("fault", WRONG.values(), ids=WRONG)
def test_a_wrong_number_is_reported_with_its_time(live, fault):
    live.execute_script(f"""
    const right = solve;
    solve = async (settings, outputStep) => {{
      const run = await right(settings, outputStep);
      const {{ modulus }} = run;
      if (settings.a_re === 5) {fault};
      return run;
    }};
    compareAll();
    """)
    wait_for(lambda: text(live, "same-bits") == "3 of 6")
    assert text(live, "bits").count("first differs at τ = 30") == 3


def all_sites(name: str) -> str:
    """Return the script for a function of the run at every site of B and its last output."""
    return f"Array.from({{length: run.sites}}, (_, n) => run.{name}(1, n, run.tau.length - 1))"


SETTINGS = {
    "as the paper": {},
    "localised": {"omega": 0, "a_re": 8, "b_re": 1},
    "chaotic": {"omega": 0, "a_re": 7, "b_re": 1},
    "A = B, free ends": {"boundary": "free", "half_width": 1, "a_re": 2, "b_re": 2},
    "a ring": {"boundary": "periodic", "half_width": 7, "a_im": -2, "b_re": 0.5},
    "a long chain": {"half_width": 64, "a_re": 0, "a_im": 5, "b_im": 1, "end_time": 5},
}


@pytest.mark.parametrize("changes", SETTINGS.values(), ids=SETTINGS)
def test_a_run_of_the_page_agrees_with_the_library(live, changes):
    """In its bits, how long the motion stays localised, and when a perturbed run diverges."""
    live.execute_script("byId('perturbation').value = '1e-7'")
    change(live, **changes)
    keys = run(live, "settings")
    pair = [complex(keys.pop(f"{name}_re"), keys.pop(f"{name}_im")) for name in "ab"]
    problem = problem_of("fig2_small", **keys, initial={0: pair}, snapshot_every=4)
    perturbed = problem.changed(initial=problem.initial * (1 + 1e-7))
    first, second = simulate(problem), simulate(perturbed)
    assert np.array_equal(run(live, "Array.from(run.energy)"), first.conserved["energy"])
    states = np.moveaxis(first.modulus, -1, 0)
    left = [i for i, state in enumerate(states) if not is_localised(power_by_distance(state))]
    until = f"stays localised until τ = {first.tau[4 * left[0]]:.4g}." if left else "to the end."
    assert np.array_equal(
        run(live, all_sites("modulus")), first.modulus[1, problem.half_width :, -1]
    )
    amplitudes = [complex(*re_and_im) for re_and_im in run(live, all_sites("amplitude"))]
    assert np.abs(amplitudes - first.final[1, problem.half_width :]).max() < 1e-13
    short = problem.half_width < 3
    assert text(live, "localised").endswith("no motion counts as localised." if short else until)
    difference = norm_difference(first.linf, first.l2, second.linf, second.l2)
    divergence = first_above(first.tau, difference, 0.01)
    when = f"at τ = {divergence:.4g} " if np.isfinite(divergence) else "at no time"
    assert f"1 % of full scale {when}" in text(live, "parted")


def test_the_exported_case_gives_the_numbers_of_the_page(live, tmp_path):
    change(live, omega=-1.7, a_re=5, a_im=0.3, half_width=12, end_time=11)
    folder = {"behavior": "allow", "downloadPath": str(tmp_path)}
    live.execute_cdp_cmd("Browser.setDownloadBehavior", folder)
    for kind in ("yaml", "csv"):
        live.find_element("id", kind).click()
        wait_for((tmp_path / f"mine.{kind}").exists)
    case = yaml.safe_load((tmp_path / "mine.yaml").read_text())
    command = (tmp_path / "mine.yaml").read_text().splitlines()[0].removeprefix("# ")
    assert f"\n{command}\n" in (ROOT / "docs/own_cases.md").read_text()
    ran = snakemake(ROOT, tmp_path, "results/trajectories/mine.nc", settings=case)
    assert ran.returncode == 0, ran.stdout + ran.stderr
    dataset = read(tmp_path / "results/trajectories/mine.nc")
    names, *rows = csv.reader((tmp_path / "mine.csv").read_text().splitlines())
    assert names == ["tau", "l2_A", "l2_B", "linf_A", "linf_B", "energy"]
    of_pipeline = [dataset["tau"], *dataset["l2"], *dataset["linf"], dataset["energy"]]
    assert np.array_equal(np.array(rows, float).T, np.array(of_pipeline))


def test_a_link_keeps_all_that_the_page_shows(live):
    live.execute_script("show('case=fig4_large&tau=12.25&mu=0.2&perturbation=1e-5')")
    settle(live)
    names = ("numbers", "parted", "mu_value", "localised")
    shown_texts = [text(live, name) for name in names]
    assert "At τ = 12.25:" in shown_texts[0] and "factor 1 + 1e-5 " in shown_texts[1]
    assert "Horizon of Fig 4: " in shown_texts[1] and "(the dashed line)" in shown_texts[1]
    open_page(live, live.current_url.partition("#")[0] + "#" + run(live, "String(linkOf())"))
    assert [text(live, name) for name in names] == shown_texts


def test_the_address_follows_each_change_and_back_undoes_it(live):
    def move(name: str, value: float) -> None:
        """Move a slider as a hand does: many inputs, then one change."""
        live.execute_script(f"""
        byId('{name}').value = {value};
        const events = ['input', 'input', 'change'].map((kind) => new Event(kind));
        for (const event of events) byId('{name}').dispatchEvent(event);
        """)
        settle(live)

    move("omega", 3)
    move("half_width", 12)
    assert "omega=3&half_width=12" in live.current_url
    live.refresh()
    settle(live)
    assert run(live, "[settings.omega, settings.half_width]") == [3, 12]
    for expected in ([3, 30], [8, 30]):
        live.back()
        wait_for(lambda: run(live, "[settings.omega, settings.half_width]") == expected)  # noqa: B023
        settle(live)


@pytest.mark.parametrize(("omega", "gamma"), [(-4.0, 1.0), (0.0, 2.0), (9.5, 0.5)])
def test_a_click_on_the_chart_of_stability_sets_omega_and_gamma(live, omega, gamma):
    """By the centre of the cell, which the picture has at the same place as the dataset."""
    live.execute_script("byId('chart').scrollIntoView({block: 'center'})")
    live.execute_script(
        """
        const canvas = byId("chart");
        const { left, top, width, height } = canvas.getBoundingClientRect();
        const [across, up] = arguments;
        canvas.dispatchEvent(new MouseEvent("click", {
          bubbles: true, clientX: left + across * width, clientY: top + (1 - up) * height }));
        """,
        (omega + 6.25) / 16.5,
        (gamma + 0.125) / 3.25,
    )
    settle(live)
    assert run(live, "[settings.omega, settings.gamma]") == pytest.approx([omega, gamma], abs=0.11)


def test_keys_play_and_move_the_time(live):
    """Space plays from anywhere but a button, and arrows move the time on a plot."""
    body = live.find_element("tag name", "body")
    live.execute_script("moveTo(0)")
    stops = live.execute_script("""
    return [...document.querySelectorAll("button, input, select, a, [tabindex]")]
      .slice(0, 5).map((one) => one.id);
    """)
    assert "play" in stops
    body.send_keys(" ")
    wait_for(lambda: text(live, "play") == "Pause" and run(live, "shownTime()") > 0)
    body.send_keys(" ")
    assert text(live, "play") == "Play"
    plot = live.find_element("id", "l2")
    live.execute_script("moveTo(20)")
    for key, time in (("\ue014", 21), ("\ue012", 20), ("\ue011", 0), ("\ue010", 50)):
        plot.send_keys(key)
        assert run(live, "shownTime()") == time
    assert plot.get_attribute("aria-valuetext").startswith("At τ = 50: ℓ² norms ")


def test_a_chain_at_rest_and_one_that_was_never_localised_are_named(live):
    change(live, a_re=0, b_re=0)
    assert text(live, "localised") == "The chain is at rest."
    assert text(live, "scaleA") == "|Aₙ| at site n, zero"


def test_a_slider_is_answered_while_a_long_run_is_solved(live):
    """The worker solves, so that the page draws frames meanwhile."""
    change(live, half_width=100, end_time=100, omega=0)
    frames = live.execute_async_script("""
    const [done] = arguments;
    apply({ ...settings, omega: 0.1 });
    let frames = 0;
    const count = () => {
      frames += 1;
      if (isSolving) requestAnimationFrame(count); else done(frames);
    };
    requestAnimationFrame(count);
    """)
    assert frames >= 3


@pytest.mark.parametrize(("slowed", "least"), [(1, 30), (6, 5)])
def test_a_long_chain_plays_without_solving_it_again(live, slowed, least):
    """Frames per second at M = 100 around tau = 90, by the browser's clock; a busy machine may
    halve them, and -s prints them."""
    change(live, half_width=100, end_time=100, omega=0, a_re=1, b_re=0.1)
    live.execute_cdp_cmd("Emulation.setCPUThrottlingRate", {"rate": slowed})
    try:
        frames = live.execute_async_script("""
        const [done] = arguments;
        moveTo(88.5);
        let frames = 0;
        const [draw, start] = [drawPendula, performance.now()];
        drawPendula = () => { frames += 1; draw(); };
        togglePlaying();
        setTimeout(() => {
          togglePlaying();
          done((1000 * frames) / (performance.now() - start));
        }, 3000);
        """)
    finally:
        live.execute_cdp_cmd("Emulation.setCPUThrottlingRate", {"rate": 1})
    print(f"{frames:.1f} frames per second on a processor {slowed} times slower")
    assert frames > least / 2


def test_numbers_of_a_link_are_taken_with_all_their_digits(live):
    """So a case between the steps of a slider, as of the map of fates, is that case."""
    live.execute_script("location.hash = 'case=fig3_large&omega=-4&a_re=4.623684211&end_time=70'")
    wait_for(lambda: run(live, "[settings.a_re, settings.end_time]") == [4.623684211, 70])
    settle(live)
    assert "a_re=4.623684211" in run(live, "String(linkOf())") and text(live, "fault") == ""


@pytest.mark.parametrize(
    ("link", "message"),
    [
        ("omega=abc", "omega = abc; this page can show -12 to 12 (step 0.1), and shows 8."),
        ("omega=99", "omega = 99; this page can show -12 to 12 (step 0.1), and shows 8."),
        ("half_width=2.5", "half_width = 2.5; "),
        ("omega=", "omega = ; "),
        ("mu=9", "mu = 9; "),
        ("case=fig4_small&omega=99", ", and shows 0."),
        ("tau=51", "can show 0 to 50 "),
        ("case=fig7", "fig4_large, and shows fig2_small."),
        ("boundary=", "boundary = ; "),
        ("detuning=1", "detuning, which is not a setting."),
    ],
)
def test_a_link_that_the_page_cannot_show_is_told(live, link, message):
    live.execute_script(f"location.hash = '{link}'")
    wait_for(lambda: message in text(live, "fault"))
    live.find_element("id", "reset").click()
    settle(live)
    assert text(live, "fault") == ""


WINDOWS = [(1400, 900), (1024, 768), (940, 700), (800, 600), (844, 390), (390, 844)]


@pytest.mark.parametrize(("width", "height"), [*WINDOWS, (575, 640), (320, 480)])
def test_no_picture_hides_a_control(live, width, height):
    """A control that gets the focus, from above or from below, is what a click there reaches."""
    resize(live, width, height)
    hidden = """
    const controls = [...document.querySelectorAll("button, input, select, a")];
    return [...controls, ...controls.reverse()].filter((one) => {
      one.focus();
      const { left, right, top, bottom } = one.getClientRects()[0];
      return !one.contains(document.elementFromPoint((left + right) / 2, (top + bottom) / 2));
    }).map((one) => one.id || one.textContent);
    """
    assert live.execute_script(hidden) == []
