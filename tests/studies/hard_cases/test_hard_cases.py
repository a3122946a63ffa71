"""Every hard case ends as declared; the longest ones in a shorter version."""

import numpy as np
import pytest
from helpers import chosen
from pendula.datasets.netcdf import as_xarray
from pendula.studies.hard_cases import errors
from pendula.studies.hard_cases.outcomes import evaluate, outcomes, variables
from pendula.studies.hard_cases.settings import MEASURES
from pendula.studies.hard_cases.table import page

CASES = chosen("hard_cases").plain()
SHORTER = {"drift_of_energy": {"tau": 200.0}, "miss_of_short_chain": {"half_width": 500}}


def shortened(case):
    """Return a case as it is, or over a shorter time or a shorter chain where that is long."""
    return case | {"arguments": case["arguments"] | SHORTER.get(case["measure"], {})}


def case_of(name):
    """Return the first case of this name."""
    return next(case for case in CASES if case["case"] == name)


def dataset(results):
    """Return the outcomes as the job writes them."""
    return as_xarray(variables(results), {})


@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case['case']}, {case['measure']}")
def test_a_hard_case_ends_as_declared(case):
    results = outcomes([shortened(case)])
    assert len(results) == len(case["solvers"])
    assert all(result.sound for result in results), results


def test_every_measure_is_used_and_known():
    assert {case["measure"] for case in CASES} == set(MEASURES)
    assert all(callable(getattr(errors, name)) for name in MEASURES)


def test_a_case_without_the_expected_outcome_is_marked(monkeypatch):
    monkeypatch.setattr(errors, "motion_of_rest", lambda solver: 1e-3)
    solver = {"name": "taylor", "rtol": 1e-9, "atol": 1e-9}
    case = {"case": "made up", "against": "nothing", "measure": "motion_of_rest",
            "arguments": {}, "solvers": [solver], "expected": 1e-6}  # fmt: skip
    result = evaluate(case, solver)
    assert not result.sound
    assert page(dataset([result]))[-1].endswith("| NO |")
    assert not evaluate(case | {"expected": "refused"}, solver).sound
    assert evaluate(case | {"expected": 1e-2}, solver).sound
    monkeypatch.setattr(errors, "motion_of_rest", lambda solver: np.nan)
    assert not evaluate(case, solver).sound


def test_a_refusal_of_another_kind_is_marked():
    case = case_of("a step of 1e-12")
    assert not evaluate(case | {"expected": "contract"}, case["solvers"][0]).sound
    assert not evaluate(case | {"expected": 1.0}, case["solvers"][0]).sound


def test_the_page_and_the_dataset_say_what_came_of_every_run():
    results = outcomes([case_of("a step of 1e-12"), case_of("epsilon = 0")])
    columns = variables(results)
    assert list(columns["sound"].values) == [1, 1, 1, 1]
    assert np.isnan(columns["error"].values[:2]).all()
    assert "1e+12 steps" in columns["refusal"].values[0]
    _, words, lines = page(dataset(results))
    assert "4 runs, 0 with an outcome" in words and lines.count("\n|") == 5
