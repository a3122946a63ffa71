"""The library uses only operators whose bits are the same on every processor.

Processors round + - * / and square roots alike, and `numerics` makes all other functions of these.
Ruff refuses functions of NumPy, SciPy and C (`banned-api` in pyproject.toml); this test refuses
powers, matrix products and the modulus of complex numbers, which no import tells. It cannot see
types. So it takes `x**2` for the square of an array, which is a product, and it knows a complex
number by its name. Whole runs on played machines find what both miss (`.ci/elsewhere`).
"""

import pytest
from latticode.kernels.sources import ROOTS
from operators import used_in, uses

MAY_DIFFER = ("drawing",)
"""It makes texts and pictures for people, of rounded numbers."""
ALLOWED = {
    ("localised/breathers.py", "@"): "what is found is rounded before it is stored",
    ("equations/rate_bounds.py", "**"): "a bound of the rates, from which the cost is estimated",
    ("equations/rate_bounds.py", "@"): "the same",
    ("equations/graph.py", "@"): "values that NumPy computes for the same bound; runs sum in order",
    ("equations/symbols.py", "**"): "a number to the power of a parameter, which the graph writes",
    ("integrators/method.py", "**"): "how long a run will take, an estimate for people",
    ("integrators/methods/crank_nicolson.py", "**"): "the same",
    ("numerics/elementary.py", "**"): "powers of Decimal, by its own arithmetic",
}
"""What a module may use, with the reason."""


def test_operators_have_the_same_bits_everywhere():
    """Each use stands in ALLOWED, and what is allowed is still used."""
    operators = used_in(ROOTS["latticode"] / "latticode", MAY_DIFFER)
    assert operators == ALLOWED.keys(), "use latticode.numerics in place of these"


@pytest.mark.parametrize(
    ("use", "lines"),
    [
        (["**"], ("x ** 0.2", "x ** n", "x **= 0.5", "2.0 ** (x / 3)", "10.0 ** n", "pow(x, 3)")),
        (["@"], ("x @ y", "x @= y", "x.dot(y)")),
        (["abs of complex"], ("abs(z[0] - 1)", "np.abs(a.initial).max()")),
        ([], ("abs(z.real)", "abs(f(z))", "x ** 2", "2.0 ** -53", "0.5 ** n")),
    ],
)
def test_an_operator_is_seen(use, lines):
    assert [list(uses(line)) for line in lines] == [use] * len(lines)
