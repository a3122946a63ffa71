"""The replication uses only operators whose bits are the same on every processor.

The tests of the library say which these are: packages/latticode/tests/test_operators.py.
"""

from operators import used_in
from pendula.sources import SCRIPTS

MAY_DIFFER = ("report", "drawing", "figure_diff", "archive")
"""Rooms that write texts and pictures for people, of rounded numbers."""
ALLOWED = {
    ("studies/certified/fixed_point.py", "**"): "powers of integers, which are exact",
    ("studies/breathers/multipliers.py", "@"): "rates are rounded before they are stored",
}
"""What a module may use, with the reason."""


def test_operators_have_the_same_bits_everywhere():
    """Each use stands in ALLOWED, and what is allowed is still used."""
    assert used_in(SCRIPTS / "pendula", MAY_DIFFER) == ALLOWED.keys()
