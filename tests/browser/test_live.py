"""The live page in a browser: it gets the accepted bits, and agrees with the library."""

import csv
import json

import numpy as np
import problems
import pytest
import yaml
from helpers import ROOT, snakemake
from latticode.datasets.netcdf import read, write
from latticode.measures.difference import first_above, norm_difference
from latticode.simulation.simulate import simulate
from oracle import CASES
from pendula.figure_diff import hashes
from pendula.live.write import write_live
from pendula.problem import Problem
from pendula.studies.breathers.fates import is_localised, power_by_distance
from pendula.studies.paper.runs import run_case
from test_report_in_browser import resize, run
from waiting import wait_for

BASELINE = ROOT / "tests/baseline"


def problem_of(case: str, **changes) -> Problem:
    """Return a problem as the page solves it."""
    solver = {"name": "ode45", "rtol": 1e-7, "atol": 1e-9}
    return problems.problem_of(case, **{"end_time": 50.0, "solver": solver, **changes})


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """Return the page on the paper's cases, made of runs that are found to be the accepted ones."""
    folder = tmp_path_factory.mktemp("live")
    accepted = json.loads((BASELINE / "hashes.json").read_text())["files"]
    runs = [folder / f"{case}.nc" for case in CASES]
    for case, path in zip(CASES, runs, strict=True):
        write(path, *run_case(case, problem_of(case, snapshot_every=4)))
        variables = accepted[f"trajectories/{path.name}"]["variables"]
        assert hashes.of(read(path))["variables"] == variables
    page = folder / "live.html"
    write_live([*map(str, runs)], BASELINE / "checks/trust.nc", str(page))
    assert page.stat().st_size < 400_000
    return page


def open_page(browser, address: str, motion: str = "reduce") -> None:
    """Open the page anew for a reader who asks for little motion, or for one who does not."""
    asked = {"features": [{"name": "prefers-reduced-motion", "value": motion}]}
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", asked)
    browser.get("about:blank")
    browser.get_log("browser"), browser.get_log("performance")
    browser.get(address)
    settle(browser)


@pytest.fixture
def live(browser, made):
    """Return the browser with the page just opened; afterwards nothing may be wrong with it."""
    browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
    open_page(browser, made.as_uri())
    yield browser
    assert browser.get_log("browser") == [] and text(browser, "fault") == ""
    told = [json.loads(entry["message"])["message"] for entry in browser.get_log("performance")]
    requests = [one["params"] for one in told if one["method"] == "Network.requestWillBeSent"]
    asked = {one["request"]["url"] for one in requests}
    assert {url for url in asked if not url.startswith(("data:", "blob:"))} == {made.as_uri()}


def text(page, name: str) -> str:
    return run(page, f"document.getElementById('{name}').textContent")


def settle(page) -> None:
    """Wait until all that the settings ask for is drawn."""
    wait_for(lambda: run(page, "Boolean(state) && !asked"))


def change(page, **settings) -> None:
    page.execute_script("apply({...settings, ...arguments[0]})", settings)
    settle(page)


def test_all_cases_have_the_accepted_bits(live):
    live.execute_script("location.hash = 'same-bits'")
    live.refresh()
    wait_for(lambda: text(live, "same-bits") == "6 of 6")
    settle(live)
    assert text(live, "bits").count("the same at all 2001 times") == 6


@pytest.mark.parametrize("wrong", ["energy[1200]", "linf[1][1200]", "modulus[1][4 * 501 + 300]"])
def test_a_wrong_number_is_reported_with_its_time(live, wrong):
    run_wrong = f"const run = right(given, steps); if (given.a_re === 5) run.{wrong} *= 1 + 1e-6;"
    run_wrong = f"const right = solve; solve = (given, steps) => {{ {run_wrong} return run; }};"
    live.execute_script(f"{run_wrong} compareAll()")
    assert text(live, "same-bits") == "3 of 6"
    assert text(live, "bits").count("first differs at τ = 30") == 3


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
    given = run(live, "settings")
    pair = [complex(given.pop(f"{name}_re"), given.pop(f"{name}_im")) for name in "ab"]
    problem = problem_of("fig2_small", **given, initial={0: pair}, snapshot_every=4)
    perturbed = problem.changed(initial=problem.initial * (1 + 1e-7))
    one, two = simulate(problem), simulate(perturbed)
    assert np.array_equal(run(live, "Array.from(run.energy)"), one.energy)
    states = np.moveaxis(one.modulus, -1, 0)
    left = [i for i, state in enumerate(states) if not is_localised(power_by_distance(state))]
    until = f"stays localised until τ = {one.tau[4 * left[0]]:.4g}." if left else "to the end."
    short = problem.half_width < 3
    assert text(live, "localised").endswith("no motion counts as localised." if short else until)
    parted = first_above(one.tau, norm_difference(one.linf, one.l2, two.linf, two.l2), 0.01)
    when = f"at τ = {parted:.4g} " if np.isfinite(parted) else "at no time"
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
    found = read(tmp_path / "results/trajectories/mine.nc")
    names, *rows = csv.reader((tmp_path / "mine.csv").read_text().splitlines())
    assert names == ["tau", "l2_A", "l2_B", "linf_A", "linf_B", "energy"]
    of_pipeline = [found["tau"], *found["l2"], *found["linf"], found["energy"]]
    assert np.array_equal(np.array(rows, float).T, np.array(of_pipeline))


def test_a_link_keeps_all_that_the_page_shows(live):
    live.execute_script("show('case=fig4_large&tau=12.25&mu=0.2&perturbation=1e-5')")
    settle(live)
    shown = [text(live, name) for name in ("numbers", "parted", "mu_said", "localised")]
    assert "At τ = 12.25:" in shown[0] and "factor 1 + 1e-5 " in shown[1]
    assert "Horizon of Fig 4: " in shown[1] and "(the dashed line)" in shown[1]
    open_page(live, live.find_element("id", "link").get_attribute("href"))
    assert [text(live, name) for name in ("numbers", "parted", "mu_said", "localised")] == shown


@pytest.mark.parametrize(
    ("link", "said"),
    [
        ("omega=abc", "omega = abc; this page can show -12 to 12 (step 0.1), and shows 8."),
        ("omega=99", "omega = 99; this page can show -12 to 12 (step 0.1), and shows 8."),
        ("omega=1.23", "omega = 1.23; "), ("omega=", "omega = ; "), ("mu=9", "mu = 9; "),
        ("case=fig4_small&omega=99", ", and shows 0."), ("tau=51", "can show 0 to 50 "),
        ("case=fig7", "fig4_large, and shows fig2_small."), ("boundary=", "boundary = ; "),
        ("detuning=1", "detuning, which is no setting."),
    ],
)  # fmt: skip
def test_a_link_that_the_page_cannot_show_is_told(live, link, said):
    live.execute_script(f"location.hash = '{link}'")
    wait_for(lambda: said in text(live, "fault"))
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
