"""Every hard case ends as declared; the longest ones in a shorter version."""

from inspect import signature

import numpy as np
import pytest
from helpers import chosen
from latticode.integrators.methods import NAMED
from pendula.studies.hard_cases import errors
from pendula.studies.hard_cases.outcomes import run_hard_case
from pendula.studies.hard_cases.settings import ARGUMENTS, CONTROLS

CASES = chosen("hard_cases").plain_cases()
SHORTER = {"drift_of_energy": {"tau": 200.0}, "miss_of_short_chain": {"half_width": 500}}


@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case['case']}, {case['measure']}")
def test_a_hard_case_ends_as_declared(case):
    case = case | {"arguments": case["arguments"] | SHORTER.get(case["measure"], {})}
    results = [run_hard_case(case, solver) for solver in case["solvers"]]
    assert all(result["sound"] for result in results), results


def test_every_measure_is_used_and_says_against_what():
    assert {case["measure"] for case in CASES} == set(ARGUMENTS) == set(errors.REFERENCES)


@pytest.mark.parametrize("measure", ARGUMENTS)
def test_the_configuration_asks_for_the_arguments_of_each_measure(measure):
    solver, *arguments = signature(getattr(errors, measure)).parameters.values()
    needed = tuple(argument.name for argument in arguments if argument.default is argument.empty)
    optional = tuple(
        argument.name for argument in arguments if argument.default is not argument.empty
    )
    assert solver.name == "solver" and (needed, optional) == ARGUMENTS[measure]


@pytest.mark.parametrize("name", CONTROLS)
def test_the_configuration_asks_for_the_controls_of_each_solver(name):
    assert CONTROLS[name] == tuple(NAMED[name].controls)


@pytest.mark.parametrize(
    ("error", "expected", "sound"),
    [(1e-3, 1e-6, False), (1e-3, "refused", False), (1e-3, 1e-2, True), (np.nan, 1e-6, False)],
)
def test_an_error_is_sound_up_to_what_is_expected(error, expected, sound, monkeypatch):
    monkeypatch.setattr(errors, "run_anyway", lambda solver: error)
    case = {"case": "made up", "measure": "run_anyway", "arguments": {}, "expected": expected}
    assert run_hard_case(case, {"name": "taylor"})["sound"] == sound
