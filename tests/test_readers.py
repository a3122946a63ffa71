"""Nothing that a run makes is without a reader, and what is planted without one is found."""

import pytest
from code_words import words_of_function, words_of_text
from pendula.ledger.claim import Claim
from readers import Made, Run, run_of, unread


@pytest.fixture(scope="module")
def run(full_run) -> Run:
    return run_of(full_run / "results")


def test_all_that_a_run_makes_has_a_reader(run):
    assert list(unread(run)) == []


CLAIM = Claim("mine", "Beyond the paper", "It is mine.", (), lambda: None, ())


@pytest.mark.parametrize(
    ("plant", "found"),
    [
        (lambda run: {"claims": (*run.claims, CLAIM)}, ["claim mine"]),
        (lambda run: {"tables": [*run.tables, "mine.md"]}, ["table mine.md"]),
        (lambda run: with_dataset(run, "checks/mine"), ["dataset checks/mine"]),
        (lambda run: with_dataset(run, "figures/mine"), ["figure figures/mine"]),
        (lambda run: with_variable(run, "checks/lyapunov"), ["variable checks/lyapunov:planted"]),
    ],
)
def test_what_nobody_reads_is_found(run, plant, found):
    assert list(unread(run._replace(**plant(run)))) == found


def test_what_only_an_unread_figure_reads_has_no_reader(run):
    """The article has shown it, and its dataset, and all that this was computed from, with it."""
    told = set(unread(run._replace(article="", pages="", claims=())))
    assert {"figure figures/growth_law", "dataset unbounded/growth", "dataset checks/trust"} <= told
    assert not any(one.startswith("dataset trajectories/") for one in told)


def with_dataset(run: Run, name: str, sources=()) -> dict:
    return {"datasets": run.datasets | {name: Made(("planted",), "", sources)}}


def with_variable(run: Run, name: str) -> dict:
    made = run.datasets[name]
    return {"datasets": run.datasets | {name: made._replace(variables=("planted",))}}


def test_words_are_those_of_functions_and_of_what_they_name_in_other_modules():
    drift = words_of_function("pendula.studies.paper.claims_energy", "energy_small")
    assert "largest_drift" in drift and "median" not in drift
    text = words_of_text('a sentence with of("checks/a", "l2") and f"checks/{one}" or size=1')
    assert all(one in text for one in ("checks/a", "checks/any", "l2", "size"))
    assert "sentence" not in text and "and" not in text
