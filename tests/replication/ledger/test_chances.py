"""The chance that another right run turns a verdict: its formula, and that all are small enough."""

import numpy as np
import pytest
from accepted import BASELINE
from facts import designed
from latticode.datasets.json_files import load_json
from pendula.jobs.decide import all_claims
from replication.ledger.chances import ALLOWED, chance_of_claim, chance_to_cross, chance_to_turn
from replication.ledger.criterion import (
    Above,
    AllOf,
    Below,
    Distance,
    Near,
    WithinFactor,
    judge,
    undecided,
)

RNG = np.random.default_rng(5)
RIGHT_RUNS = load_json(BASELINE / "quoted/right_runs.json")
ROWS = {(row["claim"], row["control"]): row for row in RIGHT_RUNS["rows"]}


def findings(numbers, *criteria):
    return [judge({"x": value}, AllOf(*criteria)) for value in numbers]


# --- The accepted claims --------------------------------------------------------------------------


def test_every_claim_and_control_has_a_chance():
    expected = {
        (claim.name, description)
        for claim in all_claims()
        for description in ("", *(control.description for control in claim.controls))
    }
    assert ROWS.keys() == expected, "run `.ci/elsewhere moved`"
    assert RIGHT_RUNS["runs"] >= 10


@pytest.mark.parametrize("name", ROWS, ids="-".join)
def test_right_runs_agree_and_one_more_would(name):
    row = ROWS[name]
    assert len(row["verdicts"]) == 1 and row["chance"] < ALLOWED, row


def test_right_runs_have_the_accepted_verdicts():
    accepted = load_json(BASELINE / "claims.json")["rows"]
    assert {row["name"]: [row["verdict"]] for row in accepted} == {
        claim: row["verdicts"] for (claim, control), row in ROWS.items() if not control
    }


@pytest.mark.parametrize("row", designed(), ids=lambda row: row[0])
def test_a_test_that_fails_by_chance_does_so_too_seldom(row):
    assert 0.0 < row[2] < ALLOWED


# --- The formula ----------------------------------------------------------------------------------


@pytest.mark.parametrize("level", [0.05, 0.01])
def test_limits_that_one_more_draw_reaches_seldom_are_as_seldom_as_that(level):
    """A limit where one more draw happens to lie has a chance below a level in that part of all."""
    drawn = RNG.normal(2.0, 3.0, size=(40000, 7))
    beyond = (drawn[:, :6] > drawn[:, 6:]).all(axis=1)
    chances = [chance_to_cross(row[:6] - row[6]) for row in drawn[beyond]]
    assert (np.array(chances) < level).sum() / len(drawn) == pytest.approx(level, rel=0.15)


@pytest.mark.parametrize(
    ("criterion", "inside", "beyond"),
    [
        (Below(2.0, "x"), 1.5, 2.5),
        (Above(2.0, "x"), 2.5, 1.5),
        (Near(2.0, 1.0, "x"), 2.5, 3.5),
        (WithinFactor(2.0, "x"), 0.7, 0.3),
        (Distance(2.0, "x"), 1.5, 2.5),
    ],
)
def test_a_number_has_room_within_its_limit_and_none_beyond_it(criterion, inside, beyond):
    assert criterion.rooms({"x": inside})["x"] > 0.0 > criterion.rooms({"x": beyond})["x"]


def test_a_verdict_that_holds_falls_with_any_number_and_one_that_fails_with_all():
    near, far = [1.0, 1.1, 0.9, 1.05], [9.0, 9.1, 8.9, 9.05]
    both = AllOf(Above(0.5, "x"), Above(0.5, "y"))
    holds = [judge({"x": x, "y": y}, both) for x, y in zip(near, far, strict=True)]
    chance = chance_to_turn(holds)
    assert chance.nearest == "x"
    assert chance.value >= chance_to_cross([x - 0.5 for x in near]) > 1e-4
    fails = [judge({"x": -x, "y": -y}, both) for x, y in zip(near, far, strict=True)]
    assert chance_to_turn(fails).value == chance_to_cross([y + 0.5 for y in far]) < 1e-5


def test_runs_that_disagree_say_how_often():
    assert chance_to_turn(findings([1.0, 1.0, 1.0, -1.0], Above(0.0, "x"))).value == 0.25


def test_numbers_without_scatter_turn_nothing():
    assert chance_to_turn(findings([1.0, 1.0, 1.0], Above(0.0, "x"))).value == 0.0
    assert chance_to_turn([undecided({}, "there is no number")] * 3).value == 0.0


def test_a_confirmed_claim_counts_where_moved_cut_offs_would_give_it_a_caveat():
    values = [1.0, 1.01, 0.99, 1.02]
    runs = [
        {"": by_limit, "moved": by_moved}
        for by_limit, by_moved in zip(
            findings(values, Above(0.1, "x")), findings(values, Above(0.97, "x")), strict=True
        )
    ]
    assert chance_of_claim(runs, []).value < 1e-5 < 1e-2 < chance_of_claim(runs, ["moved"]).value
