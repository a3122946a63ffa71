"""Datasets that are computed from other datasets come out of the accepted ones as accepted."""

import numpy as np
import pytest
import xarray as xr
from accepted import dataset
from pendula.configuration.schema import PAPER_CASES
from pendula.studies.theory.bounds import check_cases
from pendula.studies.unbounded.measured import measure_fronts


def of(folder, names):
    """Return the accepted datasets of these names in a folder."""
    return {name: dataset(f"{folder}/{name}") for name in names}


RECOMPUTED = {
    "checks/cases": lambda: xr.Dataset.from_dict(check_cases(of("trajectories", PAPER_CASES))),
    "unbounded/fronts": lambda: measure_fronts(*of("unbounded", ("omegas", "thermal")).values()),
}


@pytest.mark.parametrize("name", RECOMPUTED)
def test_a_dataset_comes_out_as_accepted(name):
    recomputed, accepted = RECOMPUTED[name](), dataset(name)
    for key, variable in recomputed.variables.items():
        known = accepted[key].variable
        if variable.dtype.kind == "f":  # what is kept of long runs has single precision
            off = 2e-5 * float(np.abs(known).max()) if name.startswith("unbounded") else 0.0
            np.testing.assert_allclose(variable, known, rtol=1e-3, atol=off, err_msg=key)
        else:
            np.testing.assert_array_equal(variable, known, err_msg=key)
