"""What wrong cases do to the row of a claim, and what deciding functions read."""

import math

import pytest
from replication.ledger.claim import Claim, ClaimControl
from replication.ledger.criterion import Above, Below, UndecidableError, Verdict, judge, undecided
from replication.ledger.cutoff import Cutoff
from replication.ledger.verdicts import evaluate, needed, passes

SECTION = 5
"""Of the paper, as modules of claims name it."""
GROWS = Cutoff(2.0, '"grows"')


def grows(run):
    return judge({"growth": run}, Above(GROWS, "growth"), fails="" if run > 0 else "it falls")


def anything(run):
    return judge({"growth": run}, Above(-1e9, "growth"))


def shrinks(run):
    return judge({"growth": run}, Below(0.5, "growth"))


def impossible(run):
    raise UndecidableError("the run is too short to be changed")


def it(decide, *controls):
    return Claim("it", "Section 0", "It is so.", ("run",), decide, controls)


FLAT = ClaimControl("a flat run", {"run": "flat"})
FALLING = ClaimControl("a falling run", {"run": "falling"}, confirms=True)


@pytest.mark.parametrize(
    ("decide", "control", "sources", "passed", "verdict", "because"),
    [
        (grows, FLAT, {"flat": 1.0}, Verdict.NOT_REPRODUCED, Verdict.CONFIRMED, ""),
        (anything, FLAT, {"flat": 1.0}, False, Verdict.UNDECIDED, "fails a control: a flat run"),
        (
            grows,
            FLAT,
            {},
            False,
            Verdict.UNDECIDED,
            "a flat run: must be rejected, found: cannot be decided",
        ),
        (
            grows,
            ClaimControl("a changed run", {"run": impossible}),
            {},
            False,
            Verdict.UNDECIDED,
            "a changed run: must be rejected",
        ),
        (
            grows,
            ClaimControl("a tenth", {"run": lambda run: 0.1 * run}),
            {},
            Verdict.NOT_REPRODUCED,
            Verdict.CONFIRMED,
            "",
        ),
        (
            shrinks,
            FALLING,
            {"falling": 0.1},
            Verdict.CONFIRMED,
            Verdict.NOT_REPRODUCED,
            "growth is 5",
        ),
        (shrinks, FALLING, {"falling": 5.0}, False, Verdict.UNDECIDED, "a falling run"),
    ],
)
def test_a_function_that_is_wrong_on_a_control_decides_nothing(
    decide, control, sources, passed, verdict, because
):
    """The control passes with the verdict `passed`, or not if that is False."""
    claim = it(decide, control)
    (row,) = evaluate([claim], {"run": 5.0, **sources})
    (fed,) = row["controls"]
    assert row["verdict"] == verdict and because in row["because"]
    assert fed["fed"] == control.description and fed["passes"] == bool(passed)
    assert not passed or fed["verdict"] == passed
    assert needed([claim]) == ["run", *control.names]


def test_a_refusal_comes_from_numbers():
    refuse = ClaimControl("wrong", {})
    assert passes(refuse, grows(1.0))
    half_known = judge({"x": 1.5, "y": math.nan}, Below(1.0, "x", "y"))
    assert not passes(refuse, grows(math.nan)) and not passes(refuse, half_known)
    assert not passes(refuse, undecided({}, "there is no such bound"))
