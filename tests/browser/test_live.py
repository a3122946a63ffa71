"""The live page in a browser: it gets the accepted bits, and says what the library says."""

import base64
import csv
import json
import re
import shutil
import subprocess

import numpy as np
import pytest
import yaml
from helpers import ROOT, package, skip, snakemake_with, wait_for
from oracle import CASES
from pendula.datasets.netcdf import read
from pendula.figure_diff import hashes
from pendula.measures.difference import first_above, norm_difference
from pendula.simulation.simulate import simulate
from problems import problem_of
from report.write_live import write_live
from test_report_in_browser import resize, run
from trajectories.simulate_case import simulate_case

TOLERANCES = {"ode45": (1e-7, 1e-9), "taylor": (1e-14, 1e-14)}
SOLVERS = {name: {"name": name, "rtol": r, "atol": a} for name, (r, a) in TOLERANCES.items()}
BASELINE = ROOT / "tests/baseline"
FRAME = 50  # milliseconds


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """Return the page on the paper's cases, made of runs that are found to be the accepted ones."""
    folder = tmp_path_factory.mktemp("live")
    accepted = json.loads((BASELINE / "hashes.json").read_text())["files"]
    runs = {case: [folder / f"{case}.{solver}.nc" for solver in SOLVERS] for case in CASES}
    for case, paths in runs.items():
        problem = problem_of(case, end_time=50.0, snapshot_every=4)
        problems = [problem.changed(solver=solver).plain() for solver in SOLVERS.values()]
        simulate_case([str(path) for path in paths], case, problems)
        for path in paths:
            of_variables = accepted[f"trajectories/{path.name}"]["variables"]
            assert hashes.of(read(path))["variables"] == of_variables
    page = folder / "live.html"
    tables = BASELINE / "checks/trust.nc", BASELINE / "certified/lines.nc"
    write_live(
        [str(path) for paths in runs.values() for path in paths], *map(str, tables), str(page)
    )
    assert page.stat().st_size < 400_000
    return page


@pytest.fixture
def live(browser, made):
    """Return the browser with the page just opened; afterwards nothing may be wrong with it."""
    browser.get_log("browser"), browser.get_log("performance")
    browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
    browser.get("about:blank")
    browser.get(made.as_uri())
    settle(browser)
    yield browser
    assert browser.get_log("browser") == [] and text(browser, "fault") == ""
    told = [json.loads(entry["message"])["message"] for entry in browser.get_log("performance")]
    asked = [one["params"]["request"]["url"] for one in told
             if one["method"] == "Network.requestWillBeSent"]  # fmt: skip
    assert {url for url in asked if not url.startswith(("data:", "blob:", "about:"))} <= {
        made.as_uri()
    }


def text(page, name: str) -> str:
    return run(page, f"document.getElementById('{name}').textContent")


def settle(page) -> None:
    """Wait until all that the settings ask for is drawn."""
    wait_for(lambda: run(page, "state !== null && stage >= stages.length"))


def choose(page, case: int) -> None:
    script = "const box = document.getElementById('case'); box.selectedIndex = arguments[0];"
    page.execute_script(f"{script} box.dispatchEvent(new Event('change'))", case)
    settle(page)


def move(page, name: str, value: float) -> None:
    script = "const one = document.getElementById(arguments[0]); one.value = arguments[1];"
    page.execute_script(f"{script} one.dispatchEvent(new Event('input'))", name, value)
    settle(page)


def counted(page) -> str:
    wait_for(lambda: " of " in text(page, "same-bits"))
    return text(page, "same-bits")


def test_all_cases_have_the_accepted_bits(live, made):
    live.get(f"{made.as_uri()}#same-bits")
    live.refresh()
    assert counted(live) == "6 of 6"
    assert text(live, "bits").count("ode45 the same at all 2001 times, taylor the same") == 6


def test_a_wrong_bit_is_told_with_its_time(live, made, tmp_path):
    """One bit of Fig 3, large data, by Taylor at tau = 30: the marks of the page are changed."""
    found = re.search(
        r'(<script type="application/json" id="data">)(.*?)</script>', made.read_text()
    )
    data = json.loads(found[2])
    marks = bytearray(base64.b64decode(data["cases"][3]["marks"]["taylor"]))
    marks[4 * 1200] ^= 1
    data["cases"][3]["marks"]["taylor"] = base64.b64encode(marks).decode()
    wrong = tmp_path / "live.html"
    wrong.write_text(made.read_text().replace(found[2], json.dumps(data)))
    live.get(f"{wrong.as_uri()}#same-bits")
    assert counted(live) == "5 of 6"
    (line,) = live.find_elements("css selector", "#bits .other")
    told = "ode45 the same at all 2001 times, taylor first differs at τ = 30"
    assert line.get_attribute("textContent") == f"✗ {data['cases'][3]['title']}: {told}"
    live.get_log("performance")


def test_every_slider_changes_what_is_said_and_the_link(live):
    sliders = run(live, "SLIDERS.map(([key]) => key)")
    assert len(sliders) == 9
    for name in sliders:
        before = text(live, "numbers"), run(live, "location.href")
        slider = live.find_element("id", name)
        slider.send_keys("\ue014" if name != "half_width" else "\ue012" * 25)  # arrows: right, left
        settle(live)
        value = run(live, f"settings.{name}")
        assert text(live, "numbers") != before[0], name
        assert f"{name}={value}" in live.find_element("id", "link").get_attribute("href")
        exact = live.find_element("id", f"{name}_exact")
        assert (
            float(exact.get_attribute("value")) == value != run(live, f"chosen().settings.{name}")
        )
    link = live.find_element("id", "link").get_attribute("href")
    moved = text(live, "numbers")
    live.find_element("id", "reset").click()
    settle(live)
    assert text(live, "numbers") != moved
    live.get(link)
    settle(live)
    assert text(live, "numbers") == moved


def test_a_frame_takes_at_most_fifty_milliseconds(live):
    frames = []
    for step in range(12):
        move(live, "omega", 8 + 0.1 * step)
        frames.append(float(run(live, "document.body.dataset.frame")))
    assert min(frames) <= FRAME  # other work of the machine only adds to it


@pytest.mark.parametrize("case", ["fig2_small", "fig4_large"])
def test_perturbed_runs_part_when_the_library_says(live, case):
    choose(live, list(CASES).index(case))
    live.find_element("id", "perturb").click()
    settle(live)
    problem = problem_of(case, end_time=50.0, solver=SOLVERS["ode45"])
    one, two = (
        simulate(p) for p in (problem, problem.changed(initial=problem.initial * (1 + 1e-7)))
    )
    parted = first_above(one.tau, norm_difference(one.linf, one.l2, two.linf, two.l2), 0.01)
    told = f"at τ = {parted:.4g} " if np.isfinite(parted) else "at no time"
    assert told in text(live, "parted") and "Certified horizon" in text(live, "parted")


def test_the_exported_case_gives_the_numbers_of_the_page(live, tmp_path):
    choose(live, 5)
    for name, value in {"omega": -1.7, "a_im": 0.3, "half_width": 12, "end_time": 11}.items():
        move(live, name, value)
    folder = {"behavior": "allow", "downloadPath": str(tmp_path)}
    live.execute_cdp_cmd("Browser.setDownloadBehavior", folder)
    for kind in ("yaml", "csv"):
        live.find_element("id", kind).click()
        wait_for((tmp_path / f"mine.{kind}").exists)
    case = yaml.safe_load((tmp_path / "mine.yaml").read_text())
    ran = snakemake_with(case, ROOT, tmp_path, "results/trajectories/mine.nc")
    assert ran.returncode == 0, ran.stdout + ran.stderr
    dataset = read(tmp_path / "results/trajectories/mine.nc")
    rows = list(csv.reader((tmp_path / "mine.csv").read_text().splitlines()))
    assert rows[0] == ["tau", "l2_A", "l2_B", "linf_A", "linf_B", "energy"]
    of_pipeline = [dataset["tau"], *dataset["l2"], *dataset["linf"], dataset["energy"]]
    assert np.array_equal(np.array(rows[1:], float).T, np.array(of_pipeline))


def test_it_plays_and_marks_who_goes_over_the_top(live):
    choose(live, 5)
    move(live, "tau", 18)
    assert "Over the top at this τ: 0 of 122" in text(live, "swings")
    move(live, "mu", 0.4)
    amplitudes = simulate(problem_of("fig4_large", end_time=18.0, solver=SOLVERS["ode45"])).final
    over = int((0.8 * abs(amplitudes) > np.pi).sum())
    assert over > 0 and f"Over the top at this τ: {over} of 122" in text(live, "swings")
    play = live.find_element("id", "play")
    play.click()
    wait_for(lambda: run(live, "now()") > 18.5)
    play.click()
    assert play.text == "Play"
    settle(live)


@pytest.mark.parametrize("width", [1400, 390])
def test_it_does_not_scroll_sideways(live, width):
    resize(live, width)
    assert run(live, "document.documentElement.scrollWidth") <= width


def test_firefox_gets_the_same_bits(made, tmp_path):
    """Asked by WebDriver BiDi, which Firefox speaks without a driver."""
    websocket = package("websocket", "-r tests/browser/requirements.txt")
    program = shutil.which("firefox-esr") or shutil.which("firefox")
    if not program:
        skip("there is no Firefox", "apt-get install firefox-esr")
    flags = ("--headless", "--no-remote", "--profile", tmp_path, "--remote-debugging-port", "0")
    with subprocess.Popen([program, *flags], stderr=subprocess.PIPE, text=True) as firefox:
        try:
            lines = (line for line in firefox.stderr if "WebDriver BiDi listening on" in line)
            address = next(lines).split()[-1]
            socket = websocket.create_connection(f"{address}/session", suppress_origin=True)

            def call(method, **params):
                socket.send(json.dumps({"id": 1, "method": method, "params": params}))
                return next(r for r in iter(lambda: json.loads(socket.recv()), None) if "id" in r)[
                    "result"
                ]

            call("session.new", capabilities={})
            tab = call("browsingContext.getTree")["contexts"][0]["context"]
            call(
                "browsingContext.navigate",
                context=tab,
                url=f"{made.as_uri()}#same-bits",
                wait="complete",
            )
            asked = {
                "expression": "document.getElementById('same-bits').textContent",
                "awaitPromise": True,
            }
            said = lambda: call("script.evaluate", target={"context": tab}, **asked)["result"][
                "value"
            ]
            wait_for(lambda: " of " in said())
            assert said() == "6 of 6"
            socket.close()
        finally:
            firefox.terminate()
