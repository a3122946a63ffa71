"""What a person reads: the list of targets, the screen of a run, and its last lines."""

import re
import sys
from types import SimpleNamespace

import pytest
import targets
from helpers import ROOT, snakemake_with


@pytest.fixture(scope="module")
def listed(looked):
    """Return {group: {target: text}} as `snakemake --list` prints them."""
    *blocks, _ = (looked / "list.txt").read_text().split("\n\n")
    heads = [block.partition("\n") for block in blocks]
    return {head: dict(map(member, lines.splitlines())) for head, _, lines in heads}


def member(line):
    return re.fullmatch(r"  (\w+)  +(\S.*)", line).groups()


@pytest.fixture(scope="module")
def texts(listed):
    return {name: text for group in listed.values() for name, text in group.items()}


def rules():
    """Return the text of each rule in the files of rules by its head, as far as that has a name."""
    files = [ROOT / "Snakefile", *ROOT.glob("workflow/rules/*.smk"), *ROOT.glob("benchmarks/*.smk")]
    head = re.compile(r"^((?:use )?rule \w.*):\n", re.MULTILINE)
    found = {}
    for file in files:
        parts = head.split(file.read_text())
        found.update(zip(parts[1::2], parts[2::2], strict=True))
    return found


def test_every_target_stands_in_its_group(listed):
    some = {
        "all": targets.WHOLE,
        "fig2": targets.FIGURES,
        "fig2_spacetime": targets.FIGURES,
        "fig5_left": targets.STUDIES,
        "unbounded": targets.STUDIES,
        "check_bounds": targets.CHECKS,
        "claims": targets.CHECKS,
        "own": targets.OWN,
        "figure_diff": targets.UPKEEP,
        "speed": targets.UPKEEP,
    }
    assert some == {name: group for group in listed for name in some if name in listed[group]}
    assert list(targets.GROUPS) == list(listed)


def test_what_is_no_target_is_told_with_the_nearest_before_anything_runs(tmp_path):
    words = ["figure2", "qqqq", "trajectory", "mine", "fig2", "results/trajectories/mine.nc"]
    words += ["results/trajectories/fig2_small.rk4.nc", "results/trajectories/mine.ode45.nc"]
    result = snakemake_with({"cases": {"mine": {"omega": 1}}}, ROOT, tmp_path, *words)
    assert result.returncode == 1 and "Exception" not in result.stdout + result.stderr
    said = result.stderr.splitlines()
    assert any(
        re.fullmatch("there is no target figure2; did you mean .*fig2.*all", x) for x in said
    )
    assert "there is no target qqqq. `snakemake --list` shows all" in said
    assert "a sweep of your own, and the target own makes" in result.stderr
    assert "fig2_small.rk4.nc; did you mean results/trajectories/fig2_small.nc" in result.stderr
    assert "trajectory makes more than one file: name the file" in result.stderr
    assert len([line for line in said if line.startswith(("there is no", "nothing"))]) == 4
    assert not (tmp_path / "results/trajectories/mine.nc").exists()


def test_each_text_is_of_one_target_alone(texts):
    assert len(set(texts.values())) == len(texts)
    assert "None" not in texts.values()


def test_what_needs_a_wildcard_is_not_listed_and_all_else_is(texts):
    made_by_pattern = {"trajectory", "own_sweep", "spread", "compile_solver", "reference_case"}
    assert not made_by_pattern & texts.keys()
    own = {head: text for head, text in rules().items() if not head.startswith("use")}
    plain = {head for head, text in own.items() if "wildcard_constraints" not in text}
    assert {head.removeprefix("rule ") for head in plain} <= texts.keys()


def test_every_name_in_the_tables_of_the_readme_is_a_target(texts):
    rows = [line for line in (ROOT / "README.md").read_text().splitlines() if line[:1] == "|"]
    quoted = [words for row in rows for words in re.findall("`(.+?)`", row)]
    names = {name for words in quoted for name in words.split()} - {"snakemake"}
    assert {"fig1", "fig2_spacetime", "energy_drift", "fig6_right", "chaos"} < names
    assert names <= texts.keys()


def test_every_rule_says_in_its_own_words_what_it_makes_and_what_it_does():
    for head, text in rules().items():
        assert re.match(r"""    ["'].+["']\n""", text), f"{head} has no text of its own"
        inherits = head.startswith("use")
        assert inherits or "message:" in text, f"{head} would show the names of all its inputs"


def test_no_wall_of_names_reaches_the_screen(looked):
    screen = (looked / "dry_run.txt").read_text()
    assert "Integrating fig2_small by every solver" in screen
    reasons = screen.partition("Reasons:")[0]
    assert max(map(len, reasons.splitlines())) < 200


def jobs(*made, kind="output", **more):
    empty = dict.fromkeys(("input", "output", "log"), ())
    return [SimpleNamespace(**{**empty, kind: made, **more})]


def test_the_last_line_names_the_page_or_the_pictures_or_the_folder():
    tell = targets.where_to_look
    everything = jobs("results/figures/fig1.png", "results/report.html", kind="input")
    assert tell(everything) == "Done. Open results/report.html in a browser."
    assert "results/own_report.html" in tell(jobs("results/own_report.html"))
    figure = jobs("results/figures/fig1.png", "results/figures/fig1.pdf")
    assert tell(figure) == "Done. Look at results/figures/fig1.png."
    assert tell(jobs("results/sweeps/a.nc")) == "Done. Look at results/sweeps/a.nc."
    many = jobs(*(f"results/figures/fig{n}.png" for n in range(6)))
    assert tell(many) == "Done. Look at results/figures/."


def test_a_result_is_named_where_it_lies_and_not_in_the_folder_of_the_call(monkeypatch):
    """There the old picture lies."""
    monkeypatch.setattr(sys, "argv", ["snakemake", "--directory", "there", "fig1"])
    assert "Look at there/results/figures/fig1.png." in targets.where_to_look(
        jobs("results/figures/fig1.png")
    )
    failed = targets.what_failed(jobs(log=["results/logs/figures/fig1.log"], message="Drawing"))
    assert "Drawing: see there/results/logs/figures/fig1.log" in failed


def test_a_failed_run_names_log_and_cause(tmp_path):
    log, plain = tmp_path / "one.log", tmp_path / "two.log"
    log.write_text("full disk\n\nTraceback (most recent call last):\n  File\nwall time: 1 s\n")
    plain.write_text("fig3 differs\nfig4 differs\nwall time: 1 s\n")
    crashed = jobs(log=[str(log)], message="Drawing")
    differing = jobs(log=[str(plain)], message="Comparing")
    assert targets.what_failed(crashed).splitlines()[1:3] == [
        f"  Drawing: see {log}",
        "    full disk",
    ]
    assert "    fig3 differs\n    fig4 differs\n" in targets.what_failed(differing)
    assert targets.what_failed([]).startswith("Stopped")
