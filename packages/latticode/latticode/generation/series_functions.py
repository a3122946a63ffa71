"""The text that computes the coefficients of functions of a power series s.

The index of a coefficient is its order. The functions of s have the series e, a, b, q, l and r:

    exp       k e_k = sum_{j=1}^k j s_j e_{k-j}
    sine      k a_k = sum_{j=1}^k j s_j b_{k-j}
    cosine    k b_k = -sum_{j=1}^k j s_j a_{k-j}
    inverse   q_k = -q_0 sum_{j=1}^k s_j q_{k-j}
    log       k s_0 l_k = k s_k - sum_{j=1}^{k-1} j l_j s_{k-j}
    root      2 r_0 r_k = s_k - sum_{j=1}^{k-1} r_j r_{k-j}

Source: Jorba and Zou, Experimental Mathematics 14 (2005) 99, proposition 2.1. The rate of s is not
needed, so s may be a value beyond an end of the chain.
"""

from collections.abc import Callable

from latticode.equations.graph import Node, node

from .statements import FunctionText

PAIR = {"sin": ("sin", "cos"), "cos": ("sin", "cos")}
"""Functions whose coefficients are computed together."""
STARTS = {
    "sin": "sine_and_cosine({s})",
    "exp": "exponential({s})",
    "div": "1.0 / ({s})",
    "log": "logarithm_and_inverse({s})[0]",
    "sqrt": "root_and_inverse({s})[0]",
}
"""The coefficients of order 0: the functions of the argument's coefficient of order 0."""
TERMS = {
    "sin": ("(1.0 * j) * {s[j]} * {b[k - j]}", "(1.0 * j) * {s[j]} * {a[k - j]}"),
    "exp": ("(1.0 * j) * {s[j]} * {a[k - j]}",),
    "div": ("{s[j]} * {a[k - j]}",),
    "log": ("(1.0 * j) * {a[j]} * {s[k - j]}",),
    "sqrt": ("{a[j]} * {a[k - j]}",),
}
"""The terms of the sums over j."""
VALUES = {
    "sin": ("(1.0 / k) * {0}", "-((1.0 / k) * {1})"),
    "exp": ("(1.0 / k) * {0}",),
    "div": ("-({a[0]} * {0})",),
    "log": ("({s[k]} - (1.0 / k) * {0}) / {s[0]}",),
    "sqrt": ("0.5 * ({s[k]} - {0}) / {a[0]}",),
}
"""The coefficients of order k > 0, computed from the sums {0} and {1}."""
WITHOUT_LAST = ("log", "sqrt")
"""The functions whose sums end at j = k - 1."""


def members(function: Node) -> list[Node]:
    """Return the functions that are computed together: sine and cosine, or `function` alone."""
    pair = PAIR.get(function.operation)
    return [node(name, *function.operands) for name in pair] if pair else [function]


class _Coefficients:
    """The text of each coefficient of a node, by its order."""

    def __init__(self, expression: Node, load: Callable[[Node, str], str]) -> None:
        self.expression, self.load = expression, load

    def __getitem__(self, order: str | int) -> str:
        return self.load(self.expression, str(order))


def write_function(
    code: FunctionText,
    function: Node,
    load: Callable[[Node, str], str],
    store: Callable[[Node, str], str],
    even: bool,
) -> None:
    """Write the statements that store the coefficients of order k of the members of a function.

    load(node, order) returns the text of a coefficient. store(node, text) returns the statement
    that stores a coefficient of order k. The argument must be known up to order k.
    """
    rows = members(function)
    kind = rows[0].operation
    coefficients = {
        name: _Coefficients(member, load)
        for name, member in zip("sab", [function.operands[-1], *rows], strict=False)
    }
    sums = [f"sum{i}" for i in range(len(rows))]
    if even:
        code("if k == 0:")
        code(f"{', '.join(sums)} = {STARTS[kind].format(s=coefficients['s'][0])}", 1)
        for member, text in zip(rows, sums, strict=True):
            code(store(member, text), 1)
        code("else:")
    code(f"{', '.join(sums)} = {', '.join(['fill(0.0)'] * len(rows))}", even)
    code(f"for j in range(1, k{' + 1' * (kind not in WITHOUT_LAST)}):", even)
    for name, term in zip(sums, TERMS[kind], strict=True):
        code(f"{name} = {name} + {term.format(**coefficients)}", even + 1)
    for member, value in zip(rows, VALUES[kind], strict=True):
        code(store(member, value.format(*sums, **coefficients)), even)
