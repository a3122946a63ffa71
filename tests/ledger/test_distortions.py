"""Wrong cases that deciding functions once confirmed, and general distortions of every dataset."""

from pathlib import Path

import numpy as np
import pytest
from pendula.datasets.netcdf import read
from pendula.ledger.claim import all_claims, confirmed, decide, needed

BASELINE = Path(__file__).parents[1] / "baseline"


@pytest.fixture(scope="module")
def accepted():
    """Return the accepted datasets that decide claims and feed controls, by name."""
    return {name: read(str(BASELINE / f"{name}.nc")) for name in needed()}


def rates_exchanged(over_the_top):
    """Exchange the rates and limits of the second and the third mu of those that are known."""
    order = np.arange(over_the_top.sizes["mu"])
    order[[1, 2]] = order[[2, 1]]
    rates = [name for name in over_the_top if str(name).startswith("passage_rate")]
    return over_the_top.assign({name: ("mu", over_the_top[name].values[order]) for name in rates})


def higher(sweep):
    factors = np.ones(sweep.sizes["half_width"])
    factors[1:5] = 1.3
    return sweep.assign(l2=sweep["l2"] * sweep["half_width"].copy(data=factors))


def four_unknown(steady):
    known = steady["family"] == steady["family"][-1]
    return steady.assign({name: one.where(known) for name, one in steady.items()
                          if "family" in one.dims})  # fmt: skip


def of_half_power(periodic):
    power = periodic["power"]
    return periodic.assign(power=power.where(periodic["family"] != "A = B", 0.5 * power))


HOLES = [
    ("waiting_grows", "pendula/over_the_top", rates_exchanged),
    ("ends_near_stable", "breathers/fates",
     lambda fates: fates.assign(case_distance=20.0 * fates["case_distance"])),
    ("data_below_breathers", "breathers/periodic", of_half_power),
    ("fig4_unstable", "trajectories/fig4_small", "trajectories/fig4_large"),
    ("fig5_decreases", "sweeps/fig5_left", higher),
    ("fig5_not_shown", "checks/not_shown", higher),
    ("steady_unstable", "breathers/steady", four_unknown),
    ("horizon_logarithmic", "pendula/remainder",
     lambda remainder: remainder.assign(visible_from=1.5 * remainder["visible_from"])),
]  # fmt: skip


@pytest.mark.parametrize(("name", "needs", "wrong"), HOLES, ids=[hole[0] for hole in HOLES])
def test_a_wrong_case_is_not_confirmed(accepted, name, needs, wrong):
    (claim,) = (claim for claim in all_claims() if claim.name == name)
    assert confirmed(decide(claim, accepted))
    fed = accepted[wrong] if isinstance(wrong, str) else wrong(accepted[needs])
    assert not confirmed(decide(claim, {**accepted, needs: fed}))


@pytest.mark.parametrize("name", ["fig2_exchange", "fig2_maxima"])
def test_small_data_at_minus_four_are_a_right_case_by_the_paper(name):
    """Fig 3 shows "no drastic difference" for them: the control has to be confirmed."""
    (claim,) = (claim for claim in all_claims() if claim.name == name)
    runs = [control for control in claim.controls if control.names == ["trajectories/fig3_small"]]
    assert [control.confirms for control in runs] == [True]
