"""What decides the sentences on the energy: its drift by both readings, and to which time."""

import numpy as np
import pytest
import xarray as xr
from pendula.ledger.criterion import Verdict
from pendula.studies.paper import claims_energy


@pytest.mark.parametrize(
    ("drifts", "start", "verdict", "said"),
    [
        (((1e-6, 1.9e-6), (1e-7, 1e-7)), 1.0, Verdict.CONFIRMED, ""),
        (((1e-6, 3e-6), (1e-7, 1e-7)), 1.0, Verdict.UNDECIDED, "up to which time"),
        (((1e-6, 3e-6), (1e-7, 1e-7)), 1.0, Verdict.UNDECIDED, "case0 to tau = 11, in case1 to"),
        (((1e-7, 1e-7), (3e-6, 3e-6)), 1.0, Verdict.NOT_REPRODUCED, "case1 to tau = 1"),
        (((1e-7, 1e-7), (3e-6, 3e-6)), 100.0, Verdict.UNDECIDED, "which it means"),
        (((1e-7, 1e-7), (1e-6, 1e-6)), 0.01, Verdict.UNDECIDED, "which it means"),
        (((1e-7, 1e-7), (3e-4, 3e-4)), 100.0, Verdict.NOT_REPRODUCED, "case1 to tau = 1"),
    ],
)
def test_an_energy_that_only_some_readings_keep_is_not_decided(drifts, start, verdict, said):
    """Each case drifts by the first number to tau = 10, and by the second one to tau = 50."""
    tau, runs = np.linspace(0.0, 50.0, 51), []
    for i, (early, late) in enumerate(drifts):
        energy = start + np.where(tau <= 10, early, late) * (tau > 0)
        runs.append(xr.Dataset({"energy": ("tau", energy)}, {"tau": tau}, {"case": f"case{i}"}))
    finding = claims_energy.drifts(runs, "small")
    assert finding.verdict == verdict and said in finding.because
