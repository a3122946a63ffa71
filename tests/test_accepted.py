"""Claims and their controls, from the accepted datasets.

What is compared tells that something changed. That it is right is told by wrong changes, which must
turn verdicts, and by the exact cases beside each study.
"""

import re
from functools import cache

import pytest
from accepted import (
    BASELINE,
    changed,
    datasets,
    differing,
    wrong_changes,
)
from latticode.datasets.json_files import load_json
from pendula.jobs.decide import all_claims
from replication.ledger.verdicts import decide, evaluate, needed

CLAIM = {claim.name: claim for claim in all_claims()}

ROUNDED = {
    "energy_small": 2e-5,
    "energy_large": 2e-5,
    "second_solver": 2e-8,
    "ensemble_fig4_settles": 1e-7,
    "ensemble_equilibrium": 1e-7,
    "unbounded_in_time": 2e-4,  # the error of a fit to a power law, which is rounding
    "unbounded_large": 1e-4,
    "unbounded_band": 0.06,
    "curves_certified": 1e-5,
}
"""What the seven digits of the accepted datasets leave open of small differences, by claim."""
NUMBER = r"\d[\d.]*(?:e[+-]\d+)?"


def without_numbers(row: dict) -> dict:
    """Return a row of the ledger without the numbers of its sentences, which are measured ones."""
    reason = {"because": re.sub(NUMBER, "#", row["because"])} if "because" in row else {}
    controls = {"controls": list(map(without_numbers, row.get("controls", ())))}
    return {**{key: row[key] for key in row.keys() - {"rules"}}, **reason, **controls}


@pytest.mark.parametrize("study", sorted(path.stem for path in BASELINE.glob("claims/*.json")))
def test_claims_and_controls_come_out_as_accepted(study):
    """Each row of the ledger: verdict, reason, measured numbers, criterion, cut-offs, controls."""
    ledger = load_json(BASELINE / f"claims/{study}.json")
    accepted = {row["name"]: without_numbers(row) for row in ledger["rows"]}
    functions = [row["function"].split(".") for row in ledger["rows"]]
    modules = sorted({f"{study}/{module}" for *_, study, module, _ in functions})
    claims = all_claims(*modules)
    rows = evaluate(claims, datasets(needed(claims)))
    decided = {row["name"]: without_numbers(row) for row in rows}
    differences = {
        name: differing(accepted[name], row, 1e-3, ROUNDED.get(name, 0.0))
        for name, row in decided.items()
        if name in accepted
    }
    remedy = "if this is meant, look at the rows of the ledger and type `snakemake accept_figures`"
    assert {name: places for name, places in differences.items() if places} == {}, remedy


def test_every_claim_is_in_the_accepted_ledger():
    accepted = {
        row["name"] for path in BASELINE.glob("claims/*.json") for row in load_json(path)["rows"]
    }
    assert len(CLAIM) == len(all_claims())
    remedy = "look at its row of the ledger, then type `snakemake accept_figures`"
    assert sorted(accepted ^ CLAIM.keys()) == [], remedy


@cache
def accepted_finding(name: str):
    return decide(CLAIM[name], datasets(CLAIM[name].needs))


WRONG = wrong_changes("claims")
VERBS = {"scale", "shift", "set"}


@pytest.mark.parametrize("row", WRONG, ids=[f"{row['claim']}-{i}" for i, row in enumerate(WRONG)])
def test_a_wrong_change_turns_the_verdict(row):
    """Where a part is kept and then changed, the verdict on the part is turned."""
    claim, name = CLAIM[row["claim"]], {key: row[key] for key in ("in", "keep") if key in row}
    right = datasets(claim.needs) | (changed(name) if VERBS & row.keys() else {})
    before = decide(claim, right) if "keep" in name else accepted_finding(row["claim"])
    after = decide(claim, right | changed(row))
    assert after.verdict == row.get("is", claim.refuted), after
    assert row.get("because", "") in after.because
    assert (before.verdict, before.because) != (after.verdict, after.because)
