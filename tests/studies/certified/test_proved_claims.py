"""Claims on proved breathers, each fed a right and a wrong case."""

import numpy as np
import pytest
from helpers import verdict_of
from pendula.datasets.netcdf import as_xarray
from pendula.ledger.claim import evaluate
from pendula.studies.certified.claims_breathers import PROVED
from pendula.studies.certified.proved_breathers import breathers_contents

MODULE = "certified/claims_breathers"
PROOFS = [
    {"family": "A = B real", "omega": -8.0, "epsilon": 1.0},
    {"family": "A = B real", "omega": -4.0, "epsilon": 1.0},
    {"family": "A = B real", "omega": -10.0, "epsilon": 1.0},
]
WRONG = [{**PROOFS[1], "tested_at": 2.0}, {**PROOFS[1], "tested_at": -4.001}]


@pytest.fixture(scope="module")
def proved():
    return as_xarray(*breathers_contents(1.0, {"block": 18, "chain": 8}, PROOFS, WRONG))


@pytest.fixture
def sources(proved):
    """Return the dataset in which all claims hold."""
    return {PROVED: proved}


def test_all_hold_where_they_should_and_every_control_is_refused(sources):
    rows = evaluate(sources, None, (MODULE,))
    assert len(rows) == 2
    assert {row["verdict"] for row in rows} == {"confirmed"}
    assert all(control["passes"] for row in rows for control in row["controls"])


@pytest.mark.parametrize(
    ("name", "source", "change"),
    [
        ("breathers_exist", PROVED, lambda one: one.assign(radius=one["radius"] + 1e-11)),
        ("breathers_exist", PROVED, lambda one: one.assign(tail_factor=one["tail_factor"] + 1.0)),
        ("breathers_stable_or_not", PROVED, lambda one: one.isel(proof=[0])),
        (
            "breathers_stable_or_not", PROVED,
            lambda one: one.assign(chain_radius=one["chain_radius"] * np.inf),
        ),
    ],
)  # fmt: skip
def test_a_wrong_dataset_is_refused(sources, name, source, change):
    changed = {**sources, source: change(sources[source])}
    assert verdict_of(name, changed, MODULE) == "not reproduced"


def test_what_is_refused_is_said_in_the_dataset(proved):
    assert np.isinf(proved["wrong_radius"][0]) and proved["wrong_radius"][1] > 1e-5
    assert "band" in str(proved["wrong_refusal"].values[0])
    assert list(proved["proof_refusal"].values) == ["", "", ""]
    assert list(proved["stable"].values) == [1, 0, 1]
    assert proved["stable"].attrs["flag_meanings"] == "undecided unstable stable"
    assert float(proved["radius"].max()) < 1e-12
