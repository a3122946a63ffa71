"""Wrong cases that deciding functions once confirmed, and general distortions of every dataset."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from pendula.datasets.netcdf import read
from pendula.ledger.claim import all_claims, confirmed, decide, needed
from pendula.ledger.distortions import BLIND, DISTORTIONS, MISSING, Said, distorted, in_words

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
    least = periodic["least_power"]
    return periodic.assign(least_power=least.where(periodic["family"] != "A = B", 0.5 * least))


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


@pytest.fixture(scope="module")
def told(accepted):
    """Return what the functions said of the distorted datasets, by claim and distortion."""
    return distorted(all_claims(), accepted)


def test_a_distortion_confirms_a_claim_only_where_a_reason_is_declared(told):
    needed = {(distortion.kind, name) for (name, distortion), said in told.items() if said.blind}
    declared = [
        (kind, name)
        for kind, reasons in BLIND.items()
        for names in reasons.values()
        for name in names.split()
    ]
    assert sorted(needed - set(declared)) == []
    assert sorted(set(declared) - needed) == [], "reasons that no claim needs"
    assert len(set(declared)) == len(declared)


def test_what_is_missing_confirms_nothing(told):
    missing = [(name, each) for name, each in told if each.kind == MISSING]
    assert len(missing) > len(all_claims())
    for name, each in missing:
        assert told[name, each].within == told[name, each].blind == [], (name, each.says)


def test_every_claim_is_refused_or_not_decided_in_some_way(told):
    """A function that confirms its claim whatever it is fed decides nothing."""
    heard = {name for (name, _), said in told.items() if said.refused or said.undecided}
    assert {claim.name for claim in all_claims()} == heard


def test_the_distortions_distort():
    run = xr.Dataset(
        {"l2": (("component", "tau"), [[1.0, 2.0, 4.0], [5.0, 6.0, 7.0]]), "life": 3.0},
        {"component": ["A", "B"], "tau": [0.0, 1.0, 2.0]},
        {"omega": 8.0},
    )
    other = run.assign_attrs(omega=0.0)
    sources = {"runs/one": run, "runs/same": run, "runs/two": other}
    made = {one.says: one.change("runs/one", sources) for one in DISTORTIONS}
    assert made["another Omega"] is other
    assert list(made["A and B exchanged"].sel(component="B")["l2"].values) == [1.0, 2.0, 4.0]
    assert list(made["in reverse order"].sel(component="A", tau=0.0)["l2"].values.flat) == [4.0]
    assert list(made["two samples alone"]["tau"].values) == [0.0, 2.0]
    hidden = made["half unknown"]
    assert np.isnan(hidden["l2"].values).sum() == 3 and np.isnan(hidden["life"])
    assert float(made["scaled by 1.3"]["life"]) == pytest.approx(3.9)
    noise = made["noise of 10 %"]["l2"].values / run["l2"].values - 1.0
    assert np.abs(noise).min() > 0.0 and np.abs(noise).max() < 0.5


def test_words_tell_what_was_confirmed_and_why():
    said = {("unbounded_large", DISTORTIONS[0]): Said(["a"], ["b", "c"], [], ["unbounded/x"])}
    (row,) = in_words(said)
    assert row == {
        "claim": "unbounded_large",
        "fed": "general distortions",
        "another Omega": "refused 1, not decided 2, confirmed by unbounded/x: "
        "that dataset is told beside what decides",
    }
