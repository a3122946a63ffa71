"""The score that documents quote: what it says of itself, and the lists that it rests on.

The score is made by `score.py` beside this file, in an hour or more and with a package of its own.
"""

import json
from pathlib import Path

import pytest
import yaml
from helpers import ROOT
from pendula.measures.confidence import share_limits

HERE = Path(__file__).parent


@pytest.fixture
def kept():
    return json.loads((ROOT / "tests/baseline/quoted/mutation.json").read_text(encoding="utf-8"))


@pytest.fixture
def decisive():
    return yaml.safe_load((HERE / "decisive.yaml").read_text(encoding="utf-8"))


def lines_of(module: str) -> set[str]:
    """Return the lines of a module as score.py writes them: single blanks and no comment."""
    text = (ROOT / "scripts/pendula" / module).read_text(encoding="utf-8")
    return {" ".join(line.split("  #")[0].split()) for line in text.splitlines()}


def test_the_score_follows_from_its_counts(kept):
    assert kept["sample"] == kept["killed"] + len(kept["survivors"])
    limits = share_limits(kept["killed"], kept["sample"], kept["confidence"])
    assert (kept["score"], kept["low"], kept["high"]) == tuple(limits)


def test_the_tests_notice_more_than_nineteen_of_twenty_mutants(kept):
    assert kept["score"] > 0.95 and not kept["plain"]


def test_decisive_modules_and_their_tests_exist(decisive):
    for module, tests in decisive.items():
        assert (ROOT / "scripts/pendula" / module).exists(), module
        assert tests and all((ROOT / test).exists() for test in tests), module


def test_each_equivalent_mutant_is_of_a_line_that_is_still_there_and_has_its_reason(decisive):
    """A line that was changed since must be judged again."""
    listed = yaml.safe_load((HERE / "equivalent.yaml").read_text(encoding="utf-8"))
    for module, mutants in listed.items():
        assert module in decisive
        for mutant in mutants:
            assert len(mutant["because"]) > 20
            if "anywhere" in mutant:
                assert any(mutant["anywhere"][0] in line for line in lines_of(module)), mutant
            else:
                assert mutant["before"] in lines_of(module), mutant
                assert mutant["after"] != mutant["before"]
