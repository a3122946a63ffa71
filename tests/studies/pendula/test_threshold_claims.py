"""Claims on the threshold of the pendula, each fed a right and a wrong case."""

import pytest
from helpers import verdict_of
from pendula.datasets.netcdf import as_xarray
from pendula.ledger.claim import evaluate
from pendula.studies.pendula.claims_threshold import THRESHOLD
from pendula.studies.pendula.threshold import threshold_contents

OMEGAS, MUS = [-8.0, -4.0, -1.0, 0.0, 2.0, 5.0, 8.0], [0.05, 0.1, 0.2, 0.3]
MODULE = "pendula/claims_threshold"


@pytest.fixture(scope="module")
def threshold():
    """Return the dataset at few detunings."""
    gammas = [0.5 * i for i in range(9)]
    return as_xarray(*threshold_contents(1.0, OMEGAS, MUS, 30, [-4.0, 0.0, 8.0], gammas, [-1.0]))


def verdict(name, threshold):
    return verdict_of(name, {THRESHOLD: threshold}, MODULE)


def test_all_are_decided_and_every_control_passes(threshold):
    rows = evaluate({THRESHOLD: threshold}, None, (MODULE,))
    assert {row["name"]: row["verdict"] for row in rows} == {
        "lemma_1_is_the_limit": "confirmed",
        "correction_of_the_threshold": "confirmed",
        "rates_of_the_pendula": "confirmed",
        "lemma_1_for_the_pendula": "does not carry over",
    }
    assert all(control["passes"] for row in rows for control in row["controls"])
    assert not any(row.get("caveat") for row in rows)


@pytest.mark.parametrize(
    ("name", "change"),
    [
        ("lemma_1_is_the_limit", lambda one: one.assign(gamma_0=1.01 * one["gamma_0"])),
        ("lemma_1_is_the_limit", lambda one: one.assign(gamma_0=one["gamma_0"] + 1e-9)),
        ("correction_of_the_threshold",
         lambda one: one.assign(gamma_0=one["gamma_0"] * (1.0 + 0.1 * one["mu"]))),
        ("rates_of_the_pendula", lambda one: one.assign(wave_rate=1.1 * one["wave_rate"])),
    ],
)  # fmt: skip
def test_a_claim_falls_where_its_measure_does(threshold, name, change):
    assert verdict(name, change(threshold)) == "does not carry over"


def test_the_lemma_would_hold_for_pendula_that_bear_more(threshold):
    stronger = threshold.assign(gamma_0=threshold["gamma_0_lemma"] * (1.0 + threshold["mu"]))
    assert verdict("lemma_1_for_the_pendula", stronger) == "confirmed"


def test_too_few_mu_and_one_side_of_the_band_decide_no_limit(threshold):
    few_mu = threshold.isel(mu=[0, 1])
    assert verdict("lemma_1_is_the_limit", few_mu) == "cannot be decided"
    assert verdict("rates_of_the_pendula", few_mu) == "cannot be decided"
    one_side = threshold.sel(omega=[-4.0, -1.0])
    assert verdict("correction_of_the_threshold", one_side) == "cannot be decided"
    assert verdict("lemma_1_is_the_limit", threshold.sel(omega=[2.0])) == "cannot be decided"
