"""The ledger as the report shows it, and numbers of it that other sections quote."""

import numpy as np
import pytest
from accepted import BASELINE, Report
from pendula.datasets.json_files import load_json, sealed
from pendula.ledger import section as claims
from pendula.report.results import Results

ROWS = load_json(BASELINE / "claims.json")["rows"]


@pytest.fixture
def of_rows(tmp_path):
    """Return a function: the results of a run that has rows of the ledger alone, or changed."""

    def results(*rows):
        (tmp_path / "claims.json").write_text(sealed({"rows": list(rows)}))
        return Results([str(tmp_path / "claims.json")], str(tmp_path / "report.html"))

    return results


def test_the_ledger_is_shown_and_counted():
    shown = claims.gather(Report())
    assert str(shown["total"]) == str(len(ROWS)) == str(len(shown["rows"]))
    assert [origin for origin, *_ in shown["counts"]] == [
        "of the paper",
        "on its open questions",
        "of this project",
    ]
    for origin, number, counts in shown["counts"]:
        own = [row["verdict"] for row in ROWS if row["origin"] == origin]
        assert str(number) == str(len(own))
        assert {word: str(count) for word, count in counts} == {
            word: str(own.count(word)) for word in own
        }
    (row,) = (row for row in shown["rows"] if row["name"] == "hamiltonian")
    assert row["data"][0].link == "checks/gradient.nc"
    assert row["criterion"].replace("\N{NO-BREAK SPACE}", " ").endswith("energy drift ≤ 10⁻⁷")


def test_verdicts_on_a_figure_are_those_of_the_paper_alone(of_rows):
    (row,) = (row for row in ROWS if row["name"] == "fig5_decreases")
    own = row | {"name": "own", "place": "Beyond the paper, Fig 5", "origin": "of this project"}
    ledger = claims.Ledger(of_rows(row, own))
    assert ledger.counts("Fig 5") == [(row["verdict"], 1)] and ledger.counts("Fig 6") == []


def test_numbers_of_the_ledger_link_to_what_decides_them(of_rows):
    ledger = claims.Ledger(Report())
    assert ledger.quote("hamiltonian", "energy_drift") == (
        "9.38\N{NO-BREAK SPACE}×\N{NO-BREAK SPACE}10⁻¹⁰",
        "checks/gradient.nc",
    )
    assert ledger.holds("hamiltonian") and ledger.verdict("theorem_3_proof") == "not reproduced"
    unknown = {**ROWS[0], "measured": {"y": "none"}}
    ledger = claims.Ledger(of_rows(unknown))
    assert np.isnan(ledger.value(unknown["name"], "y"))
    assert np.isnan(ledger.value(unknown["name"], "x"))
