"""Datasets that are computed from other datasets come out of the accepted ones as accepted."""

import numpy as np
import pytest
import xarray as xr
from accepted import dataset
from pendula.configuration.schema import PAPER_CASES, PAPER_SWEEPS
from pendula.studies.theory.bounds import check_cases, check_sweeps


def of(folder, names):
    """Return the accepted datasets of these names in a folder."""
    return {name: dataset(f"{folder}/{name}") for name in names}


MADE = {
    "checks/cases": (lambda: check_cases(of("trajectories", PAPER_CASES)), 0.0),
    "checks/sweeps": (lambda: check_sweeps(of("sweeps", PAPER_SWEEPS)), 0.0),
}
"""What makes a dataset of others, and what may be off where its numbers are small."""


@pytest.mark.parametrize("name", MADE)
def test_a_dataset_comes_out_as_accepted(name):
    make, off = MADE[name]
    made, accepted = make(), dataset(name)
    made = xr.Dataset.from_dict(made) if isinstance(made, dict) else made
    for key, one in made.variables.items():
        known = accepted[key].variable.transpose(*one.dims)
        if one.dtype.kind == "f":
            np.testing.assert_allclose(one, known, rtol=1e-3, atol=off, err_msg=key)
        else:
            np.testing.assert_array_equal(one, known, err_msg=key)
