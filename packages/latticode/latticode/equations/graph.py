"""Real expressions at each site of a lattice as a graph that stores equal nodes only once.

The functions that build nodes keep the order of operations as written. They simplify only where no
bit changes: signs and factors of 2 move outwards through products and sums, constants are folded,
and zero terms are dropped.
"""

from collections.abc import Callable, Iterable
from functools import cache, cached_property, lru_cache, partial
from typing import Any

import numpy as np

CONSTANT, CLOCK, MOTION = range(3)
"""Levels of a node. CONSTANT: it depends on parameters only. CLOCK: it depends on the time, but not
on fields. MOTION: it depends on fields."""
LEAVES = {
    "number": CONSTANT,
    "parameter": CONSTANT,
    "time": CLOCK,
    "clock": CLOCK,
    "field": MOTION,
    "carried": MOTION,
    "matrix": MOTION,
}
"""The operations of leaves, each with its level."""


class Node:
    """A real number at each site n: an operation with its operands, or a leaf with its name.

    Leaves are ("number", x), ("time",), and ("matrix", name). ("clock", name) is a function of time
    that the system stores under this name. ("parameter", name, shift) and ("field", component,
    re_im, shift) are values at the site n + shift. Operations are add, sub, neg, mul, div, sin,
    cos, exp, log and sqrt. ("couple", matrix, a) is the product of the matrix with a at all sites;
    ("where", c, a, b) is a where c > 0, and b elsewhere. latticode.generation.series_graph adds the
    leaf ("carried", i) and the operation half_square, a^2 / 2, for power series.
    """

    def __init__(self, operation: str, *operands: Any) -> None:
        self.operation, self.operands = operation, operands

    @property
    def inputs(self) -> tuple["Node", ...]:
        """The operands that are nodes; none for a leaf."""
        return () if self.operation in LEAVES else self.operands

    @cached_property
    def level(self) -> int:
        """CONSTANT, CLOCK or MOTION."""
        leaf_level = LEAVES.get(self.operation, CONSTANT)
        return max((entry.level for entry in self.inputs), default=leaf_level)

    @cached_property
    def reach(self) -> int:
        """The distance in sites from n to the farthest leaf."""
        leaf_reach = abs(self.operands[-1]) if self.operation in ("field", "parameter") else 0
        return max((entry.reach for entry in self.inputs), default=leaf_reach)


node = cache(Node)


@cache
def number(x: float) -> Node:
    """Return the node of a constant."""
    return node("number", float(x))


def leaf(component: int, re_im: int, by: int = 0) -> Node:
    """Return the node of the real (0) or imaginary (1) part of a field at the site n + `by`."""
    return node("field", component, re_im, by)


ZERO, UNIT, TWO = number(0.0), number(1.0), number(2.0)

# --- Functions that build nodes -----------------------------------------------------------------


def is_number(a: Node) -> bool:
    """Return whether a node is a constant whose value is known."""
    return a.operation == "number"


def is_doubled(a: Node) -> bool:
    """Return whether a node is a product with the first factor 2."""
    return a.operation == "mul" and a.operands[0] is TWO


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
    if a.operation == "neg":
        return sub(b, a.operands[0])
    if is_doubled(a) and is_doubled(b):
        return mul(TWO, add(a.operands[1], b.operands[1]))
    return node("add", a, b)


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
    if a.operation == "neg":
        return neg(add(a.operands[0], b))
    if is_doubled(a) and is_doubled(b):
        return mul(TWO, sub(a.operands[1], b.operands[1]))
    return node("sub", a, b)


def mul(a: Node, b: Node) -> Node:
    """Return a b; the factor with the lower level comes first."""
    if a.level > b.level or (is_number(b) and not is_number(a)):
        a, b = b, a
    if a.operation == "neg":
        return neg(mul(a.operands[0], b))
    if b.operation == "neg":
        return neg(mul(a, b.operands[0]))
    if not is_number(a):
        return node("mul", a, b)
    x = a.operands[0]
    if is_number(b):
        return number(x * b.operands[0])
    if x in (0.0, 1.0):
        return b if x else ZERO
    if x < 0.0:
        return neg(mul(number(-x), b))
    return mul(number(2.0 * x), b.operands[1]) if is_doubled(b) else node("mul", a, b)


def reciprocal(a: Node) -> Node:
    """Return 1 / a."""
    return number(1.0 / a.operands[0]) if is_number(a) else node("div", UNIT, a)


def div(a: Node, b: Node) -> Node:
    """Return a / b, computed as (1 / b) a if b depends on parameters only."""
    if a is ZERO:
        return a
    return mul(reciprocal(b), a) if b.level == CONSTANT and a is not UNIT else node("div", a, b)


def couple(matrix: Node, a: Node) -> Node:
    """Return at each site n the sum over all sites m of the matrix entry (n, m) times a at m."""
    if a is ZERO:
        return a
    return neg(couple(matrix, a.operands[0])) if a.operation == "neg" else node("couple", matrix, a)


def where(condition: Node, a: Node, b: Node) -> Node:
    """Return a where `condition` > 0, and b elsewhere."""
    if is_number(condition):
        return a if condition.operands[0] > 0.0 else b
    return a if a is b else node("where", condition, a, b)


BUILD = {"neg": neg, "add": add, "sub": sub, "mul": mul, "couple": couple}
"""The function that builds a node from its operands, by operation; it may simplify the node."""

# --- Walks over a graph -------------------------------------------------------------------------


def in_order(nodes: Iterable[Node]) -> list[Node]:
    """Return the nodes and all their operands at any depth, each node after its operands."""
    ordered: dict[Node, None] = {}

    def visit(entry: Node) -> None:
        if entry not in ordered:
            for operand in entry.inputs:
                visit(operand)
            ordered[entry] = None

    for entry in nodes:
        visit(entry)
    return list(ordered)


def leaves_in(nodes: Iterable[Node], operation: str) -> list[Node]:
    """Return the leaves of one `operation`, such as "field", in the expressions."""
    return [entry for entry in in_order(nodes) if entry.operation == operation]


def switches(nodes: Iterable[Node]) -> bool:
    """Return whether expressions contain a `where` whose condition depends on fields or time."""
    return any(entry.operation == "where" and entry.level > CONSTANT for entry in in_order(nodes))


def rebuilt(nodes: Iterable[Node], change: Callable[[Node, list[Node]], Node | None]) -> list[Node]:
    """Return the expressions with some nodes replaced.

    change(node, operands) is called for each node with its new operands. It returns the new node,
    or None to keep the old operation.
    """
    rebuilt_nodes: dict[Node, Node] = {}
    for entry in in_order(nodes):
        operands = [rebuilt_nodes[a] for a in entry.inputs]
        new = change(entry, operands)
        if new is None:
            build = BUILD.get(entry.operation, partial(node, entry.operation))
            new = build(*operands) if operands else entry
        rebuilt_nodes[entry] = new
    return [rebuilt_nodes[entry] for entry in nodes]


def shifted(a: Node, by: int) -> Node:
    """Return the expression at the site n + `by`."""

    def moved(entry: Node, _: list[Node]) -> Node | None:
        if entry.operation not in ("field", "parameter"):
            return None
        return node(entry.operation, *entry.operands[:-1], entry.operands[-1] + by)

    return rebuilt([a], moved)[0]


ARITHMETIC = {
    "add": "{} + {}",
    "sub": "{} - {}",
    "mul": "{} * {}",
    "div": "{} / {}",
    "neg": "-{}",
    "where": "where({} > 0.0, {}, {})",
    "couple": "times({}, {})",
}


def evaluate(nodes: Iterable[Node], value: Callable[[Node], Any], functions: Any = np) -> list:
    """Return the values of the nodes; value(leaf) must return the value of a leaf.

    Values may be of any type with arithmetic: arrays, multiprecision numbers, or integers if no
    constant is a fraction. `functions` has sin, cos, exp, log and sqrt for this type. The
    operation "where" always uses numpy.where.
    """
    leaves, compute = _as_function(tuple(nodes))
    return compute([*map(value, leaves)], functions)


@lru_cache(64)
def _as_function(nodes: tuple[Node, ...]) -> tuple[list[Node], Callable]:
    """Return the leaves of the nodes and the function that computes node values from leaf values.

    The function is compiled from source, because walking the graph would dominate repeated calls.
    """
    order = in_order(nodes)
    names = {entry: f"v{i}" for i, entry in enumerate(order)}
    leaves = [entry for entry in order if not entry.inputs]
    lines = [f"    {''.join(f'{names[entry]}, ' for entry in leaves)} = leaves" if leaves else ""]
    for entry in order:
        if entry.inputs:
            how = ARITHMETIC.get(entry.operation, f"functions.{entry.operation}({{}})")
            lines.append(f"    {names[entry]} = {how.format(*(names[a] for a in entry.inputs))}")
    namespace: dict[str, Callable] = {"where": np.where, "times": _times}
    values = ", ".join(names[entry] for entry in nodes)
    exec(
        "\n".join(["def compute(leaves, functions):", *lines, f"    return [{values}]"]), namespace
    )
    return leaves, namespace["compute"]


def _times(matrix: Any, values: Any) -> Any:
    """Return a matrix times the values at all sites; `matrix` may also be a scalar factor."""
    if np.ndim(matrix) == 0:
        return matrix * values
    return matrix @ np.broadcast_to(values, matrix.shape[:1])


def derivative(nodes: Iterable[Node], change: Callable[[Node], Node]) -> list[Node]:
    """Return the first-order change of each expression when each leaf changes by change(leaf)."""
    derivatives: dict[Node, Node] = {}

    def of_sum(build: Callable, a: Node, b: Node) -> Node:
        """Return the derivative of a + b or a - b.

        For a product b = c d of two different nodes it is computed as (a' + c d') + c' d, or as
        (a' - c d') - c' d.
        """
        if b.operation != "mul" or b.operands[0] is b.operands[1]:
            return build(derivatives[a], derivatives[b])
        c, d = b.operands
        return build(build(derivatives[a], mul(c, derivatives[d])), mul(derivatives[c], d))

    def of(entry: Node) -> Node:
        if entry.level == CONSTANT:
            return ZERO
        match entry.operation, *entry.inputs:
            case "add" | "sub" as name, a, b:
                return of_sum(BUILD[name], a, b)
            case "neg", a:
                return neg(derivatives[a])
            case "mul", a, b if a is b:
                return mul(TWO, mul(a, derivatives[a]))
            case "mul", a, b:
                return add(mul(a, derivatives[b]), mul(derivatives[a], b))
            case "sin", a:
                return mul(node("cos", a), derivatives[a])
            case "cos", a:
                return neg(mul(node("sin", a), derivatives[a]))
            case "exp", a:
                return mul(entry, derivatives[a])
            case "log", a:
                return div(derivatives[a], a)
            case "sqrt", a:
                return div(derivatives[a], mul(TWO, entry))
            case "div", a, b:
                return div(sub(derivatives[a], mul(entry, derivatives[b])), b)
            case "couple", matrix, a:
                return couple(matrix, derivatives[a])
            case "where", condition, a, b:
                return where(condition, derivatives[a], derivatives[b])
        return change(entry)

    for entry in in_order(nodes):
        derivatives[entry] = of(entry)
    return [derivatives[entry] for entry in nodes]
