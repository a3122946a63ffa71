"""Accepting: what is refused, what is shown before, what is taken, by name or all."""

import json
import shutil

import made_up_results as made_up
import pytest
from figure_diff.accept_results import accept_results
from made_up_results import CHAOTIC, CONFIGURATION, LEDGER, NAMES, PICTURE, REGULAR, change_a
from pendula.figure_diff import baseline
from pendula.figure_diff.acceptance import AcceptanceError, check, choose, plan

SHORT = {"cases": {"fig2_small": {"end_time": 4, "omega": 8}}}
RENEWED = {"cases": {"fig2_small": {"end_time": 60, "omega": 8}}}


def contents(folder) -> dict[str, bytes]:
    """Return all files below a folder."""
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def test_another_configuration_is_refused_by_what_is_other(run):
    with pytest.raises(AcceptanceError) as refused:
        check(SHORT, CONFIGURATION, run.accepted, some=False)
    said = str(refused.value)
    assert "cases.fig2_small.end_time is 4 in place of 50" in said
    assert said.startswith("nothing is accepted") and "--config baseline=" in said


def test_the_accepted_and_the_committed_configuration_may_be_accepted(run):
    check(CONFIGURATION, CONFIGURATION, run.accepted, some=True)
    check(RENEWED, RENEWED, run.accepted, some=False)  # config/*.yaml were changed on purpose
    check(CONFIGURATION, RENEWED, run.accepted, some=True)  # a baseline of one's own


def test_an_empty_folder_takes_any_configuration(tmp_path):
    check(SHORT, CONFIGURATION, tmp_path, some=False)


def test_some_files_of_a_new_configuration_are_refused(run):
    with pytest.raises(AcceptanceError, match=r"end_time is 60 in place of 50.* accept all files"):
        check(RENEWED, RENEWED, run.accepted, some=True)


@pytest.mark.parametrize(
    ("word", "files"),
    [
        ("fig2", [f"figures/fig2.{kind}" for kind in ("json", "nc", "pdf", "png")]),
        ("trajectories/fig4_small", [CHAOTIC]),
        (LEDGER, [LEDGER]),
        ("claims", [LEDGER]),
        ("figures/*.nc", ["figures/fig2.nc", "figures/fig4.nc"]),
    ],
)
def test_names_are_those_of_files_and_figures(word, files):
    assert choose([word], NAMES) == files


def test_several_names_take_their_files_once():
    assert choose(["fig2", "figures/fig2.png", LEDGER], NAMES) == [LEDGER, *choose(["fig2"], NAMES)]


def test_a_name_of_nothing_is_refused_with_the_nearest():
    with pytest.raises(AcceptanceError, match=r"fig22 names no file .* did you mean fig2"):
        choose(["fig4", "fig22"], NAMES)


def test_accepting_takes_what_changed_and_nothing_else(run):
    run.change(REGULAR, lambda data: change_a(data, 1.01))
    kept = (run.accepted / PICTURE).stat().st_mtime_ns
    counted = f"0 new, 1 changed, 0 removed; the baseline then has {len(NAMES)} files"
    assert run.accept() == [f"changed: {REGULAR}", counted]
    assert (run.accepted / PICTURE).stat().st_mtime_ns == kept
    assert not run.faults()


def test_a_change_below_single_precision_is_taken_too(run):
    run.change(REGULAR, lambda data: change_a(data, 1 + 1e-13))
    assert f"changed: {REGULAR}" in run.accept()
    assert {each.status for each in run.compare(NAMES)} == {"identical"}


def test_a_damaged_file_of_the_baseline_is_written_anew(run):
    (run.accepted / REGULAR).write_bytes(b"damaged")
    assert f"changed: {REGULAR}" in run.accept()
    run.change(REGULAR, lambda data: change_a(data, 1 + 1e-7))
    assert not run.faults()


def test_accepting_removes_what_is_no_longer_made(run):
    lines = run.accept([name for name in NAMES if name != PICTURE])
    assert f"removed: {PICTURE}" in lines and not (run.accepted / PICTURE).exists()
    record = json.loads((run.accepted / baseline.RECORD).read_text())
    assert PICTURE not in record["files"] and "matplotlib" in record["environment"]
    assert PICTURE not in baseline.accepted_hashes(run.accepted)


def test_only_what_is_named_is_taken(run):
    for name in (REGULAR, CHAOTIC):
        run.change(name, lambda data: change_a(data, 1.5))
    assert run.accept(chosen=[REGULAR])[0] == f"changed: {REGULAR}"
    assert [line.split(": ")[1] for line in run.faults()] == [CHAOTIC]


def test_changed_verdicts_are_shown(run):
    rows = made_up.ledger()
    rows[0]["verdict"] = "not reproduced"
    made_up.put_words(run.made, rows, made_up.table())
    lines = plan(NAMES, *run, CONFIGURATION).lines
    assert "verdict: regular_bounded is not reproduced in place of confirmed" in lines


@pytest.mark.parametrize("name", [REGULAR, PICTURE, LEDGER])
def test_an_empty_file_is_refused_and_nothing_changed(run, name):
    run.change(CHAOTIC, lambda data: change_a(data, 1.5))
    (run.made / name).write_bytes(b"")
    before = contents(run.accepted)
    with pytest.raises(AcceptanceError, match="nothing is accepted"):
        run.accept()
    assert contents(run.accepted) == before


def test_files_of_two_environments_do_not_mix(run):
    run.move_to_another_environment()
    for name in (PICTURE, REGULAR):
        with pytest.raises(AcceptanceError, match=r"matplotlib is .* in place of 1.0"):
            plan(NAMES, *run, CONFIGURATION, chosen=[name])
    assert plan(NAMES, *run, CONFIGURATION).record["environment"] == baseline.environment()


def test_naming_all_files_is_accepting_the_run(run):
    """Only then may lost numbers be accepted together with another environment."""
    every = choose(["*"], [*NAMES, *baseline.ALLOWANCES])
    assert set(every) == {*NAMES, *baseline.ALLOWANCES}
    run.move_to_another_environment()
    assert plan(NAMES, *run, CONFIGURATION, every).record["environment"] == baseline.environment()


def test_a_preview_says_the_same_and_changes_nothing(run, monkeypatch, capsys):
    monkeypatch.chdir(run.made.parent)
    run.change(REGULAR, lambda data: change_a(data, 1.5))
    before, said = contents(run.accepted), []
    for dry in (True, False):
        results = [f"results/{name}" for name in NAMES]
        accept_results(results, NAMES, str(run.accepted), CONFIGURATION, all_of_it=True, dry=dry)
        said.append(capsys.readouterr().out.splitlines())
        if dry:
            assert contents(run.accepted) == before
    assert said[0][:2] == said[1] and "Nothing was changed" in said[0][2]
    assert not run.faults()


def test_the_same_run_is_accepted_to_the_same_bytes(run, tmp_path):
    """So that a commit shows what changed."""
    again = run._replace(accepted=tmp_path / "again")
    again.accepted.mkdir()
    for name in baseline.ALLOWANCES:
        shutil.copy(run.accepted / name, again.accepted)
    again.accept()
    first, second = contents(run.accepted), contents(again.accepted)
    assert {name: first[name] for name in second} == second
