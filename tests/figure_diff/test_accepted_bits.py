"""The accepted environment: other bits are a fault there, whatever the allowances say."""

import json

import made_up_results as made_up
import pytest
from made_up_results import CHAOTIC, LEDGER, NAMES, REGULAR, TABLE, change_a, chaotic
from pendula.figure_diff import DAMAGED, DIFFERENT, IDENTICAL, NEARLY, baseline
from pendula.figure_diff.tolerances import SPREADS, TOLERANCES

AGREES = "this agrees within the allowances"


def judge(run, **options) -> dict:
    """Return the findings by the names of the files."""
    return {found.name: found for found in run.judge(**options).findings}


def move_chaos(run) -> None:
    """Let the chaotic case take another path, in its dataset and all that shows it."""
    made_up.save(run.made / CHAOTIC, chaotic(seed=7))
    made_up.put(run.made, "fig4", chaotic(seed=7))


def test_other_bits_are_a_fault_that_says_whether_it_would_pass(run):
    move_chaos(run)
    verdict = run.judge()
    found = {each.name: each for each in verdict.findings if each.status != IDENTICAL}
    assert verdict.failed
    assert found.keys() == {
        CHAOTIC,
        *(f"figures/fig4.{kind}" for kind in ("nc", "png", "pdf", "json")),
    }
    for each in found.values():
        assert each.status == DIFFERENT and each.agrees and AGREES in each.says
    assert "other bits in l2" in found[CHAOTIC].says and " is allowed" in found[CHAOTIC].says
    assert verdict.lines[-1].startswith(
        f"5 different, {len(NAMES) - 5} identical. 5 of the different"
    )
    assert "look at them and accept them (`snakemake accept_figures`)" in verdict.lines[-1]


def test_the_smallest_change_is_a_fault(run):
    run.change(REGULAR, lambda data: change_a(data, 1 + 1e-15))
    assert judge(run)[REGULAR].status == DIFFERENT


def test_what_the_allowances_refuse_does_not_claim_to_agree(run):
    run.change(REGULAR, lambda data: change_a(data, 1.01))
    found = judge(run)[REGULAR]
    assert found.status == DIFFERENT and not found.agrees and "allowances" not in found.says
    assert "accept" not in run.judge().lines[-1]


def test_faults_that_the_allowances_refuse_come_first(run):
    move_chaos(run)
    run.change(REGULAR, lambda data: change_a(data, 1.01))
    assert run.judge().findings[0].name == REGULAR


@pytest.mark.parametrize("asked", [True, False], ids=["bits=any", "other versions"])
def test_the_allowances_decide_where_they_are_asked_or_the_environment_is_another(run, asked):
    move_chaos(run)
    if not asked:
        run.move_to_another_environment()
    verdict = run.judge(any_bits=asked)
    statuses = {each.name: each.status for each in verdict.findings}
    assert not verdict.failed and statuses[CHAOTIC] == NEARLY
    why = "bits=any asks for it" if asked else "matplotlib is"
    assert why in verdict.judged and "5 nearly the same" in verdict.lines[-1]


@pytest.mark.parametrize(
    "package", ["numpy", "scipy", "numba", "llvmlite", "matplotlib", "machine"]
)
def test_each_version_and_the_family_of_the_processor_are_part_of_the_environment(run, package):
    path = run.accepted / baseline.RECORD
    record = json.loads(path.read_text())
    here = record["environment"][package]
    record["environment"][package] = "0.0"
    path.write_text(json.dumps(record))
    assert f"{package} is {here} in place of 0.0" in run.judge().judged


# What lies in the folder of the baseline


def test_a_wider_allowance_is_a_fault_until_it_is_accepted(run):
    path = run.accepted / TOLERANCES
    path.write_text(path.read_text().replace("below: 1.0e-8", "below: 1.0e-2"))
    (fault,) = run.faults()
    assert fault.startswith(
        f"{DIFFERENT}: {TOLERANCES}: says which curves may move, and was edited"
    )
    assert "accept=tolerances.yaml" in fault
    assert f"changed: {TOLERANCES}" in run.accept(chosen=[TOLERANCES])
    assert not run.faults()


def test_other_spreads_are_a_fault(run):
    (run.accepted / SPREADS).write_bytes((run.accepted / SPREADS).read_bytes() + b" ")
    assert [line.split(":")[1] for line in run.faults()] == [f" {SPREADS}"]


def test_allowances_that_vanish_or_appear_are_a_fault(run):
    content = (run.accepted / SPREADS).read_bytes()
    (run.accepted / SPREADS).unlink()
    (fault,) = run.faults()
    assert f"{SPREADS}: says how far curves may move, and is missing" in fault
    run.accept(chosen=[SPREADS])
    assert not run.faults()
    (run.accepted / SPREADS).write_bytes(content)
    assert len(run.faults()) == 1


@pytest.mark.parametrize("name", [REGULAR, "figures/fig2.png", "figures/fig2.json", LEDGER, TABLE])
def test_an_edited_copy_in_the_baseline_is_a_fault(run, name):
    """Else a fault that is planted into both copies would pass where the bits are others."""
    (run.accepted / name).write_bytes((run.accepted / name).read_bytes() + b"\n")
    (fault,) = run.faults()
    assert fault.startswith(f"{DAMAGED}: {name}: in the baseline was edited since it was accepted")


@pytest.mark.parametrize("name", [REGULAR, "figures/fig2.png", LEDGER])
def test_a_lost_copy_in_the_baseline_is_a_fault(run, name):
    (run.accepted / name).unlink()
    assert f"{DAMAGED}: {name}: in the baseline is missing" in run.faults()[0]


def test_accepting_some_files_leaves_an_edited_copy_of_another_a_fault(run):
    (run.accepted / TABLE).write_text("edited")
    run.change(REGULAR, lambda data: change_a(data, 1.01))
    run.accept(chosen=[REGULAR])
    (fault,) = run.faults()
    assert fault.startswith(f"{DAMAGED}: {TABLE}")
