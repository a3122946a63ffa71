"""The text of sums over orders: the coefficients of products and of halves of squares.

    (a b)_k = sum_{j=0}^k a_j b_{k-j},
    (a^2 / 2)_k = sum_{0 <= j < k/2} a_j a_{k-j}, plus a_{k/2}^2 / 2 if k is even.

Orders are computed in pairs. The pass for an even order k also sums the known terms of order k + 1:
the terms without coefficients of order k + 1. The pass for order k + 1 adds the other terms. For a
clock, the coefficients of all orders are known.
"""

from collections.abc import Callable, Collection

from latticode.equations.graph import Node

from .statements import FunctionText


class CauchySumWriter:
    """Writes the sums of products, and registers their names in a `FunctionText`.

    The pass for an even order k registers ("now", product), the sum of order k, and
    ("next", product), the known terms of order k + 1. The pass for order k + 1 registers
    ("last", product), its other terms. load(node, order) returns the text of a coefficient.
    """

    def __init__(
        self, products: list[Node], load: Callable[[Node, str], str], clocks: Collection[Node]
    ) -> None:
        self.load, self.clocks = load, clocks
        self.names = {product: f"q{i}" for i, product in enumerate(products)}

    def write(self, code: FunctionText, products: list[Node], even: bool) -> None:
        """Write the sums of products whose operands are known up to order k."""
        if not even:
            for product in products:
                code.alias(("last", product), self._last(code, product))
            return
        squares = [product for product in products if product.operation == "half_square"]
        unequal = [product for product in products if product.operation != "half_square"]
        if squares:
            self._write_squares(
                code, [(self.names[product], product.operands[0]) for product in squares]
            )
        if unequal:
            self._write_unequal(
                code, [(self.names[product], *product.operands) for product in unequal]
            )
        for product in products:
            code.alias(("now", product), self.names[product])
            code.alias(("next", product), f"{self.names[product]}n")

    def _ends(self, code: FunctionText, operand: Node) -> list[str]:
        """Return the names of an operand's coefficients of orders 0 and k."""
        return [code.name((operand, order), self.load(operand, order)) for order in ("0", "k")]

    def _last(self, code: FunctionText, product: Node) -> str:
        """Return the text of the terms with a coefficient of the odd order k."""
        (a0, ak), *second = (self._ends(code, operand) for operand in product.operands)
        if not second:
            return f"{a0} * {ak}"
        ((b0, bk),) = second
        return (
            f"{a0} * {bk}" if product.operands[0] in self.clocks else f"({ak} * {b0} + {a0} * {bk})"
        )

    def _write_squares(self, code: FunctionText, squares: list[tuple[str, Node]]) -> None:
        """Write the sums of a^2 / 2: q of order k, and qn of order k + 1 without a_0 a_{k+1}."""
        for q, a in squares:
            middle = code.name((a, "k // 2"), self.load(a, "k // 2"))
            code(f"{q}, {q}n = 0.5 * {middle} * {middle}, fill(0.0)")
            code(f"{q}l = {self.load(a, '0')}")
        code("for j in range(1, k // 2 + 1):")
        for q, a in squares:
            code(f"{q}h = {self.load(a, 'k + 1 - j')}", 1)
            code(f"{q} = {q} + {q}l * {q}h", 1)
            code(f"{q}l = {self.load(a, 'j')}", 1)
            code(f"{q}n = {q}n + {q}l * {q}h", 1)

    def _write_unequal(self, code: FunctionText, products: list[tuple[str, Node, Node]]) -> None:
        """Write one loop for the sums q of a_j b_{k-j}, and qn of a_{j+1} b_{k-j} (order k + 1)."""
        firsts = {a: f"a{i}" for i, (_, a, _) in enumerate(products)}
        seconds = {b: f"b{i}" for i, (_, _, b) in enumerate(products)}
        for a, name in firsts.items():
            code(f"{name} = {self.load(a, '0')}")
        for q, _, _ in products:
            code(f"{q}, {q}n = fill(0.0), fill(0.0)")
        code("for j in range(k):")
        for b, name in seconds.items():
            code(f"{name} = {self.load(b, 'k - j')}", 1)
        for q, a, b in products:
            code(f"{q} = {q} + {firsts[a]} * {seconds[b]}", 1)
        for a, name in firsts.items():
            code(f"{name} = {self.load(a, 'j + 1')}", 1)
        for q, a, b in products:
            code(f"{q}n = {q}n + {firsts[a]} * {seconds[b]}", 1)
        for q, a, b in products:
            (_, last), (first, _) = self._ends(code, a), self._ends(code, b)
            code(f"{q} = {q} + {last} * {first}")
            if a in self.clocks:
                code(f"{q}n = {q}n + {self.load(a, 'k + 1')} * {first}")
