"""A claim is on the paper's case: where another one was run, neither it nor its controls decide."""

import pytest
from pendula.ledger.claim import Claim, Control, evaluate
from pendula.ledger.criterion import Above, Verdict, judge

FIG2 = {"cases.fig2_small.omega": "fig2_small.omega (1 in place of 8)"}


def grows(*runs):
    return judge({"growth": runs[0]}, Above(2.0, "growth"))


def row_of(monkeypatch, differs, needs, controls=(), on=()):
    claim = Claim("it", "Section 0", "It is so.", needs, grows, controls, on)
    monkeypatch.setattr("pendula.ledger.claim.all_claims", lambda: (claim,))
    sources = dict.fromkeys(("trajectories/fig3_small", "checks/members"), 5.0)
    (row,) = evaluate(sources | {"trajectories/fig2_small": 1.0}, differs)
    return row


def test_an_edited_case_decides_no_claim_on_it(monkeypatch):
    control = Control("a flat run", {"trajectories/fig2_small": "trajectories/fig3_small"})
    row = row_of(monkeypatch, FIG2, ("trajectories/fig2_small",), (control,))
    assert row["verdict"] == Verdict.NOT_APPLICABLE
    assert row["because"] == "the configuration differs in fig2_small.omega (1 in place of 8)"
    assert row["measured"] == {} and row["cutoffs"] == row["rests_on"] == []
    (fed,) = row["controls"]
    assert fed["verdict"] == Verdict.NOT_APPLICABLE and fed["passes"] is None


def test_a_control_that_is_fed_an_edited_case_is_not_asked(monkeypatch):
    control = Control("a flat run", {"trajectories/fig3_small": "trajectories/fig2_small"})
    row = row_of(monkeypatch, FIG2, ("trajectories/fig3_small",), (control,))
    assert row["verdict"] == Verdict.CONFIRMED
    assert row["controls"][0]["verdict"] == Verdict.NOT_APPLICABLE
    row = row_of(monkeypatch, {}, ("trajectories/fig3_small",), (control,))
    assert row["controls"][0]["passes"]


@pytest.mark.parametrize(
    ("on", "verdict"), [((), Verdict.NOT_APPLICABLE), (("fig3_large",), Verdict.CONFIRMED)]
)
def test_a_claim_on_some_cases_of_a_check_rests_on_these_alone(monkeypatch, on, verdict):
    assert row_of(monkeypatch, FIG2, ("checks/members",), on=on)["verdict"] == verdict
