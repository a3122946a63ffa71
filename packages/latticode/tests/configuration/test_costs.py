"""What a run takes, in words, and what is told of too much."""

import pytest
from latticode.configuration.cost import Cost, refusal

MORE = "more than a million"
LIMITS = {"hours": 1.0, "gigabytes": 8.0}


@pytest.mark.parametrize(
    ("cost", "words"),
    [
        (Cost(0.3, 1e3), "less than a second and 1 MB of memory"),
        (Cost(90, 2.1e9), "about 2 minutes and 2.1 GB of memory"),
        (Cost(5e4, 1.5e13), "about 14 hours and 15 TB of memory"),
        (Cost(4e5, 0), "about 5 days and 1 MB of memory"),
        (Cost(1e30, float("inf")), f"{MORE} years and {MORE} terabytes of memory"),
        (Cost(float("inf"), 1e30), f"{MORE} years and {MORE} terabytes of memory"),
    ],
)
def test_costs_are_said_in_words(cost, words):
    assert str(cost) == words


def test_a_little_too_much_memory_is_not_printed_as_what_is_allowed():
    said = refusal(Cost(1.0, 8.01e9), LIMITS)
    assert "a little over 8 GB of memory, and limits.gigabytes allows 8 GB;" in said
    assert "about 1 second and 9 GB of memory" in refusal(Cost(1.0, 9e9), LIMITS)
