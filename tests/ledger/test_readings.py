"""Readings of one sentence make one row; rows are counted by whose sentence they are."""

import pytest
from pendula.ledger.claim import Claim, Control, evaluate
from pendula.ledger.criterion import Above, Verdict, judge
from pendula.ledger.tables import by_sentence, tally


def grows(run):
    return judge({"growth": run}, Above(2.0, "growth"), fails="it stays")


def rows_of(monkeypatch, sources, *claims):
    monkeypatch.setattr("pendula.ledger.claim.all_claims", lambda: claims)
    return by_sentence(evaluate(sources))


def reading(name, place="Section 0", says="It grows."):
    flat = Control("a flat run", {name: lambda run: 1.0})
    return Claim(name, place, says, (name,), grows, (flat,), reading=name.replace("_", " "))


@pytest.mark.parametrize(
    ("ensembles", "verdict"), [(5.0, Verdict.CONFIRMED), (1.0, Verdict.NOT_REPRODUCED)]
)
def test_a_sentence_holds_where_all_its_readings_do(monkeypatch, ensembles, verdict):
    claims = reading("single_run"), reading("the_ensembles")
    (row,) = rows_of(monkeypatch, {"single_run": 4.0, "the_ensembles": ensembles}, *claims)
    assert row["verdict"] == verdict and row["names"] == ["single_run", "the_ensembles"]
    assert row["measured"] == {"single_run_growth": 4.0, "the_ensembles_growth": ensembles}
    assert row["criterion"] == "single run: growth > 2; the ensembles: growth > 2"
    assert row["because"] == ("" if ensembles == 5.0 else "the ensembles: it stays")
    assert [one["fed"] for one in row["controls"]] == [
        "single run: a flat run",
        "the ensembles: a flat run",
    ]
    assert row["decided_by"] == ["single_run", "the_ensembles"]


def test_a_reading_without_data_leaves_the_sentence_open(monkeypatch):
    claims = reading("single_run"), reading("the_ensembles")
    (row,) = rows_of(monkeypatch, {"single_run": 4.0}, *claims)
    assert row["verdict"] == Verdict.UNDECIDED


PLACES = ("Lemma 1", "Section 6, breathers", "Lemma 1, for the pendula (1)", "Beyond the paper, x")


def test_sentences_are_counted_by_whose_they_are_and_only_the_papers_are_reproduced(monkeypatch):
    claims = [reading(f"run{i}", place) for i, place in enumerate(PLACES)]
    rows = rows_of(monkeypatch, {f"run{i}": 1.0 for i in range(4)}, *claims)
    assert tally(rows) == {
        "of the paper": {"not reproduced": 1},
        "on its open questions": {"not reproduced": 1, "does not carry over": 1},
        "of this project": {"not reproduced": 1},
    }
    assert all(one["passes"] for row in rows for one in row["controls"])
