"""What decides the claims on theory, in exact cases."""

import numpy as np
import pytest
import xarray as xr
from accepted import changed, dataset, datasets
from pendula.ledger.claim import all_claims, decide
from pendula.ledger.criterion import Verdict

CLAIM = {claim.name: claim for claim in all_claims()}


@pytest.mark.parametrize(
    ("second", "error", "verdict"),
    [
        (0.2, 0.01, Verdict.CAVEAT),
        (0.0, 0.01, Verdict.NOT_REPRODUCED),
        (0.0, 0.5, Verdict.UNDECIDED),  # limits wider than what lies between two exponents
        (0.2, 0.5, Verdict.UNDECIDED),
    ],
)
def test_a_second_integral_is_seen_where_exponents_are_resolved(second, error, verdict):
    sizes = np.array([0.0, second, 0.5, 0.7, 0.9, 1.2, 1.5])
    values = np.concatenate([sizes, -sizes])
    along = ("spectrum_case", "spectrum_half_width", "index")
    spectra = xr.Dataset(
        {
            "exponents": (along, values.reshape(1, 1, -1)),
            "exponents_error": (along, np.full((1, 1, values.size), error)),
        },
        {"spectrum_case": ["fig4_small"], "spectrum_half_width": [3]},
    )
    assert CLAIM["one_integral"].decide(spectra).verdict == verdict


def test_the_region_of_theorem_2_is_that_of_the_data():
    claim, sweep, run = CLAIM["fig5_theorem_2"], "sweeps/fig5_left", "trajectories/fig3_small"
    finding = decide(claim, datasets(claim.needs))
    assert finding.verdict == Verdict.CAVEAT and "bonds" in finding.because
    tiny = dataset(run).assign({name: scale * dataset(run)[name]
                                for name, scale in (("l2", 0.3), ("energy", 0.09))})  # fmt: skip
    inside = changed({"in": sweep, "scale": "l2", "by": 0.3}) | {run: tiny}
    assert decide(claim, datasets(claim.needs) | inside).verdict == Verdict.CONFIRMED
