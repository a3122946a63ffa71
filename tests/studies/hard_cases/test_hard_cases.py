"""Every hard case ends as declared; the longest ones in a shorter version."""

import numpy as np
import pytest
from hard_cases.tabulate_hard_cases import page
from pendula.datasets.netcdf import as_xarray
from pendula.studies.hard_cases import against_exact, against_runs, rows, table
from pendula.studies.hard_cases.row import Row, evaluate


def shortened(row):
    """Return a row as it is, or over a shorter time or a shorter chain where that is long."""
    if row.decide is against_exact.drift_of_energy:
        return row._replace(arguments={**row.arguments, "tau": 200.0})
    if row.decide is against_runs.miss_of_short_chain:
        return row._replace(arguments={**row.arguments, "half_width": 500})
    return row


@pytest.mark.parametrize("row", rows.ROWS, ids=lambda row: f"{row.case}, {row.decide.__name__}")
def test_a_hard_case_ends_as_declared(row):
    results = [evaluate(shortened(row), solver) for solver in row.solvers]
    assert all(result.sound for result in results), results


def dataset(results):
    """Return the outcomes as the job writes them."""
    return as_xarray(table.variables(results), {})


def test_a_row_without_the_expected_outcome_is_marked():
    def off(solver):
        return 1e-3

    row = Row("made up", "nothing", off, ({"name": "taylor", "rtol": 1e-9, "atol": 1e-9},), 1e-6)
    result = evaluate(row, row.solvers[0])
    assert not result.sound
    assert page(dataset([result]))[-1].endswith("| NO |")
    assert not evaluate(row._replace(expected="refused"), row.solvers[0]).sound
    assert not evaluate(row._replace(decide=lambda solver: np.nan), row.solvers[0]).sound
    assert evaluate(row._replace(expected=1e-2), row.solvers[0]).sound


def test_a_refusal_of_another_kind_is_marked():
    (row,) = [row for row in rows.REFUSED if row.case == "a step of 1e-12"]
    assert not evaluate(row._replace(expected="contract"), row.solvers[0]).sound
    assert not evaluate(row._replace(expected=1.0), row.solvers[0]).sound


def test_the_page_and_the_dataset_say_what_came_of_every_run():
    row = next(row for row in rows.REFUSED if row.case == "a step of 1e-12")
    results = table.outcomes([row, rows.SPECIAL[0]])
    columns = table.variables(results)
    assert list(columns["sound"].values) == [1, 1, 1, 1]
    assert np.isnan(columns["error"].values[:2]).all()
    assert "1e+12 steps" in columns["refusal"].values[0]
    _, words, lines = page(dataset(results))
    assert "4 runs, 0 with an outcome" in words and lines.count("\n|") == 5
