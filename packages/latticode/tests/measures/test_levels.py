"""Where curves level off."""

import numpy as np
import pytest
from latticode.measures.levels import levelling

WIDTHS = np.array([5.0, 10.0, 20.0, 40.0, 80.0])


@pytest.mark.parametrize(
    ("values", "more", "level"),
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
def test_a_curve_is_level_from_where_all_that_follows_is_like_its_end(values, more, level):
    assert levelling(WIDTHS, np.array(values), **more) == level
