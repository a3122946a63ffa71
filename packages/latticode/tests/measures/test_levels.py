"""Where curves level off, what range they have, and the means of ensembles with their errors."""

import numpy as np
import pytest
from latticode.measures.levels import levelling, levelling_of_means

WIDTHS = np.array([5.0, 10.0, 20.0, 40.0, 80.0])


@pytest.mark.parametrize(
    ("values", "more", "found"),
    [
        ([1.0, 2.0, 3.0, 3.0, 3.01], {}, 20.0),
        ([3.0, 2.0, 3.0, 3.0, 3.0], {}, 20.0),
        ([7.0, 7.0, 7.0, 7.0, 7.0], {}, 5.0),
        ([1.0, 2.0, 3.0, 3.0, 3.1], {}, np.inf),
        ([1.0, 2.0, 3.0, 3.0, 3.1], {"tolerance": 0.1}, 20.0),
        ([1.25, 1.0, 1.0, 1.0, 1.0], {"tolerance": 0.25}, 5.0),  # by just the tolerance
        ([1.0, 2.0, 2.5, 3.0, 3.0], {}, np.inf),  # two values that agree are no level ...
        ([1.0, 2.0, 2.5, 3.0, 3.0], {"least": 2}, 40.0),  # ... unless two are enough
        ([1.0, 2.0, 10.0, 10.04, 10.08], {}, np.inf),  # by less than the tolerance a step
    ],
)
def test_a_curve_is_level_from_where_all_that_follows_is_like_its_end(values, more, found):
    assert levelling(WIDTHS, np.array(values), **more) == found


@pytest.mark.parametrize(
    ("means", "errors", "more", "found"),
    [
        ([1.0, 2.0, 2.9, 3.1, 3.0], [0.1] * 5, {}, 20.0),
        ([1.0, 2.0, 2.9, 3.1, 3.0], [0.01] * 5, {}, np.inf),
        ([1.0, 2.0, 2.9, 3.1, 3.0], [1.0] * 5, {}, 5.0),
        ([9.0, 10.0, 0.0, 0.0, 0.0], [3.0, 3.0, 3.0, 3.0, 4.0], {}, 5.0),  # by just the noise
        ([9.0, 10.0, 0.0, 0.0, 0.0], [3.0, 3.0, 3.0, 3.0, 4.0], {"apart": 1.9}, 20.0),
        ([1.0, 2.0, 3.0, 4.0, 4.0], [0.01] * 5, {}, np.inf),
        ([1.0, 2.0, 3.0, 4.0, 4.0], [0.01] * 5, {"least": 2}, 40.0),
        ([1.0, 2.0, 3.0, 3.2, 3.4], [0.1] * 5, {}, np.inf),
    ],
)
def test_means_are_level_where_their_errors_hide_the_rest(means, errors, more, found):
    given = np.array(means), np.array(errors)
    assert levelling_of_means(WIDTHS, *given, **{"apart": 2.0} | more) == found
