"""What counts of a run once its start is forgotten."""

import numpy as np
import pytest
import xarray as xr
from pendula.ledger.claim import late
from pendula.ledger.criterion import UndecidableError


def run(end):
    return xr.Dataset(coords={"tau": np.arange(0.0, end + 0.25, 0.5)})


@pytest.mark.parametrize(("end", "start"), [(20.0, 10.0), (50.0, 10.0), (8.0, 4.0)])
def test_the_late_part_starts_where_it_is_told_to_and_goes_on_to_the_end(end, start):
    tau = late(run(end), start)["tau"].values
    assert tau[0] == start and tau[-1] == end and len(tau) == 2 * (end - start) + 1


def test_the_start_is_where_the_time_windows_of_the_paper_do():
    assert late(run(50.0))["tau"].values[0] == 10.0


def test_a_run_that_leaves_less_time_than_it_forgets_decides_nothing():
    with pytest.raises(UndecidableError, match=r"ends at tau = 19\.5, before 20"):
        late(run(19.5))
