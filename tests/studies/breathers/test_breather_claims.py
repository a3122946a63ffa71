"""Claims on breathers, each fed a right and a wrong case."""

import numpy as np
import pytest
import xarray as xr
from helpers import verdict_of
from made_up_breathers import sensitivity
from pendula.ledger.claim import evaluate
from pendula.studies.breathers.claims import GROWTH, MAP, PERIODIC, SENSITIVITY, STEADY


def collisions(*shape: int) -> dict:
    """Return two collisions: a quartet, and a pair that meets itself at one."""
    over = ("parity", "family", "omega", "frequency")
    frequency, multiplier = np.full((2, *shape), np.nan), np.full((2, 2, *shape), np.nan)
    signature = np.zeros((2, 2, *shape), np.int8)
    for parity, at_end in ((0, False), (1, True)):
        frequency[parity, 0, -1, 0] = 9.5
        multiplier[:, parity, 0, -1, 0] = (1.0, 0.0) if at_end else (0.8, 0.6)
        signature[:, parity, 0, -1, 0] = (1, -1)
    return {
        "collision_frequency": (over, frequency),
        "collision_multiplier": (("part", *over), multiplier),
        "collision_signature": (("colliding", *over), signature),
    }


@pytest.fixture
def sources():
    """Return datasets in which all claims hold."""
    families, omegas = ["A only", "A = B"], [-13.0, -4.0, 8.0]
    rates = np.array([[0.0, 0.5, 0.1], [0.0, 0.4, 0.0]])
    over = ("family", "omega")
    steady = xr.Dataset(
        {
            "power": (over, np.ones((2, 3))),
            "growth": (over, rates), "growth_half": (over, rates),
        },
        {"family": families, "omega": omegas},
        {"residual": 1e-13},
    )  # fmt: skip
    power = np.zeros((2, 2, 3, 3)) + np.array([9.0, 20.0, 3.0])[:, None]
    growth = np.zeros((2, 3, 3))
    growth[1] = 1.0
    periodic = xr.Dataset(
        {
            "power": (("component", *over, "frequency"), power),
            "least_power": ((*over, "instant"), 2.0 * power.min(axis=(0, 3))[..., None] + [1, 0]),
            "growth": ((*over, "frequency"), growth),
            "growth_half": ((*over, "frequency"), growth + 1e-3 * (growth > 0.0)),
            "parity_growth": (
                ("parity", *over, "frequency"), np.stack([growth + 0.1 * np.arange(3), growth]),
            ),
            "measured_growth": (
                ("parity", *over, "frequency"),
                1.0003 * np.stack([growth + 0.1 * np.arange(3), np.where(growth, growth, np.nan)]),
            ),
            "growing": ((*over, "frequency"), growth),
            "growing_half": ((*over, "frequency"), growth),
            "highest_wave": ("omega", [8.0, 8.0, 8.0]),
            **collisions(len(families), len(omegas), 3),
        },
        {"family": families, "omega": omegas, "frequency": [9.0, 12.0, 15.0], "part": ["re", "im"],
         "parity": ["even", "odd"]},
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
    made = {STEADY: steady, PERIODIC: periodic, GROWTH: driven, SENSITIVITY: sensitivity()}
    return made | {MAP: made_up_fates()}


def made_up_fates():
    """Return maps on which all spread at Omega = 0 but A = B, none at 8, and some at -4."""
    fate = np.ones((3, 3, 3), dtype=np.int8)
    fate[0, 0] = 3
    fate[1] = 3 - 2 * np.eye(3, dtype=np.int8)
    turned = np.array([[[1, 3]], [[3, 3]], [[0, 1]]], dtype=np.int8)
    words = {"flag_meanings": "disperses stays moves spreads"}
    return xr.Dataset(
        {
            "fate": (("omega", "a0", "b0"), fate, words),
            "turned_fate": (("omega", "turned_a0", "phase"), turned, words),
            "case_breather_frequency": ("case", [17.9, np.nan]),
            "case_distance": (("case", "family"), [[0.06, 0.7], [np.nan, np.nan]]),
        },
        {"omega": [-4.0, 0.0, 8.0], "a0": [1.0, 2.0, 3.0], "b0": [1.0, 2.0, 3.0],
         "family": ["A only", "A = B"], "case": ["fig2_large", "fig3_large"]},
    )  # fmt: skip


def with_fate(fates, name, omega, number):
    """Return maps with another fate at one point of one of them."""
    changed = fates[name].copy(deep=True)
    changed[{"omega": list(fates["omega"].values).index(omega)}][0, 1] = number
    return fates.assign({name: changed})


def verdict(name, sources):
    return verdict_of(name, sources, "breathers/claims")


def test_all_hold_where_they_should_and_every_control_is_refused(sources):
    rows = evaluate(sources, None, ("breathers/claims",))
    assert {row["verdict"] for row in rows} <= {"confirmed", "confirmed with a caveat"}
    assert all(control["passes"] for row in rows for control in row["controls"])
    assert len(rows) == 10


@pytest.mark.parametrize(
    ("name", "source", "change"),
    [
        ("steady_unstable", STEADY, lambda one: one.assign(growth=one["growth"] * 0.0)),
        ("steady_unstable", STEADY, lambda one: one.assign(growth_half=one["growth"] * 0.0)),
        ("periodic_stable", PERIODIC, lambda one: one.assign(growth=one["growth"] + 0.1)),
        ("periodic_stable", PERIODIC, lambda one: one.assign(growth_half=one["growth"] + 0.1)),
        ("stable_on_any_chain", PERIODIC, lambda one: one.assign(growth_half=0 * one["growth"])),
        ("stable_on_any_chain", STEADY, lambda one: one.assign(growth_half=0 * one["growth"])),
        (
            "opposite_signatures_collide", PERIODIC,
            lambda one: one.assign(collision_signature=0 * one["collision_signature"]),
        ),
        (
            "grows_as_floquet_says", PERIODIC,
            lambda one: one.assign(measured_growth=1.002 * one["measured_growth"]),
        ),
        (
            "data_below_breathers", PERIODIC,
            lambda one: one.assign(least_power=one["least_power"] * np.array([1.0, 0.6])),
        ),
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
        ("ends_near_stable", MAP, lambda one: one.assign(case_distance=one["case_distance"] + 1.0)),
        ("ends_near_stable", PERIODIC, lambda one: one.assign(growth=one["growth"] + 0.1)),
        ("detuning_decides", MAP, lambda one: with_fate(one, "fate", 8.0, 3)),
        ("detuning_decides", MAP, lambda one: with_fate(one, "turned_fate", 8.0, 3)),
        ("detuning_decides", MAP, lambda one: with_fate(one, "turned_fate", 0.0, 1)),
    ],
)  # fmt: skip
def test_a_wrong_dataset_is_refused(sources, name, source, change):
    changed = {**sources, source: change(sources[source])}
    assert verdict(name, changed) == "not reproduced"


def test_what_a_finite_chain_makes_within_the_waves_is_a_caveat(sources):
    one = sources[PERIODIC]
    wide = one.assign(highest_wave=one["highest_wave"] + 2.0)
    wide["growing"].loc[{"frequency": 9.0}] = 7.0
    wide["growth_half"].loc[{"frequency": 9.0}] = 0.0  # a verdict that is not asked there
    (row,) = (
        row
        for row in evaluate({**sources, PERIODIC: wide}, None, ("breathers/claims",))
        if row["name"] == "stable_on_any_chain"
    )
    assert row["verdict"] == "confirmed with a caveat"
    assert "7 growing multipliers" in row["because"]


@pytest.mark.parametrize(
    ("name", "source", "change"),
    [
        ("steady_unstable", STEADY, lambda one: one.sel(omega=[-13.0])),
        ("periodic_stable", PERIODIC, lambda one: one.sel(omega=[8.0])),
        (
            "opposite_signatures_collide",
            PERIODIC,
            lambda one: one.assign(collision_frequency=one["collision_frequency"] * np.nan),
        ),
        (
            "grows_as_floquet_says",
            PERIODIC,
            lambda one: one.assign(measured_growth=one["measured_growth"] * np.nan),
        ),
        ("grows_by_drive", GROWTH, lambda one: one.sel(gamma=[1.0])),
        ("spreading_is_an_accident", SENSITIVITY, lambda one: one.isel(size=[0, 1])),
        ("ends_near_stable", MAP, lambda one: one.sel(case=["fig3_large"])),
        ("detuning_decides", MAP, lambda one: one.sel(omega=[-4.0, 8.0])),
    ],
)
def test_without_its_case_a_claim_cannot_be_decided(sources, name, source, change):
    changed = {**sources, source: change(sources[source])}
    assert verdict(name, changed) == "cannot be decided"
