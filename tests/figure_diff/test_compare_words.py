"""The ledger and tables: what is exact, and how far numbers may follow the datasets."""

import json

import pytest
from made_up_results import CHAOTIC, LEDGER, REGULAR, TABLE, ledger, table
from pendula.figure_diff import DAMAGED, DIFFERENT, IDENTICAL, NEARLY, Motion
from pendula.figure_diff.compare_words import compare

CONTROLS = "controls.json"
SAME = dict.fromkeys((REGULAR, CHAOTIC), Motion.NONE)
NUDGED = SAME | {REGULAR: Motion.UNSEEN}
MOVED = SAME | {REGULAR: Motion.SEEN}
FAULTY = SAME | {REGULAR: Motion.WRONG}


def cell(number: str) -> str:
    """Return a table with one number."""
    return f"| claim | error |\n|---|---|\n| energy | {number} |\n"


def status(was: str, now: str, datasets) -> str:
    """Return what is found of a number that changed in a table."""
    return compare(TABLE, cell(was), cell(now), datasets).status


@pytest.mark.parametrize(
    ("was", "now", "followed"),
    [
        ("2.99871", "2.99872", True),
        ("2.99871", "2.99990", False),
        ("0.48 %", "0.49 %", True),  # the last digit that is printed
        ("0.48 %", "0.50 %", False),
        ("1.2e-03", "1.3e-03", True),
        ("1.2e-03", "1.5e-03", False),
        ("1.2e-15", "9.1e-15", True),  # rounding errors keep their size
        ("1.2e-10", "9.1e-10", True),
        ("1.2e-10", "9.1e-09", False),
        ("0", "3e-13", True),
        ("0", "3e-11", False),
        ("1.5", "-1.5", False),
        ("yes 1", "no 1", False),
        ("1 of 2", "1 of 2 of 3", False),
    ],
)
def test_a_number_may_follow_a_regular_dataset_as_little_as_that_moved(was, now, followed):
    assert status(was, now, NUDGED) == (NEARLY if followed else DIFFERENT)
    assert status(was, now, SAME) == DIFFERENT


@pytest.mark.parametrize(
    ("was", "now", "followed"),
    [
        ("2.9", "3.7", True),
        ("2.9", "5.9", False),
        ("2.9", "1.4", False),
        ("2.9", "-2.9", False),
        ("2.9 early", "3.7 late", False),
        ("0.0031", "0.03", True),  # an error
        ("0.0031", "0.032", False),
        ("0.09", "0.2", False),  # what is a number in either run is no error
        ("0", "2", False),
        ("1.2e-15", "9.1e-15", True),
    ],
)
def test_a_number_may_follow_a_chaotic_dataset_by_a_factor(was, now, followed):
    assert status(was, now, MOVED) == (NEARLY if followed else DIFFERENT)


@pytest.mark.parametrize("key", ["criterion", "says", "place"])
def test_a_threshold_and_a_sentence_follow_nothing(key):
    was, now = ledger(), ledger()
    was[0][key], now[0][key] = "at most 2.1", "at most 2.2"
    found = compare(LEDGER, json.dumps(was), json.dumps(now), MOVED)
    assert found.status == DIFFERENT and f"regular_bounded: {key}" in found.says


def test_where_a_dataset_is_faulty_the_words_that_it_changes_are_told():
    found = compare(TABLE, cell("2.9"), cell("3.7"), FAULTY)
    assert found.status == DIFFERENT
    assert found.says == 'line 3, column 2 of "energy" is "3.7" in place of "2.9"'


def test_a_wider_column_is_no_other_number():
    """The padding follows the widest cell, which may have moved."""
    wide = "| claim  | error    |\n|--------|----------|\n| energy | 2.998721 |\n"
    assert compare(TABLE, cell("2.998720"), wide, NUDGED).status == NEARLY


@pytest.mark.parametrize("datasets", [SAME, MOVED], ids=["same", "moved"])
def test_the_same_content_written_otherwise_is_told(datasets):
    was, now = json.dumps(ledger(), indent=1), json.dumps(ledger())
    found = compare(LEDGER, was, now, datasets)
    assert found.status == DIFFERENT and "written otherwise" in found.says
    assert compare(LEDGER, was, was, datasets).status == IDENTICAL


@pytest.mark.parametrize("text", ["", "{", "3", '["claim"]', '[{"verdict": "confirmed"}]'])
def test_what_is_no_ledger_is_damaged(text):
    assert compare(LEDGER, json.dumps(ledger()), text, SAME).status == DAMAGED


def test_every_verdict_that_changed_is_named_before_all_else():
    rows = ledger()
    for row in rows:
        row |= {"says": "Another sentence.", "verdict": "not reproduced"}
    found = compare(LEDGER, json.dumps(ledger()), json.dumps(rows), MOVED)
    assert found.says.startswith(
        'regular_bounded: verdict is "not reproduced" in place of "confirmed"; '
        'chaotic_bounded: verdict is "not reproduced" in place of "confirmed"; '
        'regular_bounded: says is "Another sentence."'
    )
    assert found.says.endswith("(and 1 more)")


def test_controls_are_named_by_their_claim_and_what_they_were_fed():
    control = {"claim": "bounded", "fed": "twice the norm", "verdict": "not reproduced"}
    passed = control | {"verdict": "confirmed"}
    found = compare(CONTROLS, json.dumps([control]), json.dumps([passed]), MOVED)
    assert found.says == (
        'bounded fed twice the norm: verdict is "confirmed" in place of "not reproduced"'
    )


def test_long_texts_are_told_from_where_they_differ():
    long = "The norm grows for a long time, and then it stays as it is; by tau = 50 it is "
    found = compare(TABLE, table() + long + "7.5\n", table() + long + "9.5\n", SAME)
    pair = [f'"...; by tau = 50 it is {number}"' for number in ("9.5", "7.5")]
    assert found.says.endswith("is " + " in place of ".join(pair))
