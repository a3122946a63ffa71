"""What decides growth, the front and the maximum refuses the wrong cases that it is fed."""

import made_up_unbounded as made_up
import numpy as np
import pytest
from pendula.ledger.claim import all_claims, feed, passes
from pendula.ledger.criterion import UndecidableError, Verdict
from pendula.studies.unbounded.claims import following, growth_of, stays
from pendula.studies.unbounded.claims_state import unbounded_maximum

CLAIMS = {claim.name: claim for claim in all_claims() if claim.name.startswith("unbounded")}
CHANGED = [  # wrong cases that are made of the right one, which a made-up run can stand for
    (claim, control)
    for claim in CLAIMS.values()
    for control in claim.controls
    if all(callable(wrong) for wrong in control.fed.values())
    and claim.name in ("unbounded_in_time", "unbounded_band", "unbounded_large", "unbounded_small",
                       "unbounded_stable", "unbounded_window", "unbounded_maximum")
]  # fmt: skip


@pytest.fixture(scope="module")
def sources():
    return made_up.unbounded_runs()


def test_every_row_without_ends_has_wrong_cases():
    assert all(claim.controls for claim in CLAIMS.values())
    assert len(CHANGED) > 12


@pytest.mark.parametrize(
    ("claim", "control"),
    CHANGED,
    ids=[f"{claim.name}-{control.says}" for claim, control in CHANGED],
)
def test_a_wrong_case_is_refused(claim, control, sources):
    assert passes(control, feed(claim, control, sources))


@pytest.mark.parametrize("power", [0.1, 0.5, 0.8])
def test_a_law_is_followed_with_the_scatter_of_the_members(power):
    run = following(lambda tau: 3.0 * tau**power)(made_up.spread(0.5, members=6))
    measured = growth_of(run)
    assert abs(measured["exponent"] - power) < max(measured["error"], 0.02)


def test_what_creeps_by_less_than_two_per_cent_stays_and_more_does_not():
    for gain, verdict in ((0.005, Verdict.CONFIRMED), (0.08, Verdict.NOT_REPRODUCED)):
        run = made_up.spread(0.0)
        creeping = run.assign(l2=run["l2"] * (1.0 + gain * run["tau"] / float(run["tau"][-1])))
        assert stays(creeping).verdict == verdict


def test_the_maxima_of_the_thermal_state_confirm_that_the_norm_is_finite(sources):
    run, thermal = sources["unbounded/fig4_small"], sources["unbounded/thermal"]
    finding = unbounded_maximum(run, thermal)
    assert finding.verdict == Verdict.CAVEAT
    ahead = finding.measured["thermal_at_1e6"]
    assert ahead == pytest.approx((120.0 * np.log(2.9e6)) ** 0.25, rel=0.02)
    assert f"{ahead:.2f}" in finding.because
    assert finding.measured["norm_over_thermal"] == pytest.approx(1.0, abs=0.01)


def test_a_norm_above_the_thermal_one_is_refused_whatever_the_bulk_does(sources):
    run, thermal = sources["unbounded/fig4_small"], sources["unbounded/thermal"]
    for factor, verdict in ((1.01, Verdict.CAVEAT), (1.05, Verdict.NOT_REPRODUCED)):
        assert unbounded_maximum(run.assign(linf=factor * run["linf"]), thermal).verdict == verdict


def test_maxima_that_differ_much_between_the_members_decide_nothing(sources):
    run, thermal = sources["unbounded/fig4_small"], sources["unbounded/thermal"]
    apart = run["bulk_maximum"] * (1.0 + 0.05 * (-1.0) ** np.arange(6))[:, None, None]
    noisy = run.assign(bulk_maximum=(run["bulk_maximum"].dims, apart.values))
    assert unbounded_maximum(noisy, thermal).verdict == Verdict.UNDECIDED


@pytest.mark.parametrize(
    ("change", "why"),
    [
        (lambda run: run.isel(member=[0]), "it takes two whole runs"),
        (lambda run: run.assign(linf=run["linf"].where(run["tau"] < 150.0)), "two whole runs"),
        (lambda run: run.assign(bulk_maximum=run["bulk_maximum"] * np.nan), "as the largest block"),
        (lambda run: run.assign(omega=run["omega"] + 1.0), "no law of the largest amplitude"),
    ],
)
def test_runs_that_cannot_be_compared_with_the_thermal_state_are_left_undecided(
    change, why, sources
):
    with pytest.raises(UndecidableError, match=why):
        unbounded_maximum(change(sources["unbounded/fig4_small"]), sources["unbounded/thermal"])
