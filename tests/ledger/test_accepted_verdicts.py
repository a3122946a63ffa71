"""The verdicts on sentences that were read with most care, decided again by the accepted data."""

from pathlib import Path

import pytest
from pendula.datasets.netcdf import read
from pendula.ledger.claim import all_claims, decide, feed, passes

BASELINE = Path(__file__).parents[1] / "baseline"
CLAIM = {claim.name: claim for claim in all_claims()}
CONFIRMED, CAVEAT, MISSED, OPEN = (
    "confirmed",
    "confirmed with a caveat",
    "not reproduced",
    "cannot be decided",
)
VERDICTS = {
    "slow_time": (CONFIRMED, ""),
    "uniqueness": (CONFIRMED, ""),
    "no_gauge": (CONFIRMED, ""),
    "remainder_bounded": (CAVEAT, "at a fixed slow time"),
    "expansion_order": (CONFIRMED, ""),
    "sharp_theorem_2_ball": (MISSED, "gives 5 as delta goes to 0, of which tiny data reach 0.6"),
    "energy_small": (MISSED, "with a factor of 10"),
    "energy_large": (OPEN, "the paper does not say which it means"),
    "fig5_caption": (CAVEAT, "contradict each other"),
    "second_solver_sweeps": (OPEN, "the paper gives no step"),
    "ensemble_fig4_alike": (CAVEAT, "single runs scatter"),
    "unbounded_slope": (CAVEAT, "not in the whole band"),
    "lemma_1_for_the_pendula": ("does not carry over", "below gamma_0"),
}


@pytest.fixture(scope="module")
def sources():
    kept = {}

    def of(claim):
        names = {*claim.needs, *(name for control in claim.controls for name in control.names)}
        for name in names - set(kept):
            kept[name] = read(BASELINE / f"{name}.nc")
        return kept

    return of


@pytest.mark.parametrize("name", VERDICTS)
def test_the_verdict_follows_from_the_accepted_data_and_wrong_data_turn_it(name, sources):
    claim, (verdict, because) = CLAIM[name], VERDICTS[name]
    found = decide(claim, sources(claim))
    assert (found.verdict, because in found.because) == (verdict, True), found
    fed = [(control, feed(claim, control, sources(claim))) for control in claim.controls]
    assert fed and all(passes(control, finding) for control, finding in fed)
