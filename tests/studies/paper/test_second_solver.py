"""Claims on the second solver: what decides them, and that draws of one law do not turn them."""

import numpy as np
import pytest
import xarray as xr
from latticode.measures.confidence import chance_inside
from pendula.studies.paper.claims_second_solver import first_as_second, shares_inside

RNG = np.random.default_rng(8)


def ensembles(second, first) -> xr.Dataset:
    """Return ensembles (step, half-width, member) and (half-width, member) as a run has them."""
    return xr.Dataset(
        {
            "l2": (("solver_step", "half_width", "member"), second),
            "first_l2": (("half_width", "first_member"), first),
        },
        {"solver_step": [0.01, 0.1], "half_width": [5, 15, 25]},
    )


def test_the_share_is_that_of_the_worst_half_width_by_step():
    first = np.tile([1.0, 2.0, 3.0], (3, 1))
    second = np.full((2, 3, 4), 2.0)
    second[0, 1, 0] = 3.5
    second[1, 2, :3] = 0.5
    assert shares_inside(ensembles(second, first)).tolist() == [0.75, 0.25]


def test_runs_of_the_first_solver_are_compared_with_others_of_it():
    first = RNG.random((3, 20))
    changed = first_as_second(ensembles(np.zeros((2, 3, 8)), first))
    np.testing.assert_array_equal(changed["l2"].values[1], first[:, :8])
    np.testing.assert_array_equal(changed["first_l2"].values, first[:, 8:])


@pytest.mark.parametrize("law", [RNG.standard_cauchy, RNG.random])
def test_draws_of_one_law_are_out_of_range_as_seldom_as_computed(law):
    """Whatever the law: here of 6 draws at most 3 lie within the range of 10 others."""
    drawn = law((20000, 16))
    low, high = drawn[:, 6:].min(axis=1), drawn[:, 6:].max(axis=1)
    inside = ((drawn[:, :6] >= low[:, None]) & (drawn[:, :6] <= high[:, None])).sum(axis=1)
    assert np.mean(inside <= 3) == pytest.approx(chance_inside(3, 6, 10), rel=0.1)
