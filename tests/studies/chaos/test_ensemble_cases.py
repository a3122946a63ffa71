"""Which cases have ensembles is configured, which are chaotic is measured: both must agree."""

import pytest
import xarray as xr
from pendula.datasets.checks import broken
from pendula.studies.chaos.ensembles import mismatched

CASES = ["fig2_small", "fig4_small", "fig4_large"]
MEASURED = xr.Dataset({"chaotic": ("case", [0, 1, 1])}, {"case": CASES})


@pytest.mark.parametrize(
    ("configured", "wrong"), [(CASES[1:], 0), (CASES[1:2], 1), (CASES, 1), (CASES[:1], 3)]
)
def test_a_difference_between_what_is_chaotic_and_what_has_ensembles_is_a_fault(configured, wrong):
    found = xr.Dataset({"mismatched": mismatched(configured, MEASURED)})
    assert int(found["mismatched"]) == wrong
    assert bool(broken(found.to_dict())) == bool(wrong)
