"""What power series make of the graph of a model: halves of squares, and functions carried along.

A function of the fields obeys a differential equation of its own, made of products alone: exp(s)
has the rate exp(s) s', 1 / s has -s' / s^2, and so on. So it is carried along with the fields, as
if it were one more. At the beginning of each step it is computed from its argument.
"""

from functools import cache
from typing import NamedTuple

from latticode.equations.graph import (
    CONSTANT,
    MOTION,
    TWO,
    Node,
    derivative,
    mul,
    neg,
    node,
    number,
    rebuilt,
    shifted,
)
from latticode.equations.symbols import ModelError

from .statements import is_clock

MOST_ROWS = 64
"""Functions whose rates hold those of a neighbour, and so on, would need ever more rows."""


def with_half_squares(nodes: list[Node]) -> list[Node]:
    """Return expressions with squares as twice half of them: the sum over orders of a half is
    half as long."""

    def change(one: Node, operands: list[Node]) -> Node | None:
        if one.operation == "mul" and operands[0] is operands[1] and one.level == MOTION:
            return mul(TWO, node("half_square", operands[0]))
        return None

    return rebuilt(nodes, change)


def is_product(one: Node) -> bool:
    """Return whether the coefficients of a node are sums over orders."""
    if one.operation == "half_square":
        return True
    return one.operation == "mul" and one.operands[0].level > CONSTANT


def is_sum_of_products(one: Node) -> bool:
    """Return whether a node is made of products by sums and constant factors alone."""
    if is_product(one):
        return True
    if one.operation in ("add", "sub", "neg"):
        return all(map(is_sum_of_products, one.operands))
    return one.operation == "mul" and is_sum_of_products(one.operands[1])


def carried(i: int) -> Node:
    """Return the leaf of a row that is carried along."""
    return node("carried", i)


class Carried(NamedTuple):
    """Functions of one argument that are carried along together, as rows from `first` on."""

    kind: str
    argument: Node
    first: int

    def rates(self, speed: Node) -> list[Node]:
        """Return the rates of the rows, where the argument has the rate `speed`."""
        one, other = carried(self.first), carried(self.first + 1)
        match self.kind:
            case "turn":  # sine, cosine
                return [mul(other, speed), neg(mul(one, speed))]
            case "exp":
                return [mul(one, speed)]
            case "inverse":
                return [neg(mul(mul(one, one), speed))]
            case "log":  # logarithm, inverse
                return [mul(other, speed), neg(mul(mul(other, other), speed))]
        half = mul(number(0.5), mul(other, speed))  # root, inverse of the root
        return [half, neg(mul(mul(other, other), half))]


KINDS = {
    "sin": ("turn", 0), "cos": ("turn", 1), "exp": ("exp", 0), "div": ("inverse", 0),
    "log": ("log", 0), "sqrt": ("sqrt", 0),
}  # fmt: skip
"""The functions that are carried along: of each the kind, and its row among those of the kind."""
ROWS = {"turn": 2, "exp": 1, "inverse": 1, "log": 2, "sqrt": 2}


@cache
def has_series(rates: tuple[Node, ...]) -> bool:
    """Return whether the functions of the fields can be carried along.

    Those of a difference of neighbours cannot where the rates of these hold such functions too, as
    in first-order equations of phases: the function would need the rates of ever farther sites.
    """
    try:
        with_carried(list(rates), frozenset())
    except ModelError:
        return False
    return True


def with_carried(
    rates: list[Node], site_dependent: frozenset[str]
) -> tuple[list[Node], list[Carried], list[tuple[Node, Node]]]:
    """Return the rates with functions of the fields as leaves, these functions, and (argument,
    rate) of each of their rows."""
    kept: dict[tuple[str, Node], Carried] = {}

    def as_leaf(one: Node, operands: list[Node]) -> Node | None:
        if one.level == CONSTANT or one.operation not in KINDS or is_clock(one, site_dependent):
            return None
        kind, row = KINDS[one.operation]
        argument = one.operands[-1]
        first = sum(ROWS[name] for name, _ in kept)
        found = kept.setdefault((kind, argument), Carried(kind, argument, first))
        leaf = carried(found.first + row)
        return mul(operands[0], leaf) if one.operation == "div" else leaf

    def flow(one: Node) -> Node:
        if one.operation == "field":
            component, part, by = one.operands
            return shifted(rates[2 * component + part], by)
        return number(one.operation == "time")

    made, found, done = rebuilt(rates, as_leaf), [], 0
    while done < len(kept):
        group = list(kept.values())[done]
        argument, speed = rebuilt([group.argument, derivative([group.argument], flow)[0]], as_leaf)
        found += [(argument, rate) for rate in group.rates(speed)]
        done += 1
        if len(found) > MOST_ROWS:
            raise ModelError("a function of what depends on neighbours needs ever more of them")
    return made, list(kept.values()), found
