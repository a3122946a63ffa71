"""A number beyond the paper that the article prints was measured again with other choices.

The article is rendered with a token in place of each number, which says what stands there. Those of
long studies, and all in the section "Beyond the paper", have variations in their dataset, or stand
in one of the lists below with a reason.
"""

import json
import re

import numpy as np
import pytest
from facts import Accepted
from pendula.article.write import ARTICLE
from pendula.varied import VARIATION, numbers_in, variations_of
from replication.article import render
from replication.article.numbers import Numbers
from replication.article.quoted import FOLDER
from replication.article.sources import Printed, Source

SECTION = "## Beyond the paper"
RANGES = ("span", "range_of", "share_span")
OF_DATASETS, OF_CLAIMS = ("of", "percent_of", "share", *RANGES), ("n", "share_of")
CHOSEN = (
    "end_time large_end_time members large_members perturbation start start_amplitude ratio points "
    "size mu settled level window_start window_end omega noise_end_time"
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
    "periodic_stable": "is the lowest frequency that was chosen",
    "same_sea": "is decided by the ledger against a bound",
}
"""Claims whose numbers are printed, with the reason why nothing is varied."""


@pytest.fixture(scope="module")
def tokens() -> list[tuple[bool, str, str, str, dict]]:
    """Return of each number whether it is in SECTION, its function, source, name and labels."""

    def token(*described) -> Printed:
        return Printed(f"⟦{json.dumps(described)}⟧", Source())

    def of_dataset(function):
        return lambda self, name, variable, *_, **labels: token(function, name, variable, labels)

    def of_claim(function):
        return lambda self, claim, key, *_: token(function, claim, key, {})

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(render, "_untrue", lambda *_: [])
        for function in OF_DATASETS:
            patch.setattr(Numbers, function, of_dataset(function))
        for function in OF_CLAIMS:
            patch.setattr(Numbers, function, of_claim(function))
        text = ARTICLE.markdown(Accepted())
    start = text.index(SECTION)
    end = text.index("\n## ", start + 1)
    return [
        (start < match.start() < end, *json.loads(match[1]))
        for match in re.finditer("⟦(.*?)⟧", text)
    ]


def unvaried(accepted, tokens) -> list[str]:
    """Return the numbers that have neither variations nor a reason."""
    names = []
    for inside, function, source, name, labels in tokens:
        if function in OF_CLAIMS:
            known = not inside or source in OF_THE_LEDGER
        elif inside or source.startswith(FOLDER):
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
        at_labels = data.sel(labels)
        return bool(
            at_labels[name].isnull() or variations_of(at_labels, name)
        )  # NaN is printed as none
    varied = data[f"{name}_varied"].notnull().any(VARIATION)
    return bool((varied | data[name].isnull()).all())


def test_every_number_beyond_the_paper_was_varied_or_has_a_reason(tokens):
    assert len([number for number in tokens if number[0]]) > 60
    assert unvaried(Accepted(), tokens) == []


def test_a_number_without_variations_is_found(tokens):
    accepted = Accepted()
    name = f"{FOLDER}/unbounded"
    accepted._read[name] = accepted[name].drop_vars("power_between_varied")
    unvaried_numbers = unvaried(accepted, tokens)
    assert unvaried_numbers and all(
        number.startswith("power_between of") for number in unvaried_numbers
    )
    accepted._read[name] = Accepted()[name].copy(deep=True)
    varied = accepted[name]["distance_varied"]
    accepted[name]["distance_varied"] = varied.where(varied["omega"] != 2.0)
    assert {
        json.loads(number.split(", ", 1)[1].replace("'", '"'))["omega"]
        for number in unvaried(accepted, tokens)
    } == {2}


@pytest.fixture(scope="module")
def printed() -> list[tuple[str, str, str, dict]]:
    """Return of each number of a long study its text, dataset, name and labels."""
    texts = []

    def recording(write_number):
        def write_and_record(self, name, variable, *digits, **labels):
            quote = write_number(self, name, variable, *digits, **labels)
            if variable.partition("_varied")[0].removesuffix("_low") in numbers_in(
                self.results[name]
            ):
                texts.append((quote.text, name, variable, labels))
            return quote

        return write_and_record

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(render, "_untrue", lambda *_: [])
        for function in OF_DATASETS:
            patch.setattr(Numbers, function, recording(getattr(Numbers, function)))
        ARTICLE.markdown(Accepted())
    return texts


def values_meant(data, variable: str, definition: str = "", **labels) -> np.ndarray:
    """Return a number's limits and variations, of a range those of every number, where finite.

    Variations of `definition` are another thing, and are left out.
    """
    data = data.sel(labels)
    name = variable.removesuffix("_varied").removesuffix("_low")
    if variable.endswith("_varied"):
        values_by_kind = [data[variable]]
    elif definition:
        varies = [not str(label).startswith(definition) for label in data[VARIATION].values]
        values_by_kind = [data[name], data[f"{name}_varied"].isel({VARIATION: varies})]
    elif f"{name}_low" in data:
        values_by_kind = [data[f"{name}{end}"] for end in ("_low", "_high", "_varied")]
    else:
        error = data[f"{name}_error"]
        values_by_kind = [data[name] - error, data[name] + error, data[f"{name}_varied"]]
    values = np.concatenate([np.ravel(values) for values in values_by_kind])
    return values[np.isfinite(values)]


def interval_of(text: str) -> tuple[float, float]:
    """Return the ends of the interval that a text gives; of a lone number, what rounds to it."""
    written = text.replace("\N{NO-BREAK SPACE}", " ").replace("−", "-").rstrip("†")
    powers = "".maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
    written = re.sub(r"10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)", lambda m: f"1e{m[1].translate(powers)}", written)
    scale = 0.01 if "%" in written else 1.0
    if "±" in written:
        common = re.search(r"\) × (1e-?\d+)$", written)
        value, error = re.findall(r"-?[\d.]+", written)[:2]
        scale *= float(common[1]) if common else 1.0
        return scale * (float(value) - float(error)), scale * (float(value) + float(error))
    numbers = re.findall(r"-?[\d.]+(?: × 1e-?\d+)?", written)
    ends = [float(number.replace(" × 1e", "e")) for number in numbers]
    half = 0.0
    if len(ends) == 1:
        half = 0.5 * 10.0 ** -len(numbers[0].partition(".")[2])
    return scale * (min(ends) - half), scale * (max(ends) + half)


def excluded(accepted, printed) -> list[str]:
    """Return the printed numbers whose interval leaves a limit or a variation out."""
    names = []
    for text, source, variable, labels in printed:
        values = values_meant(accepted[source], variable, **labels)
        if not values.size:  # printed as none
            continue
        low, high = interval_of(text)
        if variable.endswith("_low"):  # "at least"
            high = np.inf
        off = 1e-6 * np.abs(values)  # sums of decimal fractions
        if (values < low - off).any() or (values > high + off).any():
            names.append(f"{text}: {variable} of {source}, {labels}")
    return names


def test_every_variation_lies_in_the_interval_that_is_printed(printed):
    assert len(printed) > 60
    assert excluded(Accepted(), printed) == []


@pytest.mark.parametrize("text", ["7.0 to 7.4", "0.5 ± 0.1", "8 % (7 % to 9 %)"])
def test_an_interval_that_leaves_a_variation_out_is_told(text):
    source = f"{FOLDER}/chaos"
    assert excluded(Accepted(), [(text, source, "transition", {"definition": "level"})])
