"""What decides the claims on chaotic figures: which cases it reads, and exact cases of it."""

import numpy as np
import pytest
import xarray as xr
from accepted import changed, datasets
from pendula.ledger.claim import all_claims, decide, feed
from pendula.ledger.criterion import Verdict

CLAIM = {claim.name: claim for claim in all_claims()}
EVEN, UNEVEN = "checks/ensembles", "checks/ensembles_uneven"
OF_SOME = [claim for claim in all_claims("chaos/claims") if claim.on]


def without_others(data, on):
    """Return a dataset of many cases and sweeps in which those that are not named are unknown."""
    for name in {"case", "sweep"} & set(data.dims):
        kept = data[name].isin(list(on))
        numbers = (one for one in data.values() if name in one.dims and one.dtype.kind == "f")
        data = data.assign({one.name: one.where(kept) for one in numbers})
    return data


def said(finding) -> tuple:
    return finding.verdict, str(finding.measured), finding.because


@pytest.mark.parametrize("claim", OF_SOME, ids=lambda claim: claim.name)
def test_a_claim_and_its_controls_read_no_case_but_those_that_they_are_on(claim):
    sources = datasets(claim.needs) | datasets(n for one in claim.controls for n in one.names)

    def known(*on):
        return sources | {need: without_others(sources[need], on) for need in claim.needs}

    assert said(decide(claim, known(*claim.on))) == said(decide(claim, sources))
    for control in claim.controls:
        alone = feed(claim, control, known(*claim.on, *control.on))
        assert said(alone) == said(feed(claim, control, sources)), control.says


def test_growth_is_told_from_none_and_not_from_a_factor():
    claim = CLAIM["ensemble_fig6_grows"]
    slight = {
        name: data.assign(
            l2_mean=0.0 * data["l2_mean"] + 20.0 + 4.0 * (data["half_width"] > 5),
            l2_error=0.0 * data["l2_error"] + 0.3,
        )
        for name, data in datasets([EVEN, UNEVEN]).items()
    }
    finding = decide(claim, datasets(claim.needs) | slight)
    assert finding.verdict == Verdict.CAVEAT
    assert finding.measured["even_ratio"] == pytest.approx(1.2)
    assert finding.measured["even_low"] > 1.1


def test_a_level_of_long_chains_does_not_hang_on_one_half_width():
    claim = CLAIM["ensemble_fig5_maximum"]
    right = datasets(claim.needs)
    one_off = {"in": UNEVEN, "scale": "linf_mean", "by": 1.15, "at": {"half_width": [60]}}
    before, after = decide(claim, right), decide(claim, right | changed(one_off))
    assert after.verdict == before.verdict == Verdict.CONFIRMED
    assert 0.0 < after.measured["uneven_range"] - before.measured["uneven_range"] < 0.1


def exponents(odd, error):
    """Return exponents of three chaotic cases, the even ones all 2, with these of odd changes."""
    pairs = np.stack([np.full(3, 2.0), odd], axis=1)
    grid = ("case", "parity")
    errors = np.broadcast_to(error, pairs.shape)
    tau = np.linspace(0.0, 200.0, 801)
    return xr.Dataset(
        {
            "exponent": (grid, pairs),
            "exponent_error": (grid, errors),
            "log_growth": ((*grid, "tau"), pairs[..., None] * tau),
            "l2": (("case", "tau"), np.ones((3, tau.size))),
        },
        {"case": ["fig3_large", "fig4_small", "fig4_large"], "parity": ["even", "odd"], "tau": tau},
    )


@pytest.mark.parametrize(
    ("odd", "error", "verdict"),
    [
        ([2.1, 1.95, 2.0], 0.05, Verdict.CONFIRMED),
        ([2.0, 2.2, 2.0], [[0.05], [0.04], [0.05]], Verdict.CONFIRMED),  # one is off by 3.5 errors
        ([2.1, 1.95, 2.0], 0.5, Verdict.UNDECIDED),
        ([3.0, 1.0, 3.0], 0.05, Verdict.NOT_REPRODUCED),
    ],
)
def test_odd_perturbations_are_held_to_the_even_ones_by_means_over_cases(odd, error, verdict):
    assert CLAIM["odd_as_even"].decide(exponents(np.array(odd), np.array(error))).verdict == verdict
