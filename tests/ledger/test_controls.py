"""What a wrong case and a moved cut-off do to the row of a claim."""

import math

import pytest
from pendula.ledger.claim import Claim, Control, claim, controls_of, evaluate, needed, passes
from pendula.ledger.criterion import (
    Above,
    Below,
    UndecidableError,
    Verdict,
    judge,
    undecided,
)
from pendula.ledger.cutoff import Cutoff

GROWS = Cutoff(2.0, '"grows"')


def grows(run):
    return judge({"growth": run}, Above(GROWS, "growth"))


def anything(run):
    return judge({"growth": run}, Above(-1e9, "growth"))


def shrinks(run):
    return judge({"growth": run}, Below(0.5, "growth"))


@pytest.fixture
def row(monkeypatch):
    """Return the row of a claim that a function decides from runs by name, with these controls."""

    def row_of(function, sources, *controls):
        claim = Claim("it", "Section 0", "It is so.", ("run",), function, controls)
        monkeypatch.setattr("pendula.ledger.claim.all_claims", lambda: (claim,))
        (found,) = evaluate(sources)
        return found

    return row_of


def test_a_wrong_case_is_refused_and_the_claim_stands(row):
    found = row(grows, {"run": 5.0, "flat": 1.0}, Control("a flat run", {"run": "flat"}))
    assert found["verdict"] == Verdict.CONFIRMED and found["because"] == ""
    (control,) = controls_of([found])
    assert control["claim"] == "it" and control["fed"] == "a flat run" and control["passes"]
    assert control["verdict"] == Verdict.NOT_REPRODUCED
    assert needed() == ["run", "flat"]


def test_a_function_that_confirms_a_wrong_case_decides_nothing(row):
    found = row(anything, {"run": 5.0, "flat": 1.0}, Control("a flat run", {"run": "flat"}))
    assert found["verdict"] == Verdict.UNDECIDED and "a flat run" in found["because"]
    assert not controls_of([found])[0]["passes"]


def test_a_dataset_can_be_made_wrong(row):
    found = row(grows, {"run": 5.0}, Control("a tenth", {"run": lambda run: 0.1 * run}))
    assert found["controls"][0]["measured"] == {"growth": 0.5}


def test_a_refuted_claim_shows_that_its_function_can_confirm(row):
    right = Control("a falling run", {"run": "falling"}, confirms=True)
    found = row(shrinks, {"run": 5.0, "falling": 0.1}, right)
    assert found["verdict"] == Verdict.NOT_REPRODUCED and found["controls"][0]["passes"]
    found = row(shrinks, {"run": 5.0, "falling": 5.0}, right)
    assert found["verdict"] == Verdict.UNDECIDED and "a falling run" in found["because"]


def test_a_control_without_its_dataset_is_not_decided(row):
    found = row(grows, {"run": 5.0}, Control("a flat run", {"run": "flat"}))
    assert found["controls"][0]["verdict"] == Verdict.UNDECIDED
    assert not found["controls"][0]["passes"]
    assert "flat was not made" in found["controls"][0]["because"]
    assert found["verdict"] == Verdict.UNDECIDED
    assert found["because"].endswith("a flat run must be refused, found: cannot be decided")


@pytest.mark.parametrize(
    ("growth", "verdict", "moved"),
    [
        (9.0, Verdict.CONFIRMED, []),
        (2.5, Verdict.CAVEAT, [Verdict.NOT_REPRODUCED]),
        (1.9, Verdict.NOT_REPRODUCED, [Verdict.CONFIRMED]),
    ],
)
def test_a_row_says_whether_it_rests_on_its_cutoff(row, growth, verdict, moved):
    found = row(grows, {"run": growth})
    assert found["verdict"] == verdict
    assert [rest["verdict"] for rest in found["rests_on"]] == moved
    assert ("rests on the cut-off" in found["because"]) == bool(moved)
    assert found["cutoffs"] == [{"value": 2.0, "from": '"grows"'}]


def test_a_control_that_cannot_be_made_is_not_decided(row):
    def impossible(run):
        raise UndecidableError("the run is too short to be changed")

    found = row(grows, {"run": 5.0}, Control("a changed run", {"run": impossible}))
    assert found["controls"][0]["verdict"] == Verdict.UNDECIDED
    assert not found["controls"][0]["passes"]
    assert "too short" in found["controls"][0]["because"]


def test_a_refusal_comes_from_numbers_unless_nothing_can_be_said():
    refuse, silent = Control("wrong", {}), Control("outside", {}, undecided=True)
    assert passes(refuse, grows(1.0)) and not passes(silent, grows(1.0))
    assert not passes(refuse, grows(math.nan))
    unknown = undecided({}, "there is no such bound")
    assert passes(silent, unknown) and not passes(refuse, unknown)
    assert [one.must for one in (refuse, silent)] == ["be refused", "not be decided"]


def test_a_control_names_datasets_without_the_folder_of_what_it_replaces():
    one, other = "trajectories/one", "checks/other"

    def fed(needs, wrong):
        return claim("Section 0", "It is so.", needs, (Control("wrong", wrong),))(
            lambda *runs: runs
        ).claim.controls[0].fed  # fmt: skip

    assert fed((one,), "two") == {one: "trajectories/two"}
    assert fed((one, other), {"one": "two", "other": (one, max)}) == {
        one: "trajectories/two",
        other: (one, max),
    }
    assert fed((one, other), {other: max}) == {other: max}
    with pytest.raises(ValueError, match="say which of trajectories/one, checks/other"):
        fed((one, other), "two")
    with pytest.raises(ValueError, match="three is not one of trajectories/one"):
        fed((one,), {"three": "two"})
