"""How the report and docs/ write what a study of breathers found."""

import pytest
import xarray as xr
from pendula.studies.breathers.section import share_with_limits


@pytest.mark.parametrize(
    ("shares", "said"),
    [
        ((0.1423, 0.14, 0.1444), "14.2 % (14 to 14.4)"),
        ((0.0, 0.0, 1.85e-4), "0 % (0 to 0.0185)"),
        ((1.0, 1 - 1.85e-4, 1.0), "100 % (99.9815 to 100)"),
        ((0.9995, 0.99, 0.99951), "99.95 % (99 to 99.951)"),
        ((1 - 1.23e-8, 1 - 1.23e-6, 1.0), "99.99999877 % (99.999877 to 100)"),
    ],
)
def test_a_share_of_nearly_everything_has_the_digits_of_the_rest(shares, said):
    one = xr.Dataset(dict(zip(("area", "area_low", "area_high"), shares, strict=True)))
    assert share_with_limits(one) == said
