"""A claim is on the paper's case: where another one was run, neither it nor its controls decide."""

from functools import cache, partial

import pytest
from accepted import dataset, datasets
from pendula.configuration.paper import from_paper, paper
from pendula.jobs.decide import all_claims
from replication.ledger.claim import Claim, ClaimControl
from replication.ledger.criterion import Above, Verdict, judge
from replication.ledger.verdicts import decide, evaluate, feed, needed, why_not_applicable

SECTION = 5
"""Of the paper, as modules of claims name it."""
FIG2 = {"cases.fig2_small.omega": "fig2_small.omega (1 in place of 8)"}


def grows(*runs):
    return judge({"growth": runs[0]}, Above(2.0, "growth"))


def row_of(differs, needs, controls=(), on=()):
    claim = Claim("it", "Section 0", "It is so.", needs, grows, controls, on)
    sources = dict.fromkeys(("trajectories/fig3_small", "checks/members"), 5.0)
    (row,) = evaluate([claim], sources | {"trajectories/fig2_small": 1.0}, from_paper(differs))
    return row


def test_an_edited_case_decides_no_claim_on_it():
    control = ClaimControl("a flat run", {"trajectories/fig2_small": "trajectories/fig3_small"})
    row = row_of(FIG2, ("trajectories/fig2_small",), (control,))
    assert row["verdict"] == Verdict.NOT_APPLICABLE
    assert row["because"] == "the configuration differs in fig2_small.omega (1 in place of 8)"
    assert row["measured"] == {} and row["cutoffs"] == row["rests_on"] == []
    (fed,) = row["controls"]
    assert fed["verdict"] == Verdict.NOT_APPLICABLE and fed["passes"] is None


def test_a_control_that_is_fed_an_edited_case_is_not_asked():
    control = ClaimControl("a flat run", {"trajectories/fig3_small": "trajectories/fig2_small"})
    row = row_of(FIG2, ("trajectories/fig3_small",), (control,))
    assert row["verdict"] == Verdict.CONFIRMED
    assert row["controls"][0]["verdict"] == Verdict.NOT_APPLICABLE
    row = row_of({}, ("trajectories/fig3_small",), (control,))
    assert row["controls"][0]["passes"]


@pytest.mark.parametrize(
    ("on", "verdict"), [((), Verdict.NOT_APPLICABLE), (("fig3_large",), Verdict.CONFIRMED)]
)
def test_a_claim_on_some_cases_of_a_check_rests_on_these_alone(on, verdict):
    assert row_of(FIG2, ("checks/members",), on=on)["verdict"] == verdict


@cache
def edited(need, along, name):
    """Return an accepted dataset with other numbers in one of its cases, and without this case."""
    data = dataset(need)
    in_case = data[along] == name
    numbers = {
        key: values.where(~in_case, 1.2345 * values)
        for key, values in data.items()
        if along in values.dims and values.dtype.kind == "f"
    }
    renamed = {along: data[along].where(~in_case, "another")}
    return data.assign(numbers), data.assign_coords(renamed)


def verdict_of(function, sources):
    try:
        finding = function(sources)
    except (LookupError, ValueError):
        return None
    return finding.verdict, {name: str(value) for name, value in finding.measured.items()}


def silent_on(claim, control, names, sources):
    """Yield the cases of datasets of many that change what is said, although an edit of them does
    not make the claim, or its control, not applicable."""
    function = partial(feed, claim, control) if control else partial(decide, claim)
    right = verdict_of(function, sources)
    for along, key in (("case", "omega"), ("sweep", "windows")):
        named = {
            label
            for label in paper()[f"{along}s"]
            if why_not_applicable(from_paper({f"{along}s.{label}.{key}": "edited"}), claim, control)
        }
        for need in names:
            held = set(sources[need][along].values) if along in sources[need].dims else set()
            for label in (held & set(paper()[f"{along}s"])) - named:
                for wrong in edited(need, along, label):
                    if verdict_of(function, {**sources, need: wrong}) != right:
                        yield need, label


@pytest.mark.parametrize("claim", all_claims(), ids=lambda claim: claim.name)
def test_a_claim_rests_on_no_case_that_it_does_not_name(claim):
    accepted = datasets(needed(all_claims()))
    for control in (None, *claim.controls):
        names = dict.fromkeys((*claim.needs, *(control.names if control else ())))
        assert set(silent_on(claim, control, names, accepted)) == set(), control
