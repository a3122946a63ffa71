"""What power series make of the graph of a model: halves of squares, and sines carried along.

The sine and the cosine of an expression s have the rates cos(s) s' and -sin(s) s', and are carried
along with the fields as if they were two more.
"""

from pendula.graph import (
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
from pendula.symbols import ModelError

MOST_ROWS = 64
"""Sines whose rates hold the sine of a neighbour, and so on, would need ever more rows."""


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
    """Return the leaf of a sine or cosine that is carried along."""
    return node("carried", i)


def with_carried(rates: list[Node]) -> tuple[list[Node], list[tuple[Node, Node]]]:
    """Return the rates with sines and cosines as leaves, and (angle, rate) of what is carried.

    The leaves are ("carried", i): the sine of an angle, and its cosine behind it.
    """
    angles: list[Node] = []

    def as_leaf(one: Node, operands: list[Node]) -> Node | None:
        if one.level < MOTION or one.operation not in ("sin", "cos"):
            return None
        angle = one.operands[0]
        if angle not in angles:
            angles.append(angle)
        return carried(2 * angles.index(angle) + (one.operation == "cos"))

    def flow(one: Node) -> Node:
        if one.operation == "field":
            component, part, by = one.operands
            return shifted(rates[2 * component + part], by)
        return number(one.operation == "time")

    made, found = rebuilt(rates, as_leaf), []
    while len(found) < 2 * len(angles):
        i = len(found)
        angle, speed = rebuilt([angles[i // 2], derivative([angles[i // 2]], flow)[0]], as_leaf)
        found += [(angle, mul(carried(i + 1), speed)), (angle, neg(mul(carried(i), speed)))]
        if len(found) > MOST_ROWS:
            raise ModelError("the sine of what depends on neighbours needs ever more of them")
    return made, found
