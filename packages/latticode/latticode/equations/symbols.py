"""Symbols for complex numbers and their functions; a trace calls the equations with symbols."""

import builtins
from functools import reduce
from operator import index
from typing import Any, NoReturn

import numpy as np

from .graph import (
    CONSTANT,
    TWO,
    ZERO,
    Node,
    add,
    div,
    leaves_in,
    mul,
    neg,
    node,
    number,
    reciprocal,
    shifted,
    sub,
)
from .graph import couple as coupled
from .graph import where as select

HIGHEST_POWER = 16
"""Integer exponents up to this size give products; other powers are exp(exponent * log(base))."""
KNOWN = "exp", "log", "sqrt", "sin", "cos", "abs2", "conj", "abs", "max", "sign", "where"
"""The functions of fields and parameters that equations may use."""
ARRAYS = (
    "a field is its value at one site, not an array of all sites; neighbours are u.left, u.right "
    "and shift(u, m), and a value for each site is a parameter"
)
LONGEST_SHIFT = 7
"""Largest distance to a neighbour, which must lie in the same or the next vector of eight sites."""
BRANCH = (
    "a comparison or a branch uses a symbol, which has no value yet; write max(a, b), "
    "where(x > 0, a, b), abs(x) or sign(x) of latticode"
)


class ModelError(ValueError):
    """A model that cannot be traced; the message names the operation and the line of its file."""


class Value:
    """A symbol for a complex number at each site: the nodes of its real and imaginary parts."""

    __hash__ = None

    def __init__(self, re: Node, im: Node = ZERO) -> None:
        self.re, self.im = re, im

    @staticmethod
    def of(x: Any) -> "Value":
        """Return a number as a Value; raises ModelError for arrays and other types."""
        if isinstance(x, Value):
            return x
        if isinstance(x, int | float | complex | np.number) and not isinstance(x, bool):
            return Value(number(complex(x).real), number(complex(x).imag))
        if isinstance(x, np.ndarray):
            raise ModelError(ARRAYS)
        text = f"a {type(x).__name__} in an equation; use only numbers, parameters and fields"
        raise ModelError(getattr(type(x), "no_number", text))

    @property
    def real(self) -> "Value":
        """The real part."""
        return Value(self.re)

    @property
    def imag(self) -> "Value":
        """The imaginary part."""
        return Value(self.im)

    @property
    def right(self) -> "Value":
        """The value at the site n + 1."""
        return shift(self, 1)

    @property
    def left(self) -> "Value":
        """The value at the site n - 1."""
        return shift(self, -1)

    def __add__(self, operand: Any) -> "Value":
        operand = Value.of(operand)
        return Value(add(self.re, operand.re), add(self.im, operand.im))

    def __sub__(self, operand: Any) -> "Value":
        operand = Value.of(operand)
        return Value(sub(self.re, operand.re), sub(self.im, operand.im))

    def __mul__(self, operand: Any) -> "Value":
        operand = Value.of(operand)
        if self is operand or (self.re is operand.re and self.im is operand.im):
            return self._square()
        return Value(
            sub(mul(self.re, operand.re), mul(self.im, operand.im)),
            add(mul(self.re, operand.im), mul(self.im, operand.re)),
        )

    def _square(self) -> "Value":
        product = mul(self.re, self.im)
        squares = sub(mul(self.re, self.re), mul(self.im, self.im))
        return Value(squares, mul(TWO, product))

    def __truediv__(self, operand: Any) -> "Value":
        operand = Value.of(operand)
        if operand.im is not ZERO:
            return self * operand.conjugate() / abs2(operand)
        if operand.re.level > CONSTANT:
            return Value(div(self.re, operand.re), div(self.im, operand.re))
        inverse = reciprocal(operand.re)
        return Value(mul(inverse, self.re), mul(inverse, self.im))

    def __pow__(self, exponent: Any) -> "Value":
        if isinstance(exponent, float) and exponent.is_integer():
            exponent = int(exponent)
        if not isinstance(exponent, int) or builtins.abs(exponent) > HIGHEST_POWER:
            if isinstance(exponent, int | float | Value) and not isinstance(exponent, bool):
                return exp(Value.of(exponent) * log(self))
            raise ModelError(f"the exponent is {exponent!r}; give a number or a parameter")
        power = Value(number(1.0)) if exponent == 0 else self
        for _ in range(builtins.abs(exponent) - 1):
            power = power * self
        return power if exponent >= 0 else 1 / power

    def __rpow__(self, base: Any) -> "Value":
        return Value.of(base) ** self

    def __neg__(self) -> "Value":
        return Value(neg(self.re), neg(self.im))

    def __pos__(self) -> "Value":
        return self

    def __radd__(self, operand: Any) -> "Value":
        return Value.of(operand) + self

    def __rsub__(self, operand: Any) -> "Value":
        return Value.of(operand) - self

    def __rmul__(self, operand: Any) -> "Value":
        return Value.of(operand) * self

    def __rtruediv__(self, operand: Any) -> "Value":
        return Value.of(operand) / self

    def conjugate(self) -> "Value":
        """Return the complex conjugate."""
        return Value(self.re, neg(self.im))

    conj = conjugate

    def __array_ufunc__(self, ufunc: Any, method: str, *operands: Any, **_: Any) -> "Value":
        """Apply one of UFUNCS; NumPy's functions and scalars call this method."""
        rule = UFUNCS.get(ufunc.__name__)
        if rule is None or method != "__call__":
            text = f"{ufunc.__name__} of a field or a parameter is not supported"
            raise ModelError(f"{text}; write it with {', '.join(KNOWN)}")
        if ufunc.__name__ == "power" and isinstance(operands[0], Value):
            return Value.__pow__(*operands)
        return rule(*map(Value.of, operands))

    def __gt__(self, operand: Any) -> "Condition":
        return Condition(sub(_real_part(self, ">"), _real_part(operand, ">")))

    def __lt__(self, operand: Any) -> "Condition":
        return Value.of(operand) > self

    def __ge__(self, operand: Any) -> "Condition":
        return Condition((self < operand).difference, negated=True)

    def __le__(self, operand: Any) -> "Condition":
        return Value.of(operand) >= self

    def _reject_branch(self, *_: Any) -> NoReturn:
        raise ModelError(BRANCH)

    def _reject_number(self, *_: Any) -> NoReturn:
        text = "a symbol cannot be converted to a number; use functions of latticode"
        raise ModelError(f"{text}: {', '.join(KNOWN)}")

    def _reject_array(self, *_: Any, **__: Any) -> NoReturn:
        raise ModelError(ARRAYS)

    __bool__ = __eq__ = __ne__ = _reject_branch
    __float__ = __complex__ = __int__ = __index__ = _reject_number
    __iter__ = __len__ = __getitem__ = __array__ = _reject_array

    def __getattr__(self, name: str) -> NoReturn:
        if name.startswith("__"):  # Python and NumPy probe for special methods
            raise AttributeError(name)
        text = "a field has .real, .imag, .left and .right; d2_dt2(p, x, v) receives velocities"
        raise ModelError(f"there is no .{name}: {text}")

    def __abs__(self) -> "Value":
        if self.im is not ZERO:
            return sqrt(abs2(self))
        return Value(select(self.re, self.re, neg(self.re)))


class Condition:
    """A comparison of two real values for `where`: `difference` > 0, or its opposite."""

    __hash__ = None

    def __init__(self, difference: Node, negated: bool = False) -> None:
        self.difference, self.negated = difference, negated

    def _reject_branch(self, *_: Any) -> NoReturn:
        raise ModelError(BRANCH)

    __bool__ = __eq__ = __ne__ = __and__ = __or__ = __invert__ = _reject_branch


def shift(w: Value, sites: int) -> Value:
    """Return the value at the site n + `sites`.

    Raises ModelError if `sites` is no integer or the result reads beyond LONGEST_SHIFT sites.
    """
    try:
        sites = index(sites)
    except (TypeError, ModelError):
        shown_number = "a symbol" if isinstance(sites, Value) else repr(sites)
        raise ModelError(
            f"shift(u, m) requires an integer m, such as 2, not {shown_number}"
        ) from None
    w = Value.of(w)
    if sites and leaves_in([w.re, w.im], "matrix"):
        text = "couple(p.W, u) has no neighbours to shift to; shift the rows of the matrix instead"
        raise ModelError(text)
    moved = Value(shifted(w.re, sites), shifted(w.im, sites))
    reach = builtins.max(moved.re.reach, moved.im.reach)
    if reach > LONGEST_SHIFT:
        raise ModelError(
            f"the equation reads a neighbour {reach} sites away; the limit is {LONGEST_SHIFT}, or"
            f" {2 * LONGEST_SHIFT} with separate fields for even and odd sites; for couplings over"
            " longer distances use a matrix, couple(p.W, u)"
        )
    return moved


def couple(matrix: Value, w: Value) -> Value:
    """Return sum_m W_nm w_m over all sites m.

    The matrix W is a parameter, p.W, of N x N real numbers, dense or scipy.sparse. Raises
    ModelError if the argument is not a parameter.
    """
    matrix = Value.of(matrix)
    if matrix.re.operation != "parameter" or matrix.im is not ZERO:
        raise ModelError("the first argument of couple(p.W, u) must be a parameter, the matrix")
    leaf, w = node("matrix", matrix.re.operands[0]), Value.of(w)
    return Value(coupled(leaf, w.re), coupled(leaf, w.im))


def lap(w: Value) -> Value:
    """Return w_{n+1} - 2 w_n + w_{n-1}; adding the neighbours first keeps even data even."""
    return (shift(w, 1) + shift(w, -1)) - 2 * Value.of(w)


def conj(w: Value) -> Value:
    """Return the complex conjugate."""
    return Value.of(w).conjugate()


def abs2(w: Value) -> Value:
    """Return the squared modulus."""
    w = Value.of(w)
    return Value(add(mul(w.re, w.re), mul(w.im, w.im)))


def sin(w: Value) -> Value:
    """Return the sine of a real value."""
    return _of_real("sin", w)


def cos(w: Value) -> Value:
    """Return the cosine of a real value."""
    return _of_real("cos", w)


def exp(w: Value) -> Value:
    """Return the exponential."""
    w = Value.of(w)
    size = Value(number(1.0) if w.re is ZERO else node("exp", w.re))
    return size if w.im is ZERO else size * Value(node("cos", w.im), node("sin", w.im))


def log(w: Value) -> Value:
    """Return the natural logarithm of a real value, which must stay positive."""
    return _of_real("log", w)


def sqrt(w: Value) -> Value:
    """Return the square root of a real value, which must stay positive."""
    return _of_real("sqrt", w)


def where(condition: Condition, if_true: Value, if_false: Value) -> Value:
    """Return `if_true` at sites where a condition such as x > 0 holds, `if_false` elsewhere."""
    if not isinstance(condition, Condition):
        raise ModelError("the condition of where(condition, a, b) must compare real values")
    if_true, if_false = Value.of(if_true), Value.of(if_false)
    if condition.negated:
        if_true, if_false = if_false, if_true
    re, im = (
        select(condition.difference, *pair)
        for pair in ((if_true.re, if_false.re), (if_true.im, if_false.im))
    )
    return Value(re, im)


def max(*values: Value) -> Value:
    """Return the largest of the real values at each site; plain numbers use Python's max."""
    if not any(isinstance(value, Value) for value in values):
        return builtins.max(*values)
    return reduce(lambda first, second: where(Value.of(first) > second, first, second), values)


def abs(w: Value) -> Value:
    """Return the modulus; a plain number uses Python's abs."""
    return builtins.abs(w)


def sign(w: Value) -> Value:
    """Return 1, 0 or -1 with the sign of a real value."""
    return where(Value.of(w) > 0, 1, where(Value.of(w) < 0, -1, 0))


def _real_part(w: Value, function: str) -> Node:
    w = Value.of(w)
    if w.im is not ZERO:
        raise ModelError(f"{function} compares a complex value; give a real one, such as .real")
    return w.re


def _of_real(name: str, w: Value) -> Value:
    w = Value.of(w)
    if w.im is not ZERO:
        raise ModelError(f"{name} of a complex number is not supported")
    return Value(node(name, w.re))


UFUNCS = {
    "add": Value.__add__,
    "subtract": Value.__sub__,
    "multiply": Value.__mul__,
    "divide": Value.__truediv__,
    "negative": Value.__neg__,
    "conjugate": conj,
    "sin": sin,
    "cos": cos,
    "exp": exp,
    "log": log,
    "sqrt": sqrt,
    "power": Value.__pow__,
    "absolute": abs,
    "maximum": max,
    "sign": sign,
    "greater": Value.__gt__,
    "less": Value.__lt__,
    "greater_equal": Value.__ge__,
    "less_equal": Value.__le__,
}
"""The rule that replaces each function of NumPy, by the name of the function."""
