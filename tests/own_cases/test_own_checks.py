"""The checks of any case: errors, chaos, the paper's statements; each also where it must fail."""

import numpy as np
import pytest
from pendula import Case, check, simulate
from pendula.own_cases import answers, checks
from pendula.problem import Problem

STILL = Case(omega=8, half_width=8, end_time=10)


@pytest.fixture(scope="module")
def still():
    return check(STILL)


def test_tiny_data_that_only_grow_are_no_chaos():
    tiny = Case(omega=2, half_width=3, initial={0: (1e-20, 1e-21)}, end_time=10,
                solver={"name": "taylor", "atol": 1e-34})  # fmt: skip
    found = check(tiny)
    assert "second_refusal" not in found.attrs and float(found["largest_difference"]) < 1e-9
    assert found["chaotic"] == 0 and float(found["exponent"]) > 1


TINY = Case(omega=-4, half_width=1, initial={0: ("1e-140", 0)}, end_time=2,
            solver={"name": "taylor", "atol": 1e-154})  # fmt: skip


def test_data_whose_errors_have_vanishing_squares_are_checked_all_the_same():
    found = checks.check_run(*made(TINY))
    assert found.attrs["second_name"] == "dop853" and "second_refusal" not in found.attrs
    assert float(found["largest_difference"]) < 1e-8


def test_a_wrong_run_breaks_lemma_2_and_its_bound():
    run = simulate(STILL)
    run["l2"].values *= np.exp(5.0 * run["tau"].values)
    said = dict(answers.of_case(check(STILL, run), True))
    assert "broken" in said["Lemma 2, growth of P"]
    assert "broken" in said["the smallest bound of these theorems"]


def test_the_numbers_of_lemma_1(still):
    assert float(still["gamma_0"]) == 2.0 and still["finite_rate"] == 0
    assert str(still["region"].values) == "theorem 1"
    assert float(still["from_start"]) <= 1 and float(still["energy_drift"]) < 1e-10


@pytest.mark.parametrize("initial", [{0: (0, 0)}, {0: (1, 1)}])
def test_chains_that_hardly_move_are_no_error(initial):
    found = check(Case(omega=1, half_width=0, boundary="periodic", initial=initial, end_time=0.1))
    assert found["chaotic"] == 0 and float(found["energy_drift"]) < 1e-13


def made(case):
    return Problem.of(case.shown_problem()), simulate(case)
