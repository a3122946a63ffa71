"""The ledger of the accepted full run: enough rows, and no verdict that could not have failed."""

from pathlib import Path

import pytest
from accepted import BASELINE
from latticode.datasets.json_files import load_json
from pendula.jobs.decide import all_claims
from replication.ledger.claim import Origin
from replication.ledger.decide import join_claims
from replication.ledger.verdicts import evaluate

ROWS = load_json(BASELINE / "claims.json")["rows"]
TURNS = {
    "confirmed": "be rejected",
    "confirmed with a caveat": "be rejected",
    "not reproduced": "be confirmed",
    "does not carry over": "be confirmed",
}
"""What a wrong case must do to the function that came to a verdict."""


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row["name"])
def test_a_row_could_have_failed_and_says_on_what_it_rests(row):
    """A claim that holds has refused a wrong case; one that falls could have been confirmed."""
    assert all(control["passes"] for control in row["controls"])
    musts = {control["must"] for control in row["controls"]}
    assert row["verdict"] not in TURNS or TURNS[row["verdict"]] in musts
    assert all(cutoff["from"] for cutoff in row["cutoffs"])
    assert ("depends on the cut-off" in row["because"]) == bool(row["rests_on"])
    assert not (row["rests_on"] and row["verdict"] == "confirmed")
    assert row["verdict"] != "not reproduced" or row["origin"] == Origin.PAPER


def test_without_datasets_nothing_is_decided():
    rows = evaluate(all_claims(), {})
    assert {row["verdict"] for row in rows} == {"cannot be decided"}
    assert all("was not made" in row["because"] and row["controls"] for row in rows)


NAMES = ["figures", "solvers", "theory", "chaos", "breathers", "newton", "unbounded", "certified"]
STUDY_CLAIMS = [BASELINE / f"claims/{name}.json" for name in NAMES]
"""The parts of the ledger, in the order of `PARTS_OF_LEDGER`."""


def test_parts_make_the_accepted_ledger_and_its_table(tmp_path):
    joined = [str(tmp_path / name) for name in ("claims.json", "claims.md")]
    join_claims(list(map(str, STUDY_CLAIMS)), *joined)
    assert Path(joined[0]).read_bytes() == (BASELINE / "claims.json").read_bytes()
    assert Path(joined[1]).read_bytes() == (BASELINE / "tables/claims.md").read_bytes()
