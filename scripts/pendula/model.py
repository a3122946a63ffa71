"""The equations of a lattice as one traced function, from which everything else is derived.

A model is a file such as this one (see docs/own_models.md):

    fields = ("u",)
    parameters = {"epsilon": 1.0, "gamma": 0.1}
    def i_dt(p, u):
        return p.epsilon * lap(u) + abs2(u) * u - 1j * p.gamma * u

`i_dt` returns i du_n/dt of each field; `d2_dt2` in its place returns the second derivatives of real
fields. `p` has the parameters, and the time `p.t`. The function is called once, with symbols in
place of numbers. Each symbol is a pair of real nodes of a graph in which equal nodes are one, and
the order of operations is the one that is written. Signs move outwards through products and sums
and a sum with zero is no operation: neither changes a bit.
"""

import inspect
import traceback
from collections.abc import Callable, Iterable, Mapping
from difflib import get_close_matches
from functools import cache, cached_property, partial
from pathlib import Path
from typing import Any

import numpy as np

LONGEST_SHIFT = 7
"""How far along the chain an equation may look: within the next block of a vector."""


class ModelError(ValueError):
    """A model that cannot be traced; the message names the operation and the line of its file."""


# --- The graph ----------------------------------------------------------------------------------

CONSTANT, CLOCK, MOTION = range(3)
"""What a node depends on: parameters alone, the time, or the fields."""
LEAVES = ("number", "parameter", "time", "field", "carried")


class Node:
    """A real number at each site: an operation, and nodes or what names a leaf.

    Leaves are ("number", x), ("parameter", name, shift), ("time",) and ("field", component, part,
    shift). The others are add, sub, neg, mul, div, sin and cos. (Power series have one leaf more,
    ("carried", i), see pendula.models.generated.)
    """

    def __init__(self, operation: str, *operands):
        self.operation, self.operands = operation, operands

    @cached_property
    def level(self) -> int:
        """CONSTANT, CLOCK or MOTION."""
        if self.operation in LEAVES:
            levels = {"field": MOTION, "carried": MOTION, "time": CLOCK}
            return levels.get(self.operation, CONSTANT)
        return max(operand.level for operand in self.operands)

    @cached_property
    def reach(self) -> int:
        """How many sites away its farthest leaf is."""
        if self.operation in LEAVES:
            return abs(self.operands[-1]) if self.operation in ("field", "parameter") else 0
        return max(operand.reach for operand in self.operands)


node = cache(Node)


@cache
def number(x: float) -> Node:
    """Return the node of a constant."""
    return node("number", float(x))


ZERO, ONE = number(0.0), number(1.0)


def is_number(a: Node) -> bool:
    """Return whether a node is a constant whose value is known."""
    return a.operation == "number"


def neg(a: Node) -> Node:
    """Return -a."""
    if is_number(a):
        return number(-a.operands[0] if a is not ZERO else 0.0)
    return a.operands[0] if a.operation == "neg" else node("neg", a)


def add(a: Node, b: Node) -> Node:
    """Return a + b."""
    if a is ZERO or b is ZERO:
        return b if a is ZERO else a
    if is_number(a) and is_number(b):
        return number(a.operands[0] + b.operands[0])
    if b.operation == "neg":
        return sub(a, b.operands[0])
    return sub(b, a.operands[0]) if a.operation == "neg" else node("add", a, b)


def sub(a: Node, b: Node) -> Node:
    """Return a - b."""
    if b is ZERO or a is b:
        return a if b is ZERO else ZERO
    if a is ZERO:
        return neg(b)
    if is_number(a) and is_number(b):
        return number(a.operands[0] - b.operands[0])
    if b.operation == "neg":
        return add(a, b.operands[0])
    return neg(add(a.operands[0], b)) if a.operation == "neg" else node("sub", a, b)


def mul(a: Node, b: Node) -> Node:
    """Return a b; what depends on less comes first."""
    if a.level > b.level or (is_number(b) and not is_number(a)):
        a, b = b, a
    if is_number(a):
        x = a.operands[0]
        if is_number(b):
            return number(x * b.operands[0])
        if x in (0.0, 1.0):
            return b if x else ZERO
        if x < 0.0:
            return neg(mul(number(-x), b))
    if a.operation == "neg":
        return neg(mul(a.operands[0], b))
    return neg(mul(a, b.operands[0])) if b.operation == "neg" else node("mul", a, b)


def reciprocal(a: Node) -> Node:
    """Return 1 / a of a constant."""
    if is_number(a):
        return number(1.0 / a.operands[0])
    return node("div", ONE, a)


BUILD = {"neg": neg, "add": add, "sub": sub, "mul": mul}
"""What makes a node of its operands, where that may simplify it."""


def rebuilt(nodes: Iterable[Node], change: Callable[[Node, list[Node]], Node | None]) -> list[Node]:
    """Return the expressions with another node in the place of some.

    change(node, operands) is given each node and its new operands; where it returns None, the node
    stays what it is, of these operands.
    """
    made: dict[Node, Node] = {}
    for one in in_order(nodes):
        operands = [] if one.operation in LEAVES else [made[a] for a in one.operands]
        new = change(one, operands)
        if new is None:
            build = BUILD.get(one.operation, partial(node, one.operation))
            new = one if one.operation in LEAVES else build(*operands)
        made[one] = new
    return [made[one] for one in nodes]


def shifted(a: Node, by: int) -> Node:
    """Return the expression at the site n + `by`."""

    def moved(one: Node, _) -> Node | None:
        if one.operation not in ("field", "parameter"):
            return None
        return node(one.operation, *one.operands[:-1], one.operands[-1] + by)

    return rebuilt([a], moved)[0]


def in_order(nodes: Iterable[Node]) -> list[Node]:
    """Return the nodes and all that they are made of, each after its operands."""
    found: dict[Node, None] = {}

    def visit(one: Node) -> None:
        if one not in found:
            for operand in () if one.operation in LEAVES else one.operands:
                visit(operand)
            found[one] = None

    for one in nodes:
        visit(one)
    return list(found)


def evaluate(nodes: Iterable[Node], leaf: Callable[[Node], Any], functions=np) -> list:
    """Return the values of nodes, whatever numbers `leaf` gives for theirs.

    `functions` has `sin` and `cos` of such numbers.
    """
    known: dict[Node, Any] = {}
    for one in in_order(nodes):
        if one.operation in LEAVES:
            known[one] = leaf(one)
            continue
        a, *b = (known[operand] for operand in one.operands)
        match one.operation:
            case "add":
                known[one] = a + b[0]
            case "sub":
                known[one] = a - b[0]
            case "mul":
                known[one] = a * b[0]
            case "div":
                known[one] = a / b[0]
            case "neg":
                known[one] = -a
            case name:
                known[one] = getattr(functions, name)(a)
    return [known[one] for one in nodes]


def derivative(nodes: list[Node], change: Callable[[Node], Node]) -> list[Node]:
    """Return how expressions change to first order where each leaf changes by change(leaf).

    A product adds its two terms one after the other to the sum that it ends, a' b last.
    """
    made: dict[Node, Node] = {}

    def of_sum(one: Node) -> Node:
        a, b = one.operands
        build = BUILD[one.operation]
        if b.operation == "mul":
            first, second = b.operands
            both = build(made[a], mul(first, made[second]))
            return (
                build(both, mul(made[first], second))
                if first is not second
                else (build(made[a], made[b]))
            )
        return build(made[a], made[b])

    for one in in_order(nodes):
        if one.operation in LEAVES:
            made[one] = change(one)
            continue
        a, b = one.operands[0], one.operands[-1]
        if one.level == CONSTANT:
            made[one] = ZERO
        elif one.operation in ("add", "sub"):
            made[one] = of_sum(one)
        elif one.operation == "neg":
            made[one] = neg(made[a])
        elif one.operation == "mul":
            made[one] = (
                mul(number(2.0), mul(a, made[a]))
                if a is b
                else add(mul(a, made[b]), mul(made[a], b))
            )
        else:
            outer = node("cos", a) if one.operation == "sin" else neg(node("sin", a))
            made[one] = mul(outer, made[a])
    return [made[one] for one in nodes]


# --- What a model is written in -----------------------------------------------------------------


class Value:
    """A complex number at each site, as a model computes with it: a pair of nodes."""

    __hash__ = None

    def __init__(self, re: Node, im: Node = ZERO):
        self.re, self.im = re, im

    @staticmethod
    def of(x: Any) -> "Value":
        """Return a number as a Value."""
        if isinstance(x, Value):
            return x
        if isinstance(x, int | float | complex | np.number) and not isinstance(x, bool):
            return Value(number(complex(x).real), number(complex(x).imag))
        raise ModelError(f"{type(x).__name__} cannot be computed with; give numbers and parameters")

    @property
    def right(self) -> "Value":
        """The value at the site n + 1."""
        return shift(self, 1)

    @property
    def left(self) -> "Value":
        """The value at the site n - 1."""
        return shift(self, -1)

    def __add__(self, other):
        other = Value.of(other)
        return Value(add(self.re, other.re), add(self.im, other.im))

    def __sub__(self, other):
        other = Value.of(other)
        return Value(sub(self.re, other.re), sub(self.im, other.im))

    def __mul__(self, other):
        other = Value.of(other)
        if self is other or (self.re is other.re and self.im is other.im):
            return self._square()
        return Value(
            sub(mul(self.re, other.re), mul(self.im, other.im)),
            add(mul(self.re, other.im), mul(self.im, other.re)),
        )

    def _square(self):
        product = mul(self.re, self.im)
        squares = sub(mul(self.re, self.re), mul(self.im, self.im))
        return Value(squares, mul(number(2.0), product))

    def __truediv__(self, other):
        other = Value.of(other)
        if max(other.re.level, other.im.level) > CONSTANT or other.im is not ZERO:
            raise ModelError("a division by a field, or by anything but a real parameter")
        inverse = reciprocal(other.re)
        return Value(mul(inverse, self.re), mul(inverse, self.im))

    def __pow__(self, exponent):
        if not isinstance(exponent, int) or not 1 <= exponent <= 9:
            raise ModelError(f"the power {exponent!r}: give a whole number from 1 to 9")
        power = self
        for _ in range(exponent - 1):
            power = power * self
        return power

    def __neg__(self):
        return Value(neg(self.re), neg(self.im))

    def __pos__(self):
        return self

    def __radd__(self, other):
        return Value.of(other) + self

    def __rsub__(self, other):
        return Value.of(other) - self

    def __rmul__(self, other):
        return Value.of(other) * self

    def __rtruediv__(self, other):
        return Value.of(other) / self

    def conjugate(self):
        """Return the complex conjugate."""
        return Value(self.re, neg(self.im))

    def __array_ufunc__(self, ufunc, method, *operands, **_):
        """Do what NumPy's functions and its numbers ask for, where there is a rule for it."""
        rule = UFUNCS.get(ufunc.__name__)
        if rule is None or method != "__call__":
            raise ModelError(f"{ufunc.__name__} of a field or a parameter has no rule")
        return rule(*map(Value.of, operands))

    def _refuse(self, *_):
        raise ModelError("a number, a comparison or a branch is taken from a symbol")

    __bool__ = __float__ = __complex__ = __int__ = __index__ = __iter__ = __len__ = _refuse
    __eq__ = __ne__ = __lt__ = __le__ = __gt__ = __ge__ = __getitem__ = _refuse

    def __abs__(self):
        raise ModelError("abs has no rule; abs2 is the squared modulus")


def shift(w: Value, sites: int) -> Value:
    """Return the value at the site n + `sites`."""
    w = Value.of(w)
    moved = Value(shifted(w.re, sites), shifted(w.im, sites))
    if max(moved.re.reach, moved.im.reach) > LONGEST_SHIFT:
        raise ModelError(f"a look farther than {LONGEST_SHIFT} sites along the chain")
    return moved


def lap(w: Value) -> Value:
    """Return w_{n+1} - 2 w_n + w_{n-1}, neighbours first, which keeps even data even."""
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


def _of_real(name: str, w: Value) -> Value:
    w = Value.of(w)
    if w.im is not ZERO:
        raise ModelError(f"{name} of a complex number has no rule")
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
}
"""Functions of NumPy by their names, with their rules."""


# --- Models -------------------------------------------------------------------------------------


class Model:
    """A traced model: the rates of the real rows of its state, two of each field.

    The rows of a complex field are its real and its imaginary part, those of a field with `d2_dt2`
    its value and its rate. `parameters` holds a number for each name, or a function of an array of
    sites n that returns a number for each (as for disorder). conserved(p, *fields) returns
    densities by name, whose sums over the chain are kept. `text` is the source, for datasets.

    Raises ModelError where the functions cannot be traced.
    """

    def __init__(
        self,
        *,
        fields: Iterable[str],
        parameters: Mapping[str, Any],
        i_dt: Callable | None = None,
        d2_dt2: Callable | None = None,
        conserved: Callable | None = None,
        name: str = "model",
        text: str = "",
    ):
        self.fields = (fields,) if isinstance(fields, str) else tuple(fields)
        self.parameters, self.name, self.in_file = dict(parameters), name, False
        self.second_order = d2_dt2 is not None
        functions = [one for one in (i_dt, d2_dt2, conserved) if one is not None]
        self.text = text or "\n".join(_source_of(function) for function in functions)
        if (i_dt is None) == (d2_dt2 is None):
            raise ModelError(f"{name} needs one function, i_dt or d2_dt2")
        rows = range(len(self.fields))
        symbols = [Value(leaf(c, 0), ZERO if d2_dt2 else leaf(c, 1)) for c in rows]
        found = self._called(i_dt or d2_dt2, symbols)
        found = found if isinstance(found, tuple | list) else (found,)
        if len(found) != len(self.fields):
            raise ModelError(f"{name} returns {len(found)} values for {len(self.fields)} fields")
        found = [Value.of(one) for one in found]
        if d2_dt2 and any(one.im is not ZERO for one in found):
            raise ModelError(f"{name}: d2_dt2 returns complex numbers, and its fields are real")
        self.rates = tuple(
            row
            for c, one in zip(rows, found, strict=True)
            for row in ((leaf(c, 1), one.re) if d2_dt2 else (one.im, neg(one.re)))
        )
        kept = self._called(conserved, symbols) if conserved else {}
        self.conserved = {name: Value.of(density).re for name, density in kept.items()}

    @classmethod
    def read(cls, path: Path | str) -> "Model":
        """Return the model of a file, whose code is run."""
        try:
            text = Path(path).read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise ModelError(f"{path} cannot be read: {error}") from None
        return cls.of_text(Path(path).name, text)

    @property
    def plain(self):
        """What of_text takes by name, if the model has a file; else the model itself."""
        return {"name": self.name, "text": self.text} if self.in_file else self

    @classmethod
    @cache
    def of_text(cls, name: str, text: str) -> "Model":
        """Return the model of the text of a file, which is run under that name."""
        given: dict[str, Any] = {}
        try:
            exec(compile(text, name, "exec"), given)
        except Exception as error:
            raise ModelError(_placed(error, name, text)) from None
        absent = [key for key in ("fields", "parameters") if key not in given]
        if absent:
            raise ModelError(f"{name} has no {' and no '.join(absent)}")
        functions = {key: given.get(key) for key in ("i_dt", "d2_dt2", "conserved")}
        given = {key: given[key] for key in ("fields", "parameters")}
        model = cls(**given, **functions, name=name, text=text)
        model.in_file = True
        return model

    def _called(self, function: Callable, symbols: list[Value]) -> Any:
        try:
            return function(_Parameters(self.parameters), *symbols)
        except Exception as error:
            place = function.__code__.co_filename
            raise ModelError(_placed(error, place, self.text, self.name)) from None

    @cached_property
    def reach(self) -> int:
        """How many sites to each side an equation looks."""
        return max(1, *(rate.reach for rate in self.rates))

    @cached_property
    def even(self) -> bool:
        """Whether the equations are the same, to the last bit, with left and right exchanged."""

        def ordered(one: Node, operands: list[Node]) -> Node | None:
            return node("add", *sorted(operands, key=id)) if one.operation == "add" else None

        def reflected(one: Node, operands: list[Node]) -> Node | None:
            if one.operation == "field":
                return leaf(*one.operands[:-1], -one.operands[-1])
            return ordered(one, operands)

        return rebuilt(self.rates, reflected) == rebuilt(self.rates, ordered)

    @cached_property
    def driven(self) -> bool:
        """Whether the equations depend on the time."""
        return any(one.operation == "time" for one in in_order(self.rates))

    def rate(self, parameters: Mapping[str, Any], peak: float) -> float:
        """Return a bound of the rates at which fields of the size `peak` turn or grow."""
        given = {name: value for name, value in self.parameters.items() if not callable(value)}
        sizes = {name: float(np.abs(value).max()) for name, value in (given | parameters).items()}

        def size(one: Node) -> float:
            if one.operation == "number":
                return one.operands[0]
            return (
                peak
                if one.operation == "field"
                else sizes.get(one.operands[0] if one.operands else "", 1.0)
            )

        rows = np.zeros(len(self.rates))
        for found in [one for one in in_order(self.rates) if one.operation == "field"]:
            change = derivative(list(self.rates), lambda one, found=found: number(one is found))
            rows += np.abs(evaluate(change, size))
        return float(rows.max())

    def tangent(self) -> "Model":
        """Return the model of a solution and a small perturbation of it: twice the fields."""
        count = len(self.fields)

        def change(one: Node) -> Node:
            if one.operation != "field":
                return ZERO
            component, part, by = one.operands
            return node("field", component + count, part, by)

        other = object.__new__(Model)
        other.__dict__.update(
            fields=(*self.fields, *(f"d{field}" for field in self.fields)),
            parameters=self.parameters,
            name=self.name,
            second_order=self.second_order,
            text=self.text,
            rates=(*self.rates, *derivative(list(self.rates), change)),
            conserved={},
        )
        return other


def leaf(component: int, part: int, by: int = 0) -> Node:
    """Return the node of a row of a field, at the site n + `by`."""
    return node("field", component, part, by)


class _Parameters:
    """What a model calls `p`."""

    def __init__(self, names: Iterable[str]):
        self._names = list(names)

    def __getattr__(self, name: str) -> Value:
        if name == "t":
            return Value(node("time"))
        if name not in self._names:
            near = get_close_matches(name, self._names, 1)
            hint = f"; did you mean {near[0]!r}?" if near else ""
            raise ModelError(f"there is no parameter {name!r}{hint}")
        return Value(node("parameter", name, 0))


def _source_of(function: Callable) -> str:
    try:
        return inspect.getsource(function)
    except (OSError, TypeError):  # typed where no file keeps it
        return ""


def _placed(error: Exception, place: str, text: str, name: str = "") -> str:
    """Return what is wrong, with the line of the user's file where it is."""
    frames = [one for one in traceback.extract_tb(error.__traceback__) if one.filename == place]
    at = frames[-1].lineno if frames else getattr(error, "lineno", None)
    lines = text.splitlines()
    what = f"{error}" if isinstance(error, ModelError) else f"{type(error).__name__}: {error}"
    if at is None:
        return f"{name or place}: {what}"
    line = frames[-1].line if frames else ""
    line = line or (lines[at - 1] if at <= len(lines) else "")
    return f"{name or place}, line {at}: {what}\n    {line.strip()}"
