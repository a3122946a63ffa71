"""A number beyond the paper that the article prints was measured again with other choices.

The article is rendered with a token in place of each number, which says what stands there. Those of
long studies, and all in the section "Beyond the paper", have variations in their dataset, or stand
in one of the lists below with a reason.
"""

import json
import re

import pytest
from facts import Accepted
from pendula.article import write
from pendula.article.values import QUOTED, Numbers
from pendula.report.words import Quote
from pendula.varied import VARIATION, numbers_in, variations_of

SECTION = "## Beyond the paper"
RANGES = ("span", "range_of", "share_span")
OF_DATASETS, OF_CLAIMS = ("of", "percent_of", "share", *RANGES), ("n", "share_of")
CHOSEN = (
    "end_time large_end_time members large_members perturbation start start_amplitude ratio points "
    "size mu settled level window_start window_end "
    "noise_end_time"
)
WITHOUT = {
    **dict.fromkeys(CHOSEN.split(), "was chosen"),
    "sites": "is a count",
    "predicted_speed": "is the minimum of a formula",
    "thermal_power": "two grids agree to more digits than are printed",
    "thermal_antisymmetric_power": "two grids agree to more digits than are printed",
    "horizon": "is of one run of one solver, beside a verified trajectory",
    "exponent of checks/lyapunov": "has the limits of an ensemble of chaotic runs",
}
"""Variables of datasets, or of one dataset, with the reason why nothing is varied."""
OF_THE_LEDGER = {
    "breathers_exist": "is a proof",
    "steady_unstable": "is a count of solutions",
    "data_below_breathers": "is P of the paper's data",
    "solitons_unstable": "is P of solutions, exact to rounding errors",
    "unbounded_starts": "is a share of runs, with the confidence limits that decide",
    "expansion_order": "is the order of an expansion, whose range over cases is printed",
    "same_sea": "is decided by the ledger against a bound",
}
"""Claims whose numbers are printed, with the reason why nothing is varied."""


@pytest.fixture(scope="module")
def tokens() -> list[tuple[bool, str, str, str, dict]]:
    """Return of each number whether it is in SECTION, its function, source, name and labels."""

    def token(*parts) -> Quote:
        return Quote(f"⟦{json.dumps(parts)}⟧", "")

    def of_dataset(function):
        return lambda self, name, variable, *_, **labels: token(function, name, variable, labels)

    def of_claim(function):
        return lambda self, claim, key, *_: token(function, claim, key, {})

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(write, "_untrue", lambda *_: [])
        for function in OF_DATASETS:
            patch.setattr(Numbers, function, of_dataset(function))
        for function in OF_CLAIMS:
            patch.setattr(Numbers, function, of_claim(function))
        text = write.markdown(Accepted())
    start = text.index(SECTION)
    end = text.index("\n## ", start + 1)
    return [
        (start < found.start() < end, *json.loads(found[1]))
        for found in re.finditer("⟦(.*?)⟧", text)
    ]


def unvaried(accepted, tokens) -> list[str]:
    """Return the numbers that have neither variations nor a reason."""
    names = []
    for inside, function, source, name, labels in tokens:
        if function in OF_CLAIMS:
            known = not inside or source in OF_THE_LEDGER
        elif inside or source.startswith(QUOTED):
            known = name in WITHOUT or f"{name} of {source}" in WITHOUT
            known = known or is_varied(accepted[source], function, name, labels)
        else:
            known = True
        names += [] if known else [f"{name} of {source}, {labels}"]
    return names


def is_varied(data, function: str, name: str, labels: dict) -> bool:
    """Return whether a number has variations, or of a range every number."""
    name = name.removesuffix("_varied").removesuffix("_low")
    if name not in numbers_in(data):
        return False
    if function not in RANGES:
        here = data.sel(labels)
        return bool(here[name].isnull() or variations_of(here, name))  # NaN is printed as none
    again = data[f"{name}_varied"].notnull().any(VARIATION)
    return bool((again | data[name].isnull()).all())


def test_every_number_beyond_the_paper_was_varied_or_has_a_reason(tokens):
    assert len([one for one in tokens if one[0]]) > 60
    assert unvaried(Accepted(), tokens) == []


def test_a_number_without_variations_is_found(tokens):
    accepted = Accepted()
    name = f"{QUOTED}unbounded"
    accepted._read[name] = accepted[name].drop_vars("power_between_varied")
    told = unvaried(accepted, tokens)
    assert told and all(one.startswith("power_between of") for one in told)
    accepted._read[name] = Accepted()[name].copy(deep=True)
    varied = accepted[name]["distance_varied"]
    accepted[name]["distance_varied"] = varied.where(varied["omega"] != 2.0)
    assert {json.loads(one.split(", ", 1)[1].replace("'", '"'))["omega"]
            for one in unvaried(accepted, tokens)} == {2}  # fmt: skip
