"""What a proof of breathers stores, of states that exist and at a wrong Omega."""

import numpy as np
from latticode.datasets.netcdf import as_xarray
from pendula.studies.certified.proved_breathers import prove_breathers

PROOFS = [
    {"family": "A = B real", "omega": -8.0, "epsilon": 1.0},
    {"family": "A = B real", "omega": -4.0, "epsilon": 1.0},
    {"family": "A = B real", "omega": -10.0, "epsilon": 1.0},
]


def test_states_are_proved_and_wrong_ones_refused():
    proved = as_xarray(*prove_breathers(1.0, 18, PROOFS, [2.0, -8.001]))
    assert np.isinf(proved["wrong_radius"][0]) and proved["wrong_radius"][1] > 1e-5
    assert list(proved["proof_refusal"].values) == ["", "", ""]
    assert float(proved["radius"].max()) < 1e-12
