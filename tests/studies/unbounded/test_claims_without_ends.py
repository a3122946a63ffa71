"""What decides growth and the largest amplitude, on made-up runs that follow a law."""

import made_up_unbounded as made_up
import numpy as np
import pytest
from pendula.ledger.criterion import Verdict
from pendula.studies.unbounded.claims import following, growth_of, stays
from pendula.studies.unbounded.claims_state import unbounded_maximum


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


def test_the_maxima_of_the_thermal_state_confirm_that_the_norm_is_finite():
    run, thermal = made_up.spread(0.5, members=6), made_up.thermal()
    finding = unbounded_maximum(run, thermal)
    assert finding.verdict == Verdict.CAVEAT
    ahead = finding.measured["thermal_at_1e6"]
    assert ahead == pytest.approx((120.0 * np.log(2.9e6)) ** 0.25, rel=0.02)
    assert f"{ahead:.2f}" in finding.because
    assert finding.measured["norm_over_thermal"] == pytest.approx(1.0, abs=0.01)


def test_a_norm_above_the_thermal_one_is_refused_whatever_the_bulk_does():
    run, thermal = made_up.spread(0.5, members=6), made_up.thermal()
    for factor, verdict in ((1.01, Verdict.CAVEAT), (1.05, Verdict.NOT_REPRODUCED)):
        assert unbounded_maximum(run.assign(linf=factor * run["linf"]), thermal).verdict == verdict


def test_maxima_that_differ_much_between_the_members_decide_nothing():
    run, thermal = made_up.spread(0.5, members=6), made_up.thermal()
    apart = run["bulk_maximum"] * (1.0 + 0.05 * (-1.0) ** np.arange(6))[:, None, None]
    noisy = run.assign(bulk_maximum=(run["bulk_maximum"].dims, apart.values))
    assert unbounded_maximum(noisy, thermal).verdict == Verdict.UNDECIDED
