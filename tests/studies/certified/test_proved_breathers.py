"""What a proof of breathers stores, of states that exist and at a wrong Omega."""

import numpy as np
from accepted import dataset
from latticode.datasets.netcdf import as_xarray
from pendula.studies.certified.proved_breathers import breathers_contents

PROOFS = [
    {"family": "A = B real", "omega": -8.0, "epsilon": 1.0},
    {"family": "A = B real", "omega": -4.0, "epsilon": 1.0},
    {"family": "A = B real", "omega": -10.0, "epsilon": 1.0},
]
WRONG = [{**PROOFS[1], "tested_at": 2.0}, {**PROOFS[1], "tested_at": -4.001}]


def test_what_is_refused_is_said_in_the_dataset():
    proved = as_xarray(*breathers_contents(1.0, {"block": 18, "chain": 8}, PROOFS, WRONG))
    assert np.isinf(proved["wrong_radius"][0]) and proved["wrong_radius"][1] > 1e-5
    assert "band" in str(proved["wrong_refusal"].values[0])
    assert list(proved["proof_refusal"].values) == ["", "", ""]
    assert list(proved["stable"].values) == [1, 0, 1]
    assert proved["stable"].attrs["flag_meanings"] == "undecided unstable stable"
    assert float(proved["radius"].max()) < 1e-12


def rates_of_steady_states_lie_in_their_enclosures(proved, steady):
    shared = [
        one
        for _, one in proved.groupby("proof")
        if str(one["family"].values.item()) in steady["family"].values
        and float(one["omega"].item()) in steady["omega"].values
        and float(one["epsilon"].item()) == steady.attrs["epsilon"]
    ]
    off = []
    for one in shared:
        at = {"family": one["family"].values.item(), "omega": one["omega"].item()}
        rate = float(steady["growth_half"].sel(at))
        beyond = max(rate - one["growth_high"].item(), one["growth_low"].item() - rate, 0.0)
        off.append(beyond / max(rate, 1.0))
    return len(off) >= 3 and max(off) < 1e-6  # the baseline has seven digits


def test_accepted_rates_of_steady_states_lie_in_their_enclosures_and_not_in_halves_of_them():
    proved, steady = dataset("certified/breathers"), dataset("breathers/steady")
    assert rates_of_steady_states_lie_in_their_enclosures(proved, steady)
    halved = proved.assign(growth_high=0.5 * proved["growth_high"])
    assert not rates_of_steady_states_lie_in_their_enclosures(halved, steady)
