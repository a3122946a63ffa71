"""What an ensemble of almost equal data may say, by the shares that spread from changed data."""

import pytest
import xarray as xr
from pendula.claims import almost_equal
from replication.ledger.criterion import Above, Verdict


def sensitivity(*shares: float, sizes=(1e-8, 1e-6, 1e-3, 1e-1)) -> xr.Dataset:
    """Return shares that spread, by the size of the change, with limits of a tenth."""
    share = xr.DataArray(list(shares), {"size": list(sizes)})
    return xr.Dataset({"share": share, "share_low": share - 0.1, "share_high": share + 0.1})


@pytest.mark.parametrize(
    ("shares", "within", "verdict"),
    [
        ((1.0, 1.0, 0.9, 0.8), 1e-6, Verdict.CONFIRMED),
        ((1.0, 1.0, 0.55, 0.45), 1e-7, Verdict.CAVEAT),  # open what data further away do
        ((1.0, 1.0, 0.4, 0.1), 1e-6, Verdict.CAVEAT),
        ((1.0, 1.0, 0.4, 0.1), 1e-3, Verdict.NOT_REPRODUCED),  # a wider ensemble needs more
        ((0.5, 1.0, 1.0, 1.0), 1e-7, Verdict.NOT_REPRODUCED),
        ((0.1, 0.4, 1.0, 1.0), 1e-7, Verdict.NOT_REPRODUCED),
    ],
)
def test_most_data_as_close_as_the_ensemble_must_spread(shares, within, verdict):
    near = almost_equal(sensitivity(*shares), within)
    assert near.judge({}).verdict == verdict
    assert near.judge({"x": 0.0}, Above(1.0, "x")).verdict == Verdict.NOT_REPRODUCED
    assert near.judge({"x": 2.0}, Above(1.0, "x"), caveat="but").because.startswith("but") == (
        verdict != Verdict.NOT_REPRODUCED
    )


def test_an_accident_is_reported_with_its_shares_and_the_smallest_change_stands_for_smaller_ones():
    finding = almost_equal(sensitivity(1.0, 0.9, 0.4, 0.1), 1e-6)
    assert finding.measured == {"share_nearby": 0.9}
    for words in ("up to 1e-06", "90%", "for 0.1", "10%"):
        assert words in finding.caveat
    assert "0.001" not in finding.caveat  # its upper limit is a half
    finding = almost_equal(sensitivity(0.9, 0.2, sizes=(1e-6, 1e-1)), 1e-7)
    assert finding.measured == {"share_nearby": 0.9}
