"""The ledger of the accepted full run: enough rows, and no verdict that could not have failed."""

import numpy as np
from accepted import BASELINE, datasets
from pendula.datasets.json_files import load_json
from pendula.ledger.claim import Origin, all_claims, decide, evaluate
from pendula.ledger.tables import tally

ROWS = load_json(BASELINE / "claims.json")["rows"]


def test_the_paper_is_read_in_many_rows_and_each_sentence_once():
    counts = {origin: sum(counted.values()) for origin, counted in tally(ROWS).items()}
    assert sum(counts.values()) == len(ROWS) and counts[Origin.PAPER] >= 70
    assert len({row["says"] + row["place"] for row in ROWS}) == len(ROWS)


def test_only_what_the_paper_wrote_can_be_not_reproduced():
    wrong = {row["name"] for row in ROWS if row["verdict"] == "not reproduced"}
    assert wrong <= {row["name"] for row in ROWS if row["origin"] == Origin.PAPER}
    carried = [row["place"] for row in ROWS if row["verdict"] == "does not carry over"]
    assert len(carried) >= 5 and all(place.endswith("the pendula (1)") for place in carried)


TURNS = {
    "confirmed": "be refused",
    "confirmed with a caveat": "be refused",
    "not reproduced": "be confirmed",
    "does not carry over": "be confirmed",
}
"""What a wrong case must do to the function that came to a verdict."""


def test_every_function_was_fed_a_case_that_turns_its_verdict():
    """A claim that holds has refused a wrong case; one that falls could have been confirmed."""
    controls = {row["name"]: row["controls"] for row in ROWS}
    passes = {name: all(one["passes"] for one in each) for name, each in controls.items()}
    assert [name for name, passed in passes.items() if not passed] == []
    turned = {name: {one["must"] for one in each} for name, each in controls.items()}
    decided = {row["name"]: TURNS[row["verdict"]] for row in ROWS if row["verdict"] in TURNS}
    assert [name for name, must in decided.items() if must not in turned[name]] == []


def test_a_row_that_rests_on_a_cutoff_says_so():
    resting = [row["name"] for row in ROWS if row["rests_on"]]
    assert resting == [row["name"] for row in ROWS if "rests on the cut-off" in row["because"]]
    confirmed = {row["name"] for row in ROWS if row["verdict"] == "confirmed"}
    assert confirmed.isdisjoint(resting)
    assert [row["name"] for row in ROWS if not all(one["from"] for one in row["cutoffs"])] == []


def test_without_datasets_nothing_is_decided():
    rows = evaluate({})
    assert {row["verdict"] for row in rows} == {"cannot be decided"}
    assert all("was not made" in row["because"] and row["controls"] for row in rows)


def test_every_criterion_refuses_some_number_and_what_is_none():
    found = [decide(claim, datasets(claim.needs)) for claim in all_claims()]
    judged = [finding for finding in found if finding.criterion is not None]
    assert len(judged) >= len(found) - 6  # what no number can settle has no criterion
    for measured, criterion, *_ in judged:
        for part in parts_of(criterion):
            assert str(part) and part.names
            for name in part.names:
                far = [part.holds({**measured, name: one}) for one in (-np.inf, np.inf)]
                assert not all(far), (str(part), name)
                assert not part.holds({**measured, name: np.nan}), (str(part), name)


def parts_of(criterion) -> list:
    """Return the limits that a criterion is made of."""
    found = getattr(criterion, "criteria", ())
    return [each for part in found for each in parts_of(part)] or [criterion]
