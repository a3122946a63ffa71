"""Claims on the expansion, each fed a right and a wrong case."""

import numpy as np
import pytest
import xarray as xr
from helpers import verdict_of
from pendula.ledger.claim import evaluate
from pendula.studies.pendula.claims_remainder import LYAPUNOV, REMAINDER

MODULES = ("pendula/claims_remainder",)
CASES = ("fig2_small", "fig2_large", "fig3_small", "fig3_large", "fig4_small", "fig4_large")
MUS, ENDS = 0.4 * 0.5 ** np.arange(6), np.arange(1.0, 21.0)
RATE = 1.7


def made(grows=1.0):
    """Return errors that grow like tau^`grows`, and horizons like those of exponential growth."""
    over = ("expansion", "case", "mu", "end")
    powers = np.array([MUS**3, MUS**5])[:, None, :, None] * ENDS**grows
    whole = np.array([3.0, 5.0])[:, None, None] + np.zeros((2, 6, 20))
    horizons = np.array([[2.0], [4.0]]) / RATE * np.log(2.0) * np.arange(6)
    wrong = np.array([1.0, 3.0, 3.0])[:, None] + np.zeros((3, 6))
    reduced = ("expansion", "case", "end")
    names = [
        "the slow time mu^2 t",
        "a third harmonic of the opposite sign",
        "a third harmonic alone",
    ]
    return xr.Dataset(
        {
            "error": (over, np.broadcast_to(powers, (2, 6, 6, 20)).copy()),
            "order": (reduced, whole),
            "order_uncertainty": (reduced, 0.0 * whole),
            "error_constant": (reduced, 0.0 * whole + 1.0),
            "pendula_end": (("case", "mu"), np.tile([20.0, 20.0, 20.0, 10.0, 4.0, 1.0], (6, 1))),
            "visible_from": (over[:3], np.broadcast_to(1.0 + horizons[:, None], (2, 6, 6)).copy()),
            "wrong_order": (("wrong_expansion", "case"), wrong),
            "wrong_error": (
                ("wrong_expansion", "case", "mu"),
                MUS ** wrong[..., None] * np.ones(6),
            ),
        },
        {
            "expansion": ["leading", "corrected"],
            "case": list(CASES),
            "mu": MUS,
            "end": ENDS,
            "wrong_expansion": names,
        },
    )


@pytest.fixture
def lyapunov():
    exponents = np.full((6, 2), RATE)
    return xr.Dataset({"exponent": (("case", "parity"), exponents)}, {"case": list(CASES)})


def verdicts(remainder, lyapunov):
    rows = evaluate({REMAINDER: remainder, LYAPUNOV: lyapunov}, None, MODULES)
    return {row["name"]: row["verdict"] for row in rows}


def test_all_are_decided_and_every_control_passes(lyapunov):
    rows = evaluate({REMAINDER: made(), LYAPUNOV: lyapunov}, None, MODULES)
    assert {row["name"]: row["verdict"] for row in rows} == {
        "expansion_order": "confirmed",
        "next_order_of_the_expansion": "confirmed",
        "remainder_bounded": "confirmed with a caveat",
        "remainder_secular": "confirmed",
        "horizon_logarithmic": "confirmed with a caveat",
    }
    assert all(control["passes"] for row in rows for control in row["controls"])
    assert all(row["controls"] for row in rows)


@pytest.mark.parametrize(
    ("name", "change"),
    [
        ("next_order_of_the_expansion", lambda one: one.assign(order=one["order"] + 0.05)),
        ("remainder_secular", lambda one: made(grows=1.7)),
        ("horizon_logarithmic", lambda one: one.assign(visible_from=3.0 * one["visible_from"])),
        (
            "horizon_logarithmic",
            lambda one: one.assign(visible_from=0.0 * one["visible_from"] + 2.0),
        ),
    ],
)
def test_a_claim_falls_where_its_measure_does(lyapunov, name, change):
    sources = {REMAINDER: change(made()), LYAPUNOV: lyapunov}
    assert verdict_of(name, sources, *MODULES) == "does not carry over"


def test_an_error_of_a_lower_order_leaves_no_bounded_remainder_and_no_justification(lyapunov):
    lower = made()
    lower = lower.assign(error=lower["error"] / lower["mu"], order=lower["order"] - 0.05)
    found = verdicts(lower, lyapunov)
    assert found["remainder_bounded"] == found["expansion_order"] == "not reproduced"


def test_too_few_mu_decide_nothing(lyapunov):
    brief = made()
    brief["order"] = brief["order"] * np.nan
    brief["error"] = brief["error"].where(brief["mu"] > 0.3)
    brief["pendula_end"] = 0.0 * brief["pendula_end"] + 1.0
    brief["visible_from"] = brief["visible_from"].where(brief["mu"] > 0.15, np.inf)
    assert set(verdicts(brief, lyapunov).values()) == {"cannot be decided"}
