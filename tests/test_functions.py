"""The library uses only operators whose bits are the same on every processor.

Processors round + - * / and square roots alike, and `numerics` makes all other functions of these.
Ruff refuses functions of NumPy, SciPy and C (`banned-api` in pyproject.toml); this test refuses
powers, matrix products and the modulus of complex numbers, which no import tells. It cannot see
types. So it takes `x**2` for the square of an array, which is a product, and it knows a complex
number by its name. Whole runs on played machines find what both miss (`.ci/elsewhere`).
"""

import ast
from collections.abc import Iterator

import pendula  # noqa: F401, which names its folder there
import pytest
from latticode.kernels.sources import ROOTS

LIBRARIES = [ROOTS[name] / name for name in ("latticode", "pendula")]

MAY_DIFFER = ("report", "drawing", "figure_diff", "archive")
"""Rooms that write texts and pictures for people, of rounded numbers."""

ALLOWED = {
    ("studies/certified/fixed_point.py", "**"): "powers of integers, which are exact",
    ("studies/breathers/multipliers.py", "@"): "rates are rounded before they are stored",
    ("localised/breathers.py", "@"): "what is found is rounded before it is stored",
    ("configuration/cost.py", "**"): "what a run will take is an estimate that is told to people",
    ("numerics/elementary.py", "**"): "powers of Decimal, by its own arithmetic",
    ("numerics/quadrature.py", "**"): "powers of Fraction, which are exact",
}
"""What a module may use, with the reason."""

COMPLEX = {"amplitudes", "initial", "z"}
"""What complex numbers are called: their modulus is `hypot` of C, and `numerics` has its own."""
PARTS = ("real", "imag", "shape", "size")
EXACT_BASES = (-1, 0.5, 2)
"""Numbers whose whole powers are exact."""


def whole_power(base: ast.AST, exponent: ast.AST) -> bool:
    """Return whether a power is a product, or one of a base whose whole powers are exact."""
    if isinstance(exponent, ast.Constant) and exponent.value == 2:
        return True
    try:
        return ast.literal_eval(base) in EXACT_BASES and not isinstance(exponent, ast.BinOp)
    except ValueError:
        return False


def complex_inside(node: ast.AST) -> bool:
    """Return whether an expression holds a complex number, but not only its parts or a function."""
    if isinstance(node, ast.Call) or (isinstance(node, ast.Attribute) and node.attr in PARTS):
        return False
    named = getattr(node, "id", "") or getattr(node, "attr", "")
    return named in COMPLEX or any(map(complex_inside, ast.iter_child_nodes(node)))


def uses(source: str) -> Iterator[str]:
    """Yield the operators of a module whose bits differ between processors."""
    for node in ast.walk(ast.parse(source)):
        match node:
            case ast.BinOp(op=ast.MatMult()) | ast.AugAssign(op=ast.MatMult()):
                yield "@"
            case ast.BinOp(base, ast.Pow(), exponent) | ast.AugAssign(
                base, ast.Pow(), exponent
            ) if not whole_power(base, exponent):
                yield "**"
            case ast.Call(ast.Name("pow")):
                yield "**"
            case ast.Call(ast.Attribute(attr="dot")):
                yield "@"
            case ast.Call(ast.Name("abs") | ast.Attribute(attr="abs" | "absolute"), arguments) if (
                any(map(complex_inside, arguments))
            ):
                yield "abs of complex"


def test_operators_have_the_same_bits_everywhere():
    """Each use stands in ALLOWED, and what is allowed is still used."""
    found = {
        (path.relative_to(library).as_posix(), use)
        for library in LIBRARIES
        for path in library.rglob("*.py")
        if path.relative_to(library).parts[0].removesuffix(".py") not in MAY_DIFFER
        for use in uses(path.read_text())
    }
    assert found - ALLOWED.keys() == set(), "use latticode.numerics in place of these"
    assert ALLOWED.keys() - found == set(), "nothing uses these any longer"


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
