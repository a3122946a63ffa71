"""The ledger of the accepted full run: enough rows, and no verdict that could not have failed."""

import json
from pathlib import Path

import pytest
from pendula.ledger.claim import all_claims

KEPT = Path(__file__).parents[1] / "baseline/quoted/claims.json"
ROWS = json.loads(KEPT.read_text(encoding="utf-8"))
HOLDS = {"confirmed", "confirmed with a caveat"}


def test_the_paper_is_read_in_ninety_rows_and_more():
    assert len(ROWS) >= 90
    assert len({row["says"] + row["place"] for row in ROWS}) == len(ROWS)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row["name"])
def test_every_function_was_fed_a_case_that_turns_its_verdict(row):
    """A claim that holds has refused a wrong case; one that falls could have been confirmed."""
    assert all(control["passes"] for control in row["controls"]), row["controls"]
    musts = {control["must"] for control in row["controls"]}
    if row["verdict"] in HOLDS:
        assert "be refused" in musts
    elif row["verdict"] == "not reproduced":
        assert "be confirmed" in musts


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row["name"])
def test_a_row_that_rests_on_a_cutoff_says_so(row):
    assert bool(row["rests_on"]) == ("rests on the cut-off" in row["because"])
    assert all(cutoff["from"] for cutoff in row["cutoffs"])
    if row["rests_on"]:
        assert row["verdict"] != "confirmed"


def test_no_claim_is_without_a_control():
    assert [claim.name for claim in all_claims() if not claim.controls] == []
