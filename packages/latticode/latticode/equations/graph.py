"""Real expressions at each site of a lattice as a graph in which equal nodes are one.

The functions that build a node keep the order of operations as it is written, and simplify only
what changes no bit: signs and doublings move outwards through products and sums, constants are
computed, and a sum with zero is no operation.
"""

from collections.abc import Callable, Iterable
from functools import cache, cached_property, lru_cache, partial
from typing import Any

import numpy as np

CONSTANT, CLOCK, MOTION = range(3)
"""What a node depends on: parameters alone, the time, or the fields."""
LEAVES = {
    "number": CONSTANT,
    "parameter": CONSTANT,
    "time": CLOCK,
    "clock": CLOCK,
    "field": MOTION,
    "carried": MOTION,
    "matrix": MOTION,
}
"""The operations that have no operands, and what they depend on."""


class Node:
    """A real number at each site: an operation, and nodes or what names a leaf.

    Leaves are ("number", x), ("parameter", name, shift), ("time",), ("field", component, part,
    shift), and ("clock", name): a function of the time that the system has by its name. The others
    are add, sub, neg, mul, div, sin, cos, exp, log, sqrt, ("couple", ("matrix", name), a), which is
    a matrix of the sites times a, and ("where", c, a, b), which is a where
    c is above zero and b elsewhere. Power series have one leaf more, ("carried", i), and
    halves of squares, see latticode.generation.series_graph.
    """

    def __init__(self, operation: str, *operands):
        self.operation, self.operands = operation, operands

    @property
    def inputs(self) -> tuple["Node", ...]:
        """The nodes that it is made of."""
        return () if self.operation in LEAVES else self.operands

    @cached_property
    def level(self) -> int:
        """CONSTANT, CLOCK or MOTION."""
        own = LEAVES.get(self.operation, CONSTANT)
        return max((one.level for one in self.inputs), default=own)

    @cached_property
    def reach(self) -> int:
        """How many sites away its farthest leaf is."""
        own = abs(self.operands[-1]) if self.operation in ("field", "parameter") else 0
        return max((one.reach for one in self.inputs), default=own)


node = cache(Node)


@cache
def number(x: float) -> Node:
    """Return the node of a constant."""
    return node("number", float(x))


def leaf(component: int, part: int, by: int = 0) -> Node:
    """Return the node of a row of a field, at the site n + `by`."""
    return node("field", component, part, by)


ZERO, ONE, TWO = number(0.0), number(1.0), number(2.0)

# --- Nodes from nodes ---------------------------------------------------------------------------


def is_number(a: Node) -> bool:
    """Return whether a node is a constant whose value is known."""
    return a.operation == "number"


def is_doubled(a: Node) -> bool:
    """Return whether a node is twice another."""
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
    """Return a b; what depends on less comes first."""
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
    return number(1.0 / a.operands[0]) if is_number(a) else node("div", ONE, a)


def div(a: Node, b: Node) -> Node:
    """Return a / b; by a constant it is a product with its reciprocal."""
    if a is ZERO:
        return a
    return mul(reciprocal(b), a) if b.level == CONSTANT and a is not ONE else node("div", a, b)


def couple(matrix: Node, a: Node) -> Node:
    """Return the sums over all sites m of the matrix entries (n, m) times a at m."""
    if a is ZERO:
        return a
    return neg(couple(matrix, a.operands[0])) if a.operation == "neg" else node("couple", matrix, a)


def where(condition: Node, a: Node, b: Node) -> Node:
    """Return a where the condition is above zero, b elsewhere."""
    if is_number(condition):
        return a if condition.operands[0] > 0.0 else b
    return a if a is b else node("where", condition, a, b)


BUILD = {"neg": neg, "add": add, "sub": sub, "mul": mul, "couple": couple}
"""What makes a node of its operands, where that may simplify it."""

# --- Walks over a graph -------------------------------------------------------------------------


def in_order(nodes: Iterable[Node]) -> list[Node]:
    """Return the nodes and all that they are made of, each after its operands."""
    found: dict[Node, None] = {}

    def visit(one: Node) -> None:
        if one not in found:
            for operand in one.inputs:
                visit(operand)
            found[one] = None

    for one in nodes:
        visit(one)
    return list(found)


def leaves_in(nodes: Iterable[Node], operation: str) -> list[Node]:
    """Return the leaves of a kind that expressions hold."""
    return [one for one in in_order(nodes) if one.operation == operation]


def switches(nodes: Iterable[Node]) -> bool:
    """Return whether expressions change from one to another where a field or the time has it so."""
    return any(one.operation == "where" and one.level > CONSTANT for one in in_order(nodes))


def rebuilt(nodes: Iterable[Node], change: Callable[[Node, list[Node]], Node | None]) -> list[Node]:
    """Return the expressions with another node in the place of some.

    change(node, operands) is given each node and its new operands; where it returns None, the node
    stays what it is, of these operands.
    """
    made: dict[Node, Node] = {}
    for one in in_order(nodes):
        operands = [made[a] for a in one.inputs]
        new = change(one, operands)
        if new is None:
            build = BUILD.get(one.operation, partial(node, one.operation))
            new = build(*operands) if operands else one
        made[one] = new
    return [made[one] for one in nodes]


def shifted(a: Node, by: int) -> Node:
    """Return the expression at the site n + `by`."""

    def moved(one: Node, _) -> Node | None:
        if one.operation not in ("field", "parameter"):
            return None
        return node(one.operation, *one.operands[:-1], one.operands[-1] + by)

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


def evaluate(nodes: Iterable[Node], value: Callable[[Node], Any], functions=np) -> list:
    """Return the values of nodes, whatever numbers value(leaf) gives for their leaves.

    These may be numbers of any kind that adds and multiplies: arrays, multiprecision reals,
    integers where no leaf is a fraction. `functions` has sin, cos, exp, log and sqrt of them; what
    is chosen by a condition is chosen by NumPy.
    """
    leaves, compute = _as_function(tuple(nodes))
    return compute([*map(value, leaves)], functions)


@lru_cache(64)
def _as_function(nodes: tuple[Node, ...]) -> tuple[list[Node], Callable]:
    """Return the leaves of nodes, and the function of their values that returns the nodes'.

    It is written as source code: who evaluates a graph often would spend most time on the walk.
    """
    order = in_order(nodes)
    names = {one: f"v{i}" for i, one in enumerate(order)}
    leaves = [one for one in order if not one.inputs]
    lines = [f"    {''.join(f'{names[one]}, ' for one in leaves)} = leaves" if leaves else ""]
    for one in order:
        if one.inputs:
            how = ARITHMETIC.get(one.operation, f"functions.{one.operation}({{}})")
            lines.append(f"    {names[one]} = {how.format(*(names[a] for a in one.inputs))}")
    made: dict[str, Callable] = {"where": np.where, "times": _times}
    values = ", ".join(names[one] for one in nodes)
    exec("\n".join(["def compute(leaves, functions):", *lines, f"    return [{values}]"]), made)
    return leaves, made["compute"]


def _times(matrix: Any, values: Any) -> Any:
    """Return a matrix times values at its sites; of a number in its place, the product."""
    if np.ndim(matrix) == 0:
        return matrix * values
    return matrix @ np.broadcast_to(values, matrix.shape[:1])


def derivative(nodes: Iterable[Node], change: Callable[[Node], Node]) -> list[Node]:
    """Return how expressions change to first order where each leaf changes by change(leaf)."""
    made: dict[Node, Node] = {}

    def of_sum(build: Callable, a: Node, b: Node) -> Node:
        """A product b = c d at the end of a sum adds c d' to a', and then c' d."""
        if b.operation != "mul" or b.operands[0] is b.operands[1]:
            return build(made[a], made[b])
        c, d = b.operands
        return build(build(made[a], mul(c, made[d])), mul(made[c], d))

    def of(one: Node) -> Node:
        if one.level == CONSTANT:
            return ZERO
        match one.operation, *one.inputs:
            case "add" | "sub" as name, a, b:
                return of_sum(BUILD[name], a, b)
            case "neg", a:
                return neg(made[a])
            case "mul", a, b if a is b:
                return mul(TWO, mul(a, made[a]))
            case "mul", a, b:
                return add(mul(a, made[b]), mul(made[a], b))
            case "sin", a:
                return mul(node("cos", a), made[a])
            case "cos", a:
                return neg(mul(node("sin", a), made[a]))
            case "exp", a:
                return mul(one, made[a])
            case "log", a:
                return div(made[a], a)
            case "sqrt", a:
                return div(made[a], mul(TWO, one))
            case "div", a, b:
                return div(sub(made[a], mul(one, made[b])), b)
            case "couple", matrix, a:
                return couple(matrix, made[a])
            case "where", condition, a, b:
                return where(condition, made[a], made[b])
        return change(one)

    for one in in_order(nodes):
        made[one] = of(one)
    return [made[one] for one in nodes]
