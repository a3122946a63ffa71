"""Which cases and sweeps the claims on chaotic figures read."""

import pytest
from accepted import datasets
from pendula.ledger.verdicts import all_claims, decide, feed

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
