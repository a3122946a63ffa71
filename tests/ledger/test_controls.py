"""What wrong cases, moved cut-offs and several readings do to the row of a claim."""

import math

import numpy as np
import pytest
import xarray as xr
from pendula.ledger.claim import (
    Claim,
    Control,
    claim,
    controls_of,
    cutoff_lines,
    evaluate,
    late,
    needed,
    passes,
)
from pendula.ledger.criterion import Above, Below, UndecidableError, Verdict, judge, undecided
from pendula.ledger.cutoff import Cutoff
from pendula.ledger.tables import by_sentence, tally

GROWS = Cutoff(2.0, '"grows"')


def grows(run):
    return judge({"growth": run}, Above(GROWS, "growth"), fails="" if run > 0 else "it falls")


def anything(run):
    return judge({"growth": run}, Above(-1e9, "growth"))


def shrinks(run):
    return judge({"growth": run}, Below(0.5, "growth"))


def impossible(run):
    raise UndecidableError("the run is too short to be changed")


@pytest.fixture
def rows(monkeypatch):
    """Return a function of datasets and claims: the rows of the ledger."""

    def rows_of(sources, *claims):
        monkeypatch.setattr("pendula.ledger.claim.all_claims", lambda: claims)
        return evaluate(sources)

    return rows_of


def it(decide, *controls):
    return Claim("it", "Section 0", "It is so.", ("run",), decide, controls)


FLAT = Control("a flat run", {"run": "flat"})
FALLING = Control("a falling run", {"run": "falling"}, confirms=True)


@pytest.mark.parametrize(
    ("decide", "control", "sources", "passed", "verdict", "because"),
    [
        (grows, FLAT, {"flat": 1.0}, Verdict.NOT_REPRODUCED, Verdict.CONFIRMED, ""),
        (anything, FLAT, {"flat": 1.0}, False, Verdict.UNDECIDED, "fails a control: a flat run"),
        (grows, FLAT, {}, False, Verdict.UNDECIDED,
         "a flat run must be refused, found: cannot be decided"),
        (grows, Control("a changed run", {"run": impossible}), {}, False, Verdict.UNDECIDED,
         "a changed run must be refused"),
        (grows, Control("a tenth", {"run": lambda run: 0.1 * run}), {}, Verdict.NOT_REPRODUCED,
         Verdict.CONFIRMED, ""),
        (shrinks, FALLING, {"falling": 0.1}, Verdict.CONFIRMED, Verdict.NOT_REPRODUCED,
         "growth is 5"),
        (shrinks, FALLING, {"falling": 5.0}, False, Verdict.UNDECIDED, "a falling run"),
    ],
)  # fmt: skip
def test_a_function_that_is_wrong_on_a_control_decides_nothing(
    rows, decide, control, sources, passed, verdict, because
):
    """The control passes with the verdict `passed`, or not if that is False."""
    (row,) = rows({"run": 5.0, **sources}, it(decide, control))
    (fed,) = controls_of([row])
    assert row["verdict"] == verdict and because in row["because"]
    assert fed["claim"] == "it" and fed["fed"] == control.says and fed["passes"] == bool(passed)
    assert not passed or fed["verdict"] == passed
    assert needed() == ["run", *control.names]


@pytest.mark.parametrize(
    ("growth", "verdict", "moved"),
    [
        (9.0, Verdict.CONFIRMED, []),
        (2.5, Verdict.CAVEAT, [Verdict.NOT_REPRODUCED]),
        (1.9, Verdict.NOT_REPRODUCED, [Verdict.CONFIRMED]),
    ],
)
def test_a_row_says_whether_it_rests_on_its_cutoff(rows, growth, verdict, moved):
    (found,) = rows({"run": growth}, it(grows))
    assert found["verdict"] == verdict
    assert [rest["verdict"] for rest in found["rests_on"]] == moved
    assert ("rests on the cut-off" in found["because"]) == bool(moved)
    assert found["cutoffs"] == [{"value": 2.0, "from": '"grows"'}]
    assert cutoff_lines([found]) == [(2.0, '"grows"', "it", "it" if moved else "")]


def test_a_refusal_comes_from_numbers_unless_nothing_can_be_said():
    refuse, silent = Control("wrong", {}), Control("outside", {}, undecided=True)
    assert passes(refuse, grows(1.0)) and not passes(silent, grows(1.0))
    half_known = judge({"x": 1.5, "y": math.nan}, Below(1.0, "x", "y"))
    assert not passes(refuse, grows(math.nan)) and not passes(refuse, half_known)
    unknown = undecided({}, "there is no such bound")
    assert passes(silent, unknown) and not passes(refuse, unknown)
    assert [one.must for one in (refuse, silent)] == ["be refused", "not be decided"]


def test_a_control_names_datasets_without_the_folder_of_what_it_replaces():
    one, other = "trajectories/one", "checks/other"

    def fed(needs, wrong):
        declare = claim("Section 0", "It is so.", needs, (Control("wrong", wrong),))
        return declare(lambda *runs: runs).claim.controls[0].fed

    two = "trajectories/two"
    assert fed((one,), "two") == {one: two}
    wrong = {"one": "two", "other": (one, max)}
    assert fed((one, other), wrong) == {one: two, other: (one, max)}
    assert fed((one, other), {other: max}) == {other: max}
    with pytest.raises(ValueError, match="say which of trajectories/one, checks/other"):
        fed((one, other), "two")
    with pytest.raises(ValueError, match="three is not one of trajectories/one"):
        fed((one,), {"three": "two"})


# --- Readings of one sentence ---------------------------------------------------------------------


def reading(name, place="Section 0"):
    flat = Control("a flat run", {name: lambda run: 1.0})
    return Claim(name, place, "It grows.", (name,), grows, (flat,), reading=name.replace("_", " "))


@pytest.mark.parametrize(
    ("ensembles", "verdict", "because"),
    [
        ({"the_ensembles": 5.0}, Verdict.CONFIRMED, ""),
        ({"the_ensembles": -1.0}, Verdict.NOT_REPRODUCED, "the ensembles: it falls"),
        ({}, Verdict.UNDECIDED, "the ensembles: the_ensembles was not made"),
    ],
)
def test_a_sentence_holds_where_all_its_readings_do(rows, ensembles, verdict, because):
    readings = reading("single_run"), reading("the_ensembles")
    (row,) = by_sentence(rows({"single_run": 4.0, **ensembles}, *readings))
    assert row["verdict"] == verdict and row["because"] == because
    assert row["names"] == row["decided_by"] == ["single_run", "the_ensembles"]
    measured = {f"{name}_growth": growth for name, growth in ensembles.items()}
    assert row["measured"] == {"single_run_growth": 4.0, **measured}
    criteria = ["single run: growth > 2", "the ensembles: growth > 2"][: 1 + len(ensembles)]
    assert row["criterion"] == "; ".join(criteria)
    fed = [one["fed"] for one in row["controls"]]
    assert fed == ["single run: a flat run", "the ensembles: a flat run"]


PLACES = ("Lemma 1", "Section 6, breathers", "Lemma 1, for the pendula (1)", "Beyond the paper, x")


def test_sentences_are_counted_by_whose_they_are_and_only_the_papers_are_reproduced(rows):
    claims = [reading(f"run{i}", place) for i, place in enumerate(PLACES)]
    found = by_sentence(rows({f"run{i}": 1.0 for i in range(4)}, *claims))
    assert tally(found) == {
        "of the paper": {"not reproduced": 1},
        "on its open questions": {"not reproduced": 1, "does not carry over": 1},
        "of this project": {"not reproduced": 1},
    }
    assert all(one["passes"] for row in found for one in row["controls"])


# --- What deciding functions read -----------------------------------------------------------------


@pytest.mark.parametrize(
    ("end", "given", "start"), [(50.0, (), 10.0), (20.0, (), 10.0), (8.0, (4.0,), 4.0)]
)
def test_the_late_part_starts_at_ten_or_where_it_must_and_goes_on_to_the_end(end, given, start):
    run = xr.Dataset(coords={"tau": np.arange(0.0, end + 0.25, 0.5)})
    tau = late(run, *given)["tau"].values
    assert tau[0] == start and tau[-1] == end and len(tau) == 2 * (end - start) + 1
    with pytest.raises(UndecidableError, match=r"ends at tau = 19\.5, before 20"):
        late(run.assign_coords(tau=19.5 * run["tau"] / end))
