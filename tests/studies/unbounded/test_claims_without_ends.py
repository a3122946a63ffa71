"""What decides growth, the front and the maximum refuses the wrong cases that it is fed."""

import made_up_unbounded as made_up
import numpy as np
import pytest
from pendula.ledger.claim import all_claims, feed, passes
from pendula.ledger.criterion import Verdict
from pendula.studies.unbounded.claims import following, growth_of, stays
from pendula.studies.unbounded.claims_state import towards_a_limit, unbounded_maximum

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


def test_a_maximum_without_a_bound_is_refused_and_one_with_a_bound_is_not():
    run = made_up.spread(0.5, members=6)
    rising = unbounded_maximum(run)
    assert rising.verdict == Verdict.NOT_REPRODUCED
    known = (600.0 + 100.0 * np.log(1e6)) ** 0.25
    assert rising.measured["fourth_root_of_log_tau_at_1e6"] == pytest.approx(known, rel=0.01)
    assert unbounded_maximum(towards_a_limit(run)).verdict == Verdict.CONFIRMED
