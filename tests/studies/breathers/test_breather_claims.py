"""Claims on breathers, each fed a right and a wrong case."""

import numpy as np
import pytest
import xarray as xr
from pendula.ledger.claim import evaluate
from pendula.studies.breathers.claims import GROWTH, PERIODIC, SENSITIVITY, STEADY


@pytest.fixture
def sources():
    """Return datasets in which all claims hold."""
    families, omegas = ["A only", "A = B"], [-13.0, -4.0, 8.0]
    rates = np.array([[0.0, 0.5, 0.1], [0.0, 0.4, 0.2]])
    over = ("family", "omega")
    steady = xr.Dataset(
        {
            "power": (over, np.ones((2, 3))),
            "growth": (over, rates), "growth_half": (over, rates),
        },
        {"family": families, "omega": omegas},
        {"residual": 1e-13},
    )  # fmt: skip
    power = np.zeros((2, 2, 3, 2)) + np.array([9.0, 20.0, 3.0])[:, None]
    growth = np.zeros((2, 3, 2))
    growth[1] = 1.0
    periodic = xr.Dataset(
        {
            "power": (("component", *over, "frequency"), power),
            "growth": ((*over, "frequency"), growth),
        },
        {"family": families, "omega": omegas, "frequency": [9.0, 12.0]},
    )  # fmt: skip
    drives, scaled = np.array([0.05, 0.1, 1.0]), np.linspace(0.0, 1.0, 21)
    law = np.minimum(6.0, 8.0 * scaled) * np.ones((3, 1))
    law[0] = 6.0 * scaled
    driven = xr.Dataset(
        {
            "time": (("gamma", "output"), scaled / drives[:, None] ** 2),
            "gained": (("gamma", "output"), 1.02 * law + np.array([[0], [0], [3.0]])),
            "predicted_gain": (("gamma", "output"), law),
        },
        {"gamma": drives},
    )
    shares = np.array([1.0, 1.0, 0.4, 0.1])
    sensitivity = xr.Dataset(
        {
            "share": ("size", shares), "share_low": ("size", shares - 0.1),
            "share_high": ("size", shares + 0.1), "spread": ("initial", [1, 0, 0]),
        },
        {"size": [1e-8, 1e-6, 1e-3, 1e-1], "initial": [4.9, 5.0, 5.1]},
        {"members": 20},
    )  # fmt: skip
    return {STEADY: steady, PERIODIC: periodic, GROWTH: driven, SENSITIVITY: sensitivity}


def verdicts(sources):
    return {row["name"]: row["verdict"] for row in evaluate(sources, None, ("breathers/claims",))}


def test_all_hold_where_they_should_and_every_control_is_refused(sources):
    rows = evaluate(sources, None, ("breathers/claims",))
    assert {row["verdict"] for row in rows} <= {"confirmed", "confirmed with a caveat"}
    assert all(control["passes"] for row in rows for control in row["controls"])
    assert len(rows) == 5


@pytest.mark.parametrize(
    ("name", "source", "change"),
    [
        ("steady_unstable", STEADY, lambda one: one.assign(growth=one["growth"] * 0.0)),
        ("steady_unstable", STEADY, lambda one: one.assign(growth_half=one["growth"] * 0.0)),
        ("periodic_stable", PERIODIC, lambda one: one.assign(growth=one["growth"] + 0.1)),
        ("data_below_breathers", PERIODIC, lambda one: one.assign(power=one["power"] * 0.6)),
        ("grows_by_drive", GROWTH, lambda one: one.assign(gained=1.3 * one["gained"])),
        ("grows_by_drive", GROWTH, lambda one: one.assign(gained=0.8 * one["gained"])),
        (
            "spreading_is_an_accident", SENSITIVITY,
            lambda one: one.assign(share_low=one["share_low"] - 0.5),
        ),
        (
            "spreading_is_an_accident", SENSITIVITY,
            lambda one: one.assign(share_high=one["share_high"] + 0.4),
        ),
    ],
)  # fmt: skip
def test_a_wrong_dataset_is_refused(sources, name, source, change):
    assert verdicts({**sources, source: change(sources[source])})[name] == "not reproduced"


@pytest.mark.parametrize(
    ("name", "source", "change"),
    [
        ("steady_unstable", STEADY, lambda one: one.sel(omega=[-13.0])),
        ("periodic_stable", PERIODIC, lambda one: one.sel(omega=[8.0])),
        ("grows_by_drive", GROWTH, lambda one: one.sel(gamma=[1.0])),
        ("spreading_is_an_accident", SENSITIVITY, lambda one: one.isel(size=[0, 1])),
    ],
)
def test_without_its_case_a_claim_cannot_be_decided(sources, name, source, change):
    assert verdicts({**sources, source: change(sources[source])})[name] == "cannot be decided"
