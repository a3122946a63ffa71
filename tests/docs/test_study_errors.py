"""The accepted results reach the error that each part of a study needs."""

import pytest
import study_errors
from facts import Baseline


@pytest.fixture(scope="module")
def reached():
    """Return the errors of the accepted results, by study and part."""
    return study_errors.errors(Baseline())


def test_the_error_of_each_part_is_below_the_one_that_it_needs(reached):
    pairs = {
        (study, part): (error, study_errors.given(study)["needs"][part])
        for study, errors in reached.items()
        for part, error in errors.items()
    }
    assert len(pairs) > 30
    assert {part: pair for part, pair in pairs.items() if not 0.0 < pair[0] < pair[1]} == {}


def test_every_error_that_a_configuration_needs_is_measured(reached):
    needed = {study: set(study_errors.given(study)["needs"]) for study in reached}
    assert needed == {study: set(errors) for study, errors in reached.items()}
