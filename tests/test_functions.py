"""The library calls only functions whose bits are the same on every processor.

Processors round + - * / and square roots alike, and `numerics` makes all other functions of these.
This test reads the source and refuses powers, BLAS, and functions of NumPy, SciPy and C, whatever
name they were imported by. It cannot see types. So it takes `x**2` for the square of an array,
which is a product, and it knows a complex number by its name. Whole runs on played machines find
what it misses (`.ci/elsewhere`).
"""

import ast
from collections.abc import Iterator

import numpy as np
from pendula.sources import SCRIPTS

LIBRARY = SCRIPTS / "pendula"

MAY_DIFFER = ("report", "drawing", "figure_diff", "archive")
"""Rooms that write texts and pictures for people, of rounded numbers."""

ALLOWED = {
    ("studies/certified/fixed_point.py", "**"): "powers of integers, which are exact",
    ("studies/theory/threshold.py", "numpy.fft"): "the norms are rounded before they are stored",
    ("measures/confidence.py", "scipy.special"): "quantiles and chances are rounded to six digits",
    ("studies/unbounded/thermal.py", "scipy.special"): "the density is rounded to its digits",
    ("studies/unbounded/thermal.py", "@"): "the density is rounded to its digits",
    (
        "studies/breathers/steady.py",
        "numpy.linalg",
    ): "states and rates are rounded before they are stored",
    ("studies/breathers/steady.py", "@"): "rates are rounded before they are stored",
    (
        "studies/breathers/branches.py",
        "numpy.linalg",
    ): "what is found is rounded before it is stored",
    (
        "studies/breathers/branches.py",
        "scipy.optimize",
    ): "what is found is rounded before it is stored",
    (
        "studies/breathers/periodic.py",
        "numpy.linalg",
    ): "states and rates are rounded before they are stored",
    (
        "studies/breathers/multipliers.py",
        "numpy.linalg",
    ): "traces and rates are rounded before they are stored",
    (
        "studies/breathers/multipliers.py",
        "scipy.optimize",
    ): "what is found is rounded before it is stored",
    ("studies/breathers/multipliers.py", "@"): "rates are rounded before they are stored",
    (
        "studies/breathers/driven_growth.py",
        "numpy.linalg",
    ): "the rate is rounded before it is stored",
    ("configuration/cost.py", "**"): "what a run will take is an estimate that is told to people",
    ("numerics/elementary.py", "**"): "powers of Decimal, by its own arithmetic",
    ("numerics/quadrature.py", "**"): "powers of Fraction, which are exact",
}
"""What a module may use, with the reason."""

EXACT = {
    *("add", "subtract", "multiply", "divide", "true_divide", "negative", "positive", "sqrt"),
    *("square", "reciprocal", "absolute", "abs", "fabs", "sign", "copysign", "conj", "conjugate"),
    *("floor", "ceil", "trunc", "rint", "floor_divide", "fmod", "mod", "remainder", "divmod"),
    *("modf", "frexp", "ldexp", "nextafter", "spacing", "signbit", "heaviside", "deg2rad"),
    *("rad2deg", "degrees", "radians", "maximum", "minimum", "fmax", "fmin", "clip"),
    *("isfinite", "isinf", "isnan", "isnat", "equal", "not_equal", "less", "less_equal"),
    *("greater", "greater_equal", "logical_and", "logical_or", "logical_not", "logical_xor"),
    *("bitwise_and", "bitwise_or", "bitwise_xor", "bitwise_not", "bitwise_invert", "invert"),
    *("left_shift", "right_shift", "bitwise_left_shift", "bitwise_right_shift", "bitwise_count"),
    *("gcd", "lcm"),
}
"""NumPy's elementwise functions that round once, or not at all."""
INEXACT = {name for name in dir(np) if isinstance(getattr(np, name), np.ufunc)} - EXACT
"""All its others, such as exp, power, hypot, matmul."""
MADE_OF_THEM = {
    *("dot", "vdot", "inner", "tensordot", "einsum", "convolve", "correlate", "cov", "corrcoef"),
    *("logspace", "geomspace", "interp", "polyfit", "polyval", "angle", "unwrap", "sinc", "i0"),
    *("linalg", "fft", "polynomial", "emath"),
}
OF_NUMPY = INEXACT | MADE_OF_THEM
OF_C = {"sqrt", "floor", "ceil", "trunc", "fabs", "copysign", "frexp", "ldexp", "nextafter", "ulp"}
OF_C |= {"prod", "fsum", "factorial", "comb", "perm", "gcd", "lcm", "isqrt", "fmod", "modf"}
OF_C |= {"isfinite", "isinf", "isnan", "isclose", "inf", "nan", "pi", "e", "tau"}
"""What may be used of `math`; the rest are functions of the C library."""

METHODS = {"dot", "__pow__", "__rpow__", "__matmul__", "__rmatmul__"}
"""Methods with other bits, whatever they are called on."""
COMPLEX = {"amplitudes", "initial", "z"}
"""What complex numbers are called: their modulus is `hypot` of C, and `numerics` has its own."""
EXACT_BASES = (-1, 0.5, 2)
"""Numbers whose whole powers are exact."""


def names_of(nodes: list[ast.AST]) -> dict[str, str]:
    """Return what each imported name of a module stands for, as a path of packages."""
    found = {}
    for node in nodes:
        if isinstance(node, ast.Import):
            for alias in node.names:
                first = alias.name.split(".")[0]
                found[alias.asname or first] = alias.name if alias.asname else first
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            for alias in node.names:
                found[alias.asname or alias.name] = f"{node.module}.{alias.name}"
    return found


def path_of(node: ast.AST, names: dict[str, str]) -> str:
    """Return the path that an expression such as `la.norm` stands for, or nothing."""
    if isinstance(node, ast.Name):
        return names.get(node.id, "")
    if isinstance(node, ast.Attribute):
        base = path_of(node.value, names)
        return base and f"{base}.{node.attr}"
    return ""


def refused(path: str) -> str:
    """Return the package or the function of a path whose bits differ, or nothing."""
    package, *rest = path.split(".")
    if package == "scipy" and rest:
        return ".".join([package, rest[0]])
    if package in ("cmath", "statistics") and rest:
        return package
    if package == "math" and rest and rest[0] not in OF_C:
        return path
    if package == "numpy" and rest and rest[0] in OF_NUMPY:
        return ".".join([package, rest[0]])
    return ""


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


PARTS = ("real", "imag", "shape", "size")


def uses(source: str) -> Iterator[str]:
    """Yield what a module uses whose bits differ between processors."""
    nodes = list(ast.walk(ast.parse(source)))
    names = names_of(nodes)
    yield from filter(None, map(refused, names.values()))
    for node in nodes:
        if isinstance(node, ast.Name | ast.Attribute):
            yield from filter(None, [refused(path_of(node, names))])
        if isinstance(node, ast.Attribute) and node.attr in METHODS and not path_of(node, names):
            yield f".{node.attr}"
        if isinstance(node, ast.BinOp | ast.AugAssign) and isinstance(node.op, ast.MatMult):
            yield "@"
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Pow):
            yield from [] if whole_power(node.left, node.right) else ["**"]
        if isinstance(node, ast.AugAssign) and isinstance(node.op, ast.Pow):
            yield from [] if whole_power(node.target, node.value) else ["**"]
        if isinstance(node, ast.Call):
            yield from of_call(node, names)


def of_call(node: ast.Call, names: dict[str, str]) -> Iterator[str]:
    """Yield what a call uses that no imported name tells."""
    called = getattr(node.func, "id", "") or path_of(node.func, names)
    if called == "pow":
        yield "**"
    if called in ("abs", "numpy.abs", "numpy.absolute") and any(map(complex_inside, node.args)):
        yield "abs of complex"
    if called == "getattr" and path_of(node.args[0], names).split(".")[0] in ("numpy", "math"):
        yield "getattr of a package"


def test_numbers_come_from_functions_with_the_same_bits_everywhere():
    """Each use stands in ALLOWED, and what is allowed is still used."""
    found = {
        (path.relative_to(LIBRARY).as_posix(), use)
        for path in LIBRARY.rglob("*.py")
        if path.relative_to(LIBRARY).parts[0].removesuffix(".py") not in MAY_DIFFER
        for use in uses(path.read_text())
    }
    assert found - ALLOWED.keys() == set(), "use pendula.numerics in place of these"
    assert ALLOWED.keys() - found == set(), "nothing uses these any longer"


SPELLINGS = [
    ("import numpy as np; np.exp(1.0)", "numpy.exp"),
    ("import numpy; numpy.hypot(x, y)", "numpy.hypot"),
    ("import numpy as np; np.power(x, 0.2)", "numpy.power"),
    ("import numpy as np; f = np.cbrt; f(x)", "numpy.cbrt"),
    ("import numpy as np; np.log.outer(x, y)", "numpy.log"),
    ("from numpy import exp", "numpy.exp"),
    ("from numpy import exp as e; e(x)", "numpy.exp"),
    ("import numpy.linalg", ""),
    ("import numpy.linalg; numpy.linalg.norm(x)", "numpy.linalg"),
    ("import numpy.linalg as la; la.norm(x)", "numpy.linalg"),
    ("from numpy import linalg as la; la.eigh(x)", "numpy.linalg"),
    ("from numpy.linalg import eigvals", "numpy.linalg"),
    ("import numpy as np; algebra = np.linalg", "numpy.linalg"),
    ("import numpy as np; np.fft.rfft(x)", "numpy.fft"),
    ("from numpy.fft import fft", "numpy.fft"),
    ("import numpy as np; np.dot(x, y)", "numpy.dot"),
    ("import numpy as np; np.matmul(x, y)", "numpy.matmul"),
    ("import numpy as np; np.einsum('ij,j', x, y)", "numpy.einsum"),
    ("import numpy as np; np.interp(x, y, w)", "numpy.interp"),
    ("import numpy as np; getattr(np, 'exp')(x)", "getattr of a package"),
    ("x.dot(y)", ".dot"),
    ("x @ y", "@"),
    ("x @= y", "@"),
    ("x ** 0.2", "**"),
    ("x ** -1", "**"),
    ("x ** 3", "**"),
    ("x ** n", "**"),
    ("x **= 0.5", "**"),
    ("2.0 ** (x / 3)", "**"),
    ("10.0 ** n", "**"),
    ("pow(x, 3)", "**"),
    ("x.__pow__(3)", ".__pow__"),
    ("import math; math.exp(1.0)", "math.exp"),
    ("import math as m; m.sin(1.0)", "math.sin"),
    ("from math import hypot", "math.hypot"),
    ("from math import log as ln; ln(2.0)", "math.log"),
    ("import cmath; cmath.exp(z)", "cmath"),
    ("import scipy.special; scipy.special.j1(x)", "scipy.special"),
    ("from scipy import special", "scipy.special"),
    ("from scipy.special import j1", "scipy.special"),
    ("import scipy.optimize as so; so.brentq(f, 0, 1)", "scipy.optimize"),
    ("abs(z)", "abs of complex"),
    ("abs(z[0] - 1)", "abs of complex"),
    ("import numpy as np; np.abs(amplitudes).max()", "abs of complex"),
    ("abs(problem.initial)", "abs of complex"),
    ("abs(z.real)", ""),
    ("abs(energy(amplitudes))", ""),
    ("x ** 2", ""),
    ("2.0 ** -53", ""),
    ("0.5 ** n", ""),
    ("import math; math.sqrt(2.0)", ""),
    ("from math import inf, sqrt", ""),
    ("import numpy as np; np.sqrt(np.abs(x)) * np.pi", ""),
    ("from pendula.numerics.elementary import exp; exp(x)", ""),
    ("from .elementary import exp, log; exp(x)", ""),
]
"""Lines, each with the use of another's function that must be seen in it, or with nothing."""


def test_every_spelling_is_seen():
    seen = [(line, ", ".join(set(uses(line)))) for line, _ in SPELLINGS]
    assert seen == SPELLINGS
