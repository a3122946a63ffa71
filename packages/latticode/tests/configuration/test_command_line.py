"""Values of a command line are read as strictly as a file."""

import pytest
from latticode.configuration.files import ConfigurationError, read_entries


def test_entries_have_the_values_that_a_file_has():
    words = ["cases={mine: {omega: 3, initial: {0: [1, '0.1j']}}}", "limits={hours: 0.5}", "a=x"]
    assert read_entries(words) == {
        "cases": {"mine": {"omega": 3, "initial": {0: [1, "0.1j"]}}},
        "limits": {"hours": 0.5},
        "a": "x",
    }


@pytest.mark.parametrize(
    ("entries", "message"),
    [
        (["hours=010"], "hours: 010 is read as a number in base 8"),
        (["cases={mine: {omega: 010}}"], "cases.mine.omega: 010 is read as a number in base 8"),
        (["cases={mine: {omega: 1, omega: 2}}"], "cases.mine.omega: the key is given twice"),
        (['cases={"mine": 1, "mine": 2}'], "cases: the key 'mine' is given twice"),
        (["cases={a: 1}", "cases={b: 1}"], "cases: is given twice"),
        (["cases={a: [1}"], "cases: "),
    ],
)
def test_what_would_be_read_in_silence_is_told_with_its_path(entries, message):
    with pytest.raises(ConfigurationError) as error:
        read_entries(entries)
    assert str(error.value).startswith("--config has 1 error:\n  " + message)
