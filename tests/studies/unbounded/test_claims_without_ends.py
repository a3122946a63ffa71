"""What decides growth, the front and the maximum refuses the wrong cases that it is fed."""

import made_up_unbounded as made_up
import numpy as np
import pytest
from pendula.ledger.claim import all_claims, feed, passes
from pendula.ledger.criterion import Verdict
from pendula.studies.unbounded.claims import following, growth_of, stays
from pendula.studies.unbounded.claims_state import (
    at_last_at_a_limit,
    of_the_other_norm,
    towards_a_limit,
    unbounded_maximum,
)

CLAIMS = {claim.name: claim for claim in all_claims() if claim.name.startswith("unbounded")}
CHANGED = [  # wrong cases that are made of the right one, which a made-up run can stand for
    (claim, control)
    for claim in CLAIMS.values()
    for control in claim.controls
    if all(callable(wrong) for wrong in control.fed.values()) and not control.undecided
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


def test_a_maximum_without_a_bound_is_refused_and_one_with_a_bound_is_not():
    run = made_up.spread(0.5, members=6)
    assert unbounded_maximum(of_the_other_norm(run)).verdict == Verdict.NOT_REPRODUCED
    rising = unbounded_maximum(run)
    known = (600.0 + 100.0 * np.log(1e6)) ** 0.25
    assert rising.measured["fourth_root_of_log_tau_at_1e6"] == pytest.approx(known, rel=0.01)
    assert unbounded_maximum(towards_a_limit(run)).verdict == Verdict.CONFIRMED


@pytest.mark.parametrize("gain", [0.0, 0.15])
def test_slow_bounded_laws_and_growing_ones_are_not_told_apart_in_noise(gain):
    """A logarithm is as near to a limit less c tau^(-1/10) as noise of one half can tell."""
    run = made_up.spread(0.5, members=6)
    noise = np.random.default_rng(7).normal(0.0, 0.5, run["linf"].shape)
    rise = 5.0 + gain * np.log(run["tau"].clip(min=1.0)).values
    noisy = run.assign(linf=(run["linf"].dims, rise + noise))
    finding = unbounded_maximum(noisy)
    assert finding.verdict == (Verdict.UNDECIDED if gain else Verdict.CONFIRMED)
    assert ("tenth root tau" in finding.because) == bool(gain)
    assert unbounded_maximum(at_last_at_a_limit(noisy)).verdict == Verdict.UNDECIDED
