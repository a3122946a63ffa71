"""Datasets that are computed from other datasets come out of the accepted ones as accepted."""

import numpy as np
import xarray as xr
from accepted import dataset
from pendula.configuration.schema import PAPER_CASES
from pendula.studies.theory.bounds import check_cases


def test_the_check_of_the_cases_comes_out_as_accepted():
    made = check_cases({name: dataset(f"trajectories/{name}") for name in PAPER_CASES})
    accepted = dataset("checks/cases")
    for key, one in xr.Dataset.from_dict(made).variables.items():
        known = accepted[key].variable
        if one.dtype.kind == "f":
            np.testing.assert_allclose(one, known, rtol=1e-3, err_msg=key)
        else:
            np.testing.assert_array_equal(one, known, err_msg=key)
