"""The accepted results reach the error that each part of a study needs."""

import pytest
import render
import study_errors
from facts.baseline import Baseline

REACHED = study_errors.errors(Baseline(render.BASELINE))
PARTS = [(study, part) for study, parts in REACHED.items() for part in parts]


@pytest.mark.parametrize(("study", "part"), PARTS)
def test_the_error_of_a_part_is_below_the_one_that_it_needs(study, part):
    needed = study_errors.given(study)["needs"][part]
    assert 0.0 < REACHED[study][part] < needed


@pytest.mark.parametrize("study", REACHED)
def test_every_error_that_a_configuration_needs_is_measured(study):
    assert set(study_errors.given(study)["needs"]) == set(REACHED[study])
