"""The checks of any case: errors, chaos, the paper's statements; each also where it must fail."""

import numpy as np
import pytest
from pendula import Case, check, simulate
from pendula.own_cases import answers, checks
from pendula.problem import PaperProblem

REGULAR = Case(omega=8, half_width=8, end_time=10)


@pytest.fixture(scope="module")
def measured():
    return check(REGULAR)


def test_tiny_data_that_only_grow_are_no_chaos():
    tiny = Case(
        omega=2,
        half_width=3,
        initial={0: (1e-20, 1e-21)},
        end_time=10,
        solver={"name": "taylor", "atol": 1e-34},
    )
    measured_checks = check(tiny)
    assert (
        "second_refusal" not in measured_checks.attrs
        and float(measured_checks["largest_difference"]) < 1e-9
    )
    assert measured_checks["chaotic"] == 0 and float(measured_checks["exponent"]) > 1


TINY = Case(
    omega=-4,
    half_width=1,
    initial={0: ("1e-140", 0)},
    end_time=2,
    solver={"name": "taylor", "atol": 1e-154},
)


def test_data_whose_errors_have_vanishing_squares_are_checked_all_the_same():
    measured_checks = checks.check_run(*problem_and_run(TINY))
    assert (
        measured_checks.attrs["second_name"] == "dop853"
        and "second_refusal" not in measured_checks.attrs
    )
    assert float(measured_checks["largest_difference"]) < 1e-8


def test_a_wrong_run_breaks_lemma_2_and_its_bound():
    run = simulate(REGULAR)
    run["l2"].values *= np.exp(5.0 * run["tau"].values)
    answered = dict(answers.answer_questions(check(REGULAR, run), True))
    assert "violated" in answered["Lemma 2, growth of P"]
    assert "violated" in answered["the smallest bound of these theorems"]


def test_the_numbers_of_lemma_1(measured):
    assert float(measured["gamma_0"]) == 2.0 and measured["finite_rate"] == 0
    assert str(measured["region"].values) == "theorem 1"
    assert float(measured["from_start"]) <= 1 and float(measured["energy_drift"]) < 1e-10


@pytest.mark.parametrize("initial", [{0: (0, 0)}, {0: (1, 1)}])
def test_chains_that_hardly_move_are_no_error(initial):
    measured_checks = check(
        Case(omega=1, half_width=0, boundary="periodic", initial=initial, end_time=0.1)
    )
    assert measured_checks["chaotic"] == 0 and float(measured_checks["energy_drift"]) < 1e-13


def problem_and_run(case):
    return PaperProblem.of(case.shown_problem()), simulate(case)
