"""Operators whose bits differ between processors, as the text of a module has them."""

import ast
from collections.abc import Iterator
from pathlib import Path

COMPLEX = {"amplitudes", "initial", "z"}
"""What complex numbers are called: their modulus is `hypot` of C, and `numerics` has its own."""
ATTRIBUTES = ("real", "imag", "shape", "size")
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
    if isinstance(node, ast.Call) or (isinstance(node, ast.Attribute) and node.attr in ATTRIBUTES):
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


def used_in(package: Path, left_out: tuple[str, ...]) -> set[tuple[str, str]]:
    """Return the modules of a package with such operators, but for some of its rooms."""
    return {
        (path.relative_to(package).as_posix(), use)
        for path in package.rglob("*.py")
        if path.relative_to(package).parts[0].removesuffix(".py") not in left_out
        for use in uses(path.read_text())
    }
