"""Unknown numbers and short series confirm no claim, unless their maker says what they mean."""

import numpy as np
import pytest
import xarray as xr
from replication.ledger.missing import missing
from replication.variables import FEW_CHOICES
from replication.variables import missing as meaning_of_nan


def dataset(values, tau, of_l2=None, of_tau=None) -> xr.Dataset:
    return xr.Dataset(
        {"l2": ("tau", np.array(values, float), of_l2 or {})}, {"tau": ("tau", tau, of_tau or {})}
    )


@pytest.mark.parametrize(
    ("data", "lack"),
    [
        (dataset([1, 2, 3], [0, 1, 2]), ""),
        (dataset([1, np.nan, 3], [0, 1, 2]), "l2 is unknown in part of run"),
        (dataset([1, np.nan, 3], [0, 1, 2], meaning_of_nan("no site")), ""),
        (dataset([1, 2], [0, 1]), "tau has fewer than 3 samples of run"),
        (dataset([1, 2], [0, 1], of_tau=FEW_CHOICES), ""),
        (dataset([1, 2], ["a", "b"]), ""),  # words name things
    ],
)
def test_what_confirms_nothing(data, lack):
    assert missing(["run"], {"run": data}) == lack
