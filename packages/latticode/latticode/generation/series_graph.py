"""Changes to a model's graph for power series: halved squares, and functions carried along.

A function of the fields at a site satisfies a differential equation with products only: exp(s) has
the rate exp(s) s', 1 / s has the rate -s' / s^2, and so on. Such a function is therefore carried
along like an additional field. At the start of each step it is computed from its argument.

A site beyond an end of the chain has values but no equation, so its rates are unknown. A function
of neighbours therefore remains in the graph, and its coefficients are computed from those of its
argument (`series_functions`).
"""

from typing import NamedTuple

from latticode.equations.graph import (
    CONSTANT,
    MOTION,
    TWO,
    UNIT,
    Node,
    derivative,
    leaves_in,
    mul,
    neg,
    node,
    number,
    rebuilt,
    shifted,
)

from .statements import is_clock


def with_half_squares(nodes: list[Node]) -> list[Node]:
    """Return expressions with 2 (a^2 / 2) for a^2: the sum over orders is half as long."""

    def change(expression: Node, operands: list[Node]) -> Node | None:
        if (
            expression.operation == "mul"
            and operands[0] is operands[1]
            and expression.level == MOTION
        ):
            return mul(TWO, node("half_square", operands[0]))
        return None

    return rebuilt(nodes, change)


def is_product(expression: Node) -> bool:
    """Return whether the coefficients of a node are sums over orders."""
    if expression.operation == "half_square":
        return True
    return expression.operation == "mul" and expression.operands[0].level > CONSTANT


def is_sum_of_products(expression: Node) -> bool:
    """Return whether a node is a sum of products, possibly with constant factors."""
    if is_product(expression):
        return True
    if expression.operation in ("add", "sub", "neg"):
        return all(map(is_sum_of_products, expression.operands))
    return expression.operation == "mul" and is_sum_of_products(expression.operands[1])


def carried(i: int) -> Node:
    """Return the leaf for row `i` of the functions carried along."""
    return node("carried", i)


class Carried(NamedTuple):
    """Functions of one argument that are carried along together, in rows from `first` on."""

    kind: str
    argument: Node
    first: int

    def rates(self, speed: Node) -> list[Node]:
        """Return the rates of the rows, for an argument with the rate `speed`."""
        first, second = carried(self.first), carried(self.first + 1)
        match self.kind:
            case "turn":  # sine, cosine
                return [mul(second, speed), neg(mul(first, speed))]
            case "exp":
                return [mul(first, speed)]
            case "inverse":
                return [neg(mul(mul(first, first), speed))]
            case "log":  # logarithm, inverse
                return [mul(second, speed), neg(mul(mul(second, second), speed))]
        half = mul(number(0.5), mul(second, speed))  # root, inverse of the root
        return [half, neg(mul(mul(second, second), half))]


KINDS = {
    "sin": ("turn", 0),
    "cos": ("turn", 1),
    "exp": ("exp", 0),
    "div": ("inverse", 0),
    "log": ("log", 0),
    "sqrt": ("sqrt", 0),
}
"""The kind of each function that can be carried along, and its row within this kind."""
ROWS = {"turn": 2, "exp": 1, "inverse": 1, "log": 2, "sqrt": 2}
"""The number of rows of each kind."""


def is_function(expression: Node) -> bool:
    """Return whether a node is one of the functions in KINDS and depends on fields."""
    return expression.operation in KINDS and expression.level == MOTION


def has_rate(argument: Node, rates: list[Node]) -> bool:
    """Return whether the rate of an expression is known at every site, even next to an end.

    A field beyond an end has a known rate only if that rate is itself a field (a velocity). The
    rate of a product with a matrix is not known.
    """
    return not leaves_in([argument], "matrix") and all(
        by == 0 or rates[2 * component + re_im].operation == "field"
        for component, re_im, by in (leaf.operands for leaf in leaves_in([argument], "field"))
    )


def with_carried(
    rates: list[Node], site_dependent: frozenset[str]
) -> tuple[list[Node], list[Carried], list[tuple[Node, Node]]]:
    """Return the rates, in which leaves replace functions carried along, and these functions.

    The third value has a pair (argument, rate) for each row of these functions. Functions of
    neighbours remain in the rates.
    """
    groups: dict[tuple[str, Node], Carried] = {}

    def as_leaf(expression: Node, operands: list[Node]) -> Node | None:
        if (
            expression.level == CONSTANT
            or expression.operation not in KINDS
            or is_clock(expression, site_dependent)
        ):
            return None
        kind, row = KINDS[expression.operation]
        argument = expression.operands[-1]
        if not has_rate(argument, rates):
            return mul(operands[0], node("div", UNIT, operands[1])) if kind == "inverse" else None
        first = sum(ROWS[name] for name, _ in groups)
        carried_group = groups.setdefault((kind, argument), Carried(kind, argument, first))
        leaf = carried(carried_group.first + row)
        return mul(operands[0], leaf) if expression.operation == "div" else leaf

    def flow(leaf: Node) -> Node:
        if leaf.operation == "field":
            component, re_im, by = leaf.operands
            return shifted(rates[2 * component + re_im], by)
        return number(leaf.operation == "time")

    rates_with_leaves, row_rates, done = rebuilt(rates, as_leaf), [], 0
    while done < len(groups):
        group = list(groups.values())[done]
        argument, speed = rebuilt([group.argument, derivative([group.argument], flow)[0]], as_leaf)
        row_rates += [(argument, rate) for rate in group.rates(speed)]
        done += 1
    return rates_with_leaves, list(groups.values()), row_rates
