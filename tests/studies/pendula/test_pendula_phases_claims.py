"""Claims on the phases of the pendula, each fed a right and a wrong case."""

import numpy as np
import pytest
import xarray as xr
from helpers import verdict_of
from pendula.ledger.claim import evaluate
from pendula.studies.pendula.claims_phases import PHASES, SEA, THERMAL, TOP

CASES = ["fig2_small", "fig2_large", "fig3_small", "fig3_large", "fig4_small", "fig4_large"]
MUS = np.array([0.0, 0.05, 0.1, 0.2, 0.3])


def phases():
    """Return norms of 2 that grow by 3 mu^2, and at Omega = -4 by a factor of 3 in time.

    All members stay below the bound of Theorem 1.
    """
    tau = np.arange(0.0, 51.0, 10.0)
    l2 = np.full((6, 5, 2, 6), 2.0) * (1.0 + 3.0 * MUS[:, None, None] ** 2)
    l2 *= np.arange(1.0, 7.0)[:, None, None, None]
    linf = l2.copy()
    l2[3] *= np.where(tau > 0, 3.0, 1.0)
    over = ("case", "mu", "component", "tau")
    bounds = {"theorem_1_power": ("case", [1e4, 1e4, *4 * [np.inf]])}
    bounds["theorem_3_power"] = ("case", 6 * [1e4])
    bounds["over_theorem_1"] = ("member", [0.9, 0.99, 0.7])
    bounds["member_mu"] = ("member", [0.3, 0.3, 0.3])
    coordinates = {"case": CASES, "mu": MUS, "component": ["A", "B"], "tau": tau}
    return xr.Dataset({"l2": (over, l2), "linf": (over, linf), **bounds}, coordinates)


CONSTANTS = {"epsilon": 1.0, "gamma": 1.0, "omega": 0.0}


def sea():
    powers = 18.0 + np.array([[0.1, -0.1, 0.0, 0.1], [0.2, -0.1, 0.1, 0.0]])
    cells = np.exp(-((np.arange(40) - 15.0) ** 2) / 40.0)
    shares = np.ones((2, 4, 1)) * cells / cells.sum()
    over = ("mu", "member")
    return xr.Dataset(
        {"site_power": (over, powers), "linf_level": (over, np.full((2, 4), 5.0)),
         "modulus_share": ((*over, "modulus"), shares)},
        {"mu": [0.0, 0.1]}, CONSTANTS,
    )  # fmt: skip


def over_the_top():
    """Return members that stay below the top, although some wait less than others."""
    mus, rates = [0.1, 0.15, 0.225], np.array([0.0, 0.01, 0.5])
    angles = np.ones((3, 4, 3)) * 12.0 * np.array(mus)[:, None, None]
    return xr.Dataset(
        {"passage_rate": ("mu", rates), "passage_rate_low": ("mu", 0.5 * rates),
         "passage_rate_high": ("mu", 2.0 * rates + 0.01),
         "angle_so_far": (("mu", "member", "tau"), angles),
         "angle_power": (("mu", "member"), np.full((3, 4), 1e3)),
         **{f"passed{end}": (("mu", "tau"), np.zeros((3, 3))) for end in ("", "_low", "_high")}},
        {"mu": mus, "tau": [10.0, 25.0, 50.0]},
    )  # fmt: skip


@pytest.fixture
def sources():
    """Return datasets in which all claims hold."""
    thermal = xr.Dataset({"power": ("omega", [22.5, 18.3])}, {"omega": [-1.0, 0.0]}, CONSTANTS)
    return {PHASES: phases(), SEA: sea(), TOP: over_the_top(), THERMAL: thermal}


def rows(sources):
    return {row["name"]: row for row in evaluate(sources, None, ("pendula/claims_phases",))}


def test_all_hold_where_they_should_and_every_control_is_answered(sources):
    found = rows(sources)
    assert len(found) == 7
    assert {row["verdict"] for row in found.values()} == {"confirmed"}
    assert all(one["passes"] for row in found.values() for one in row["controls"])


def at(name, factor, **where):
    """Return what multiplies a variable where its coordinates are these."""

    def change(data):
        places = [data[key].isin(values) for key, values in where.items()]
        here = places[0] & places[1] if len(places) > 1 else places[0]
        return data.assign({name: data[name].where(~here, factor * data[name])})

    return change


@pytest.mark.parametrize(
    ("name", "source", "change"),
    [
        ("pendula_norms", PHASES, at("l2", 1.1, mu=[0.05])),
        ("pendula_norms", PHASES, at("l2", 1.05, mu=[0.1], case=["fig3_small"])),
        ("pendula_spread", PHASES, at("l2", 0.5, mu=[0.2])),
        ("pendula_spread", PHASES, at("linf", 20.0, mu=[0.3])),
        ("theorem_1_for_the_pendula", PHASES, at("l2", 30.0, mu=[0.3], case=["fig2_large"])),
        (
            "theorem_1_for_the_pendula",
            PHASES,
            lambda one: one.assign(over_theorem_1=("member", [0.9, 0.99, 1.01])),
        ),
        ("theorem_3_for_the_pendula", PHASES, at("l2", 30.0, mu=[0.3], case=["fig4_large"])),
        ("theorem_3_for_the_pendula", TOP, at("angle_power", 20.0, mu=[0.225])),
        ("same_sea", SEA, at("site_power", 1.08, mu=[0.1])),
        ("same_sea", THERMAL, at("power", 1.2, omega=[0.0])),
        ("pendula_stay_below_the_top", TOP, at("angle_so_far", 20.0, mu=[0.225])),
        ("waiting_grows", TOP, at("passage_rate_low", 0.01, mu=[0.225])),
    ],
)
def test_a_wrong_case_is_not_confirmed(sources, name, source, change):
    sources[source] = change(sources[source])
    assert verdict_of(name, sources, "pendula/claims_phases") == "does not carry over"


def test_theorem_1_counts_the_members_beyond_its_bound(sources):
    sources[PHASES]["over_theorem_1"][:] = [1.5, 0.8, 1.1]
    measured = rows(sources)["theorem_1_for_the_pendula"]["measured"]
    assert measured["largest_over_bound"] == 1.5 and measured["at_mu"] == 0.3
    assert (measured["members_over_bound"], measured["members"]) == (2, 3)
    assert measured["median_of_members"] == 1.1


def test_few_data_decide_nothing(sources):
    sources[PHASES] = sources[PHASES].sel(mu=[0.0, 0.05])
    sources[TOP] = sources[TOP].sel(mu=[0.225])
    sources[SEA] = sources[SEA].isel(member=[0])
    found = rows(sources)
    for name in ("pendula_norms", "waiting_grows", "same_sea"):
        assert found[name]["verdict"] == "cannot be decided", name
