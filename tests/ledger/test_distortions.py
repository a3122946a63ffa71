"""General distortions of every dataset, fed to every claim."""

import numpy as np
import pytest
import xarray as xr
from accepted import datasets
from pendula.ledger.claim import all_claims, needed
from pendula.ledger.distortions import BLIND, DISTORTIONS, MISSING, Said, distorted, in_words


@pytest.fixture(scope="module")
def told():
    """Return what the functions said of the distorted datasets, by claim and distortion."""
    return distorted(all_claims(), datasets(needed()))


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
