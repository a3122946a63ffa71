"""The text of rules that continue the power series of a traced model.

The coefficients u_k of a row with the rate F satisfy u_{k+1} = F_k / (k + 1). A coefficient of a
sum is the sum of its terms' coefficients. A coefficient of a product is a sum over orders (see
`series_sums`). All orders are stored only for factors of products, for functions of neighbours and
for the arguments of these functions (see `series_functions`). The pass for an even order adds up
the known terms of a sum of products in the next order, and stores them as one number. Constant
factors of a rate's terms absorb 1 / (k + 1) if this takes no additional multiplication.
"""

from itertools import chain

from latticode.equations.graph import CONSTANT, Node, in_order, node
from latticode.equations.symbols import ModelError
from latticode.integrators.taylor import ORDER
from latticode.kernels.simd import LANES

from .series_functions import members, write_function
from .series_graph import (
    carried,
    is_function,
    is_product,
    is_sum_of_products,
    with_carried,
    with_half_squares,
)
from .series_sums import CauchySumWriter
from .statements import FunctionText, Names, require_exchangeable, stages_of

SIGNS = {"add": "+", "sub": "-", "mul": "*"}
NEGATED = {"+": "-", "-": "+"}
SHIFTS = {1: "right_neighbours", LANES - 1: "left_neighbours"}
"""Functions of two successive blocks. The key is the lane of the first block that they start at."""
STARTS = {
    "turn": (("sine", "cosine"), "sine_and_cosine({})"),
    "exp": (("grown",), "exponential({})"),
    "inverse": (("inverse",), "1.0 / ({})"),
    "log": (("logarithm", "inverse"), "logarithm_and_inverse({})"),
    "sqrt": (("root", "inverse"), "root_and_inverse({})"),
}
"""For each kind of function carried along: its rows' names, and the text that computes order 0."""
RULE = """
SPARE = {spare} * LANES
WORK = taylor.work_arrays(-(-(SPARE + {clocks}) // {components}))
{shifts}
@in_one_pass
def write_next_order(system, series, k, first, last):
    m, d, share = series.memory, spare_start(series), 1.0 / (k + 1)
    at_start = 1.0 if k == 0 else 0.0
{work}
continue_in_waves = in_waves(write_next_order, {reach}{everywhere})
"""


class SeriesWriter:
    """The text of the rule that continues the series of a model.

    If the fields are `exchangeable`, it has the statements of one field, in a loop over both.
    """

    def __init__(
        self,
        model_rates: tuple[Node, ...],
        names: Names,
        site_dependent: frozenset[str],
        exchangeable: bool = False,
    ) -> None:
        self.exchangeable, self.names = exchangeable, names
        rows = list(model_rates[:2] if exchangeable else model_rates)
        rates, self.groups, self.row_rates = with_carried(rows, site_dependent)
        nodes = with_half_squares(
            [*rates, *(expression for pair in self.row_rates for expression in pair)]
        )
        self.components = len(rates) // 2
        self.clocks = {expression: i for i, expression in enumerate(names.clocks)}
        self.rates = nodes[: len(rates)]
        self.angles = nodes[len(rates) :: 2]
        self.flows = nodes[len(rates) + 1 :: 2]
        nodes = in_order([*self.rates, *self.flows])
        self.products = [expression for expression in nodes if is_product(expression)]
        self.functions = [expression for expression in nodes if is_function(expression)]
        # indices of the nodes that are stored in addition to the fields
        self.stored = self._number_stored()
        self.sums = CauchySumWriter(self.products, self.load, self.clocks)
        if exchangeable:
            require_exchangeable(model_rates, self.stored)
        # indices of sums of products that store only their known terms of the next order
        self.partial: dict[tuple[int, Node], int] = {}
        # products with matrices, computed after each pass over the blocks except the last
        self.stages = stages_of([*self.rates, *self.flows])
        self.stage = 0  # the current pass
        self.couples = {
            expression: i for i, expression in enumerate(chain.from_iterable(self.stages))
        }
        more = max(0, len(self.stored) - self.components)
        self.spare = more * (ORDER + 1)  # additional vectors per block

    def _number_stored(self) -> dict[Node, int]:
        operands = [operand for product in self.products for operand in product.operands]
        for function in self.functions:
            operands += [function.operands[-1], *members(function)]
        absent = [expression for expression in operands if not self._is_stored(expression)]
        needed = dict.fromkeys([*map(carried, range(len(self.row_rates))), *absent])
        return {expression: i for i, expression in enumerate(needed)}

    def _is_stored(self, expression: Node) -> bool:
        """Return whether all orders of a node are in memory anyway.

        This holds for clocks, fields at the site, and differences of two such fields.
        """
        if expression.operation == "sub":
            return all(a.operation == "field" and self._is_stored(a) for a in expression.operands)
        return expression in self.clocks or (
            expression.operation == "field" and expression.operands[2] == 0
        )

    # --- Places in memory

    def place(self, expression: Node, order: str) -> str:
        """Return the text of the index of a coefficient, for a stored node or a field."""
        if expression not in self.stored:
            component, re_im, _ = expression.operands
            return f"i{component} + ({order}) * ORDER_STRIDE + {'XY'[re_im]}"
        i = self.stored[expression]
        if i < self.components:
            return f"i{i} + ({order}) * ORDER_STRIDE + EXTRA"
        return f"s + ({(i - self.components) * (ORDER + 1)} + {order}) * LANES"

    def partial_place(self, expression: Node, even: bool) -> str:
        """Return the text of the index at which the known terms of an odd order are stored.

        If possible, they are stored in the memory of the following order, which is still free.
        """
        if expression in self.stored:
            return self.place(expression, "k + 1" if even else "k")
        i = self.partial.setdefault((self.stage, expression), len(self.partial))
        if i < len(self.rates):
            return f"i{i // 2} + (k + {1 + even}) * ORDER_STRIDE + {'XY'[i % 2]}"
        return f"s + {self.spare + i - len(self.rates)} * LANES"

    def load(self, expression: Node, order: str) -> str:
        """Return the text that loads a coefficient of a stored node, a field or a clock."""
        if expression in self.clocks:
            return f"fill(m[d + {self.clocks[expression] * (ORDER + 1)} + {order}])"
        if expression.operation == "sub" and expression not in self.stored:
            a, b = expression.operands
            return f"(load(m, {self.place(a, order)}) - load(m, {self.place(b, order)}))"
        return f"load(m, {self.place(expression, order)})"

    # --- The statements of an order

    def body(self, even: bool) -> tuple[list[str], list[list[str]]]:
        """Return the statements that compute constant factors, and those that write order k + 1.

        The second value has one list for each pass over the blocks. There are several passes if
        matrices couple sites, because a product with a matrix needs the factors of all blocks.
        """
        written: set[Node] = set()
        passes = []
        for stage, couples in enumerate(self.stages):
            self.stage, code = stage, FunctionText(3)
            factors = [expression.operands[1] for expression in couples]
            self._write_kept(code, factors, written, even)
            for expression in couples:
                row = self.couples[expression]
                value = self._value(code, expression.operands[1], even)
                code(f"store(system.couplings.factors_by_block, {self._in_block(row)}, {value})")
            passes.append(code.lines)
        code, factors = FunctionText(3), {}
        self.stage = len(self.stages)
        self._write_kept(code, None, written, even)
        rows = [self._next(code, rate, even, factors) for rate in [*self.rates, *self.flows]]
        for i, text in enumerate(rows):
            if i < len(self.rates):
                to = f"i{i // 2} + (k + 1) * ORDER_STRIDE + {'XY'[i % 2]}"
            else:
                to = self.place(carried(i - len(self.rates)), "k + 1")
                text = f"zero_below(TINY, {text})"
            code(f"store(m, {to}, {text})")
        return [f"        {name} = {text}" for text, name in factors.items()], [*passes, code.lines]

    def _in_block(self, row: int) -> str:
        """Return the text of the index of the current block in a row of `Couplings`."""
        return f"{row} * system.couplings.products_by_block.shape[1] + block * LANES"

    def _write_kept(
        self, code: FunctionText, roots: list[Node] | None, written: set[Node], even: bool
    ) -> None:
        """Write the stored coefficients of order k that the roots need, and the sums of products.

        If `roots` is None, all are written. Coefficients `written` by an earlier pass are loaded.
        """
        depth = self._depths()
        needed = set(depth if roots is None else _in_order_up_to_products(roots))
        if even and self.stage == 0:
            self._start_carried(code)
        for expression in written:
            code.alias(("value", expression), self.load(expression, "k"))
        needed_now = [
            expression
            for expression in self.stored
            if expression in needed and expression not in written
        ]
        for now in range(1, max(depth.values(), default=0) + 2):
            for expression in needed_now:
                if depth[expression] == now - 1 and not (
                    expression.operation == "carried" or is_function(expression)
                ):
                    code(self._store(expression, self._value(code, expression, even)))
            self._write_functions(
                code, [expression for expression in needed_now if depth[expression] == now], even
            )
            products = [
                expression
                for expression in self.products
                if expression in needed and depth[expression] == now
            ]
            self.sums.write(code, products, even)
        written.update(expression for expression in needed_now if expression.operation != "carried")

    def _depths(self) -> dict[Node, int]:
        """Return for each node how deeply products and functions are nested in it."""
        depth: dict[Node, int] = {}
        for expression in in_order([*self.rates, *self.flows, *self.stored]):
            depth[expression] = max((depth[a] for a in expression.inputs), default=0)
            depth[expression] += is_product(expression) or is_function(expression)
        return depth

    def _write_functions(self, code: FunctionText, nodes: list[Node], even: bool) -> None:
        """Write the coefficients of order k of the functions among the nodes."""
        written: set[Node] = set()
        for function in filter(is_function, nodes):
            if function not in written:
                written.update(members(function))
                write_function(code, function, self.load, self._store, even)

    def _store(self, expression: Node, text: str) -> str:
        """Return the statement that stores the coefficient of order k."""
        return f"store(m, {self.place(expression, 'k')}, zero_below(TINY, {text}))"

    def _start_carried(self, code: FunctionText) -> None:
        """Write order 0 of the functions carried along, computed from their arguments."""
        for group in self.groups:
            argument = self._start(self.angles[group.first], code)
            code("if k == 0:")
            names, text = STARTS[group.kind]
            code(f"{', '.join(names)} = {text.format(argument)}", 1)
            for row, name in enumerate(names):
                place = self.place(carried(group.first + row), "0")
                code(f"store(m, {place}, zero_below(TINY, {name}))", 1)

    def _start(self, expression: Node, code: FunctionText) -> str:
        """Return the text of the coefficient of order 0."""
        if expression.level == CONSTANT:
            return self._constant(expression)
        if expression in self.clocks:
            return self.load(expression, "0")
        operands = [self._start(a, code) for a in expression.inputs]
        match expression.operation:
            case "half_square":
                return f"0.5 * ({operands[0]}) * ({operands[0]})"
            case "neg":
                return f"-({operands[0]})"
            case "add" | "sub" | "mul" as how:
                return f"({operands[0]}) {SIGNS[how]} ({operands[1]})"
        return self._text(code, expression, True)

    def _combined(self, code: FunctionText, expression: Node, stage: str) -> str:
        """Return the text of a sum of products; `stage` (now, next or last) selects their names."""
        if is_product(expression):
            return code.known((stage, expression))
        if expression.level == CONSTANT:
            return self._constant(expression)
        operands = [self._combined(code, operand, stage) for operand in expression.operands]
        if expression.operation == "neg":
            return f"(-{operands[0]})"
        return f"({operands[0]} {SIGNS[expression.operation]} {operands[1]})"

    # --- The coefficient of order k

    def _value(self, code: FunctionText, expression: Node, even: bool) -> str:
        """Return the name of the coefficient of order k of a node."""
        return code.name(("value", expression), lambda: self._text(code, expression, even))

    def _text(self, code: FunctionText, expression: Node, even: bool) -> str:
        """Return the text of the coefficient of order k."""
        if is_sum_of_products(expression):
            return self._sum_text(code, expression, even)
        if expression.level == CONSTANT:
            numbers = f"at_start * {self._constant(expression)}"
            return numbers if expression in self.names.at_sites else f"fill({numbers})"
        if expression in self.clocks or is_function(expression):
            return self.load(expression, "k")
        match expression.operation, *expression.operands:
            case ("field", _, _, 0) | ("carried", _):
                return self.load(expression, "k")
            case "couple", *_:
                place = self._in_block(self.couples[expression])
                return f"load(system.couplings.products_by_block, {place})"
            case "field", *_:
                return self._neighbour(code, expression, even)
            case "neg", a:
                return f"-{self._value(code, a, even)}"
            case "mul", a, b:
                return f"{self._constant(a)} * {self._value(code, b, even)}"
            case "add" | "sub" as how, a, b:
                return f"{self._value(code, a, even)} {SIGNS[how]} {self._value(code, b, even)}"
        raise ModelError(f"{expression.operation} of a field or of time is not supported")

    def _constant(self, expression: Node) -> str:
        if expression in self.names.at_sites:
            row = self.names.at_sites[expression]
            return f"load(system.at, {row} * system.at.shape[1] + 1 + block * LANES)"
        return self.names.constant(expression)

    def _sum_text(self, code: FunctionText, expression: Node, even: bool) -> str:
        waiting = self.partial_place(expression, even)
        if even:
            code(f"store(m, {waiting}, {self._combined(code, expression, 'next')})")
            return self._combined(code, expression, "now")
        return f"load(m, {waiting}) + {self._combined(code, expression, 'last')}"

    def _neighbour(self, code: FunctionText, expression: Node, even: bool) -> str:
        component, re_im, by = expression.operands
        place = f"{'left' if by < 0 else 'right'}{component} + {'XY'[re_im]}"
        side = code.name(("side", place), f"load(m, {place})")
        at_site = self._value(code, node("field", component, re_im, 0), even)
        both = f"{side}, {at_site}" if by < 0 else f"{at_site}, {side}"
        first = by % LANES
        return f"{SHIFTS.get(first, f'shift_{first}')}({both})"

    # --- The coefficient of order k + 1 of a row

    def _next(self, code: FunctionText, rate: Node, even: bool, factors: dict[str, str]) -> str:
        """Return the text of a rate's coefficient of order k, divided by k + 1."""
        without_factor = [term for term in self._terms(rate) if not self._has_factor(term)]
        if len(without_factor) > 1 or rate.operation == "field":
            return f"share * {self._value(code, rate, even)}"

        def write(term: Node, sign: str) -> tuple[str, str]:
            """Return the sign and the text of a term; a constant factor absorbs `sign`."""
            if self._has_factor(term):
                factor = f"{sign.replace('+', '')}(share * {self._constant(term.operands[0])})"
                name = factors.setdefault(factor, f"f{len(factors)}")
                return "+", f"{name} * {self._value(code, term.operands[1], even)}"
            if self._terms(term) == [term]:
                return sign, f"share * {self._value(code, term, even)}"
            if term.operation == "neg":
                return write(term.operands[0], NEGATED[sign])
            a_sign, a = write(term.operands[0], sign)
            b_sign, b = write(term.operands[1], sign if term.operation == "add" else NEGATED[sign])
            if (a_sign, b_sign) == ("-", "+"):
                return "+", f"({b} - {a})"
            return a_sign, f"({a} {'+' if a_sign == b_sign else '-'} {b})"

        sign, text = write(rate, "+")
        return sign.replace("+", "") + text

    def _has_factor(self, expression: Node) -> bool:
        """Return whether a term has a constant factor that can absorb 1 / (k + 1)."""
        if (
            expression.operation != "mul"
            or expression.level == CONSTANT
            or is_sum_of_products(expression)
        ):
            return False
        return (
            expression.operands[0].level == CONSTANT
            and expression.operands[0] not in self.names.at_sites
        )

    def _terms(self, expression: Node) -> list[Node]:
        """Return the terms of a sum; a sum of products or of constants counts as one term."""
        if expression.level == CONSTANT or is_sum_of_products(expression):
            return [expression]
        if expression.operation not in ("add", "sub", "neg"):
            return [expression]
        return [term for operand in expression.operands for term in self._terms(operand)]

    # --- The text of all functions

    def text(self, reach: int) -> str:
        """Return the text of the functions that continue the series."""
        (factors, even), (_, odd) = self.body(True), self.body(False)
        clocks = -(-len(self.clocks) * (ORDER + 1) // LANES) * LANES  # in whole vectors
        begin = self._begin(clocks)
        even, odd = self._in_passes(begin, even), self._in_passes(begin, odd)
        work = ["    if k % 2 == 0:", *factors, *even, "    else:", *factors, *odd]
        if self.exchangeable:
            loop = "    for component in range(series.components):"
            work = [loop, *("    " + line for line in work)]
        return RULE.format(
            spare=self.spare + max(0, len(self.partial) - len(self.rates)),
            clocks=clocks,
            components=self.components,
            shifts="\n".join(f"shift_{by} = define_shift({by})" for by in range(2, LANES - 1)),
            work="\n".join(work),
            reach=reach,
            everywhere=", everywhere=True" * bool(self.stages),
        )

    def _in_passes(self, begin: list[str], passes: list[list[str]]) -> list[str]:
        """Return the loops over blocks, with the products with matrices between them."""
        lines = [*begin, *passes[0]]
        for couples, statements in zip(self.stages, passes[1:], strict=True):
            for expression in couples:
                row, matrix = (
                    self.couples[expression],
                    self.names.matrices[expression.operands[0].operands[0]],
                )
                rows = ", ".join(
                    f"system.couplings.{name}_by_block[{row}]" for name in ("factors", "products")
                )
                lines.append(f"        multiply_by_matrix(system.couplings, {matrix}, {rows}, 0)")
            lines += [*begin, *statements]
        return lines

    def _begin(self, clocks: int) -> list[str]:
        """Return the first lines of the loop over blocks; they find a block and its neighbours."""
        components = {c: str(c) for c in range(self.components)}
        block = "(block & series.mask)"
        if self.exchangeable:
            components = {0: "component", 1: "series.components - 1 - component"}
            block = "(component * series.held + (block & series.mask))"
        return [
            "        for block in range(first, last):",
            f"            s = d + {clocks} + {block} * SPARE",
            *(
                f"            i{c} = block_start(series, {at}, block)"
                for c, at in components.items()
            ),
            *(
                f"            left{c}, _, right{c} = sides_of(series, k, {at}, block)"
                for c, at in components.items()
            ),
        ]


def _in_order_up_to_products(nodes: list[Node]) -> list[Node]:
    """Return the nodes and their operands in order, without operands of products with a matrix."""
    ordered: dict[Node, None] = {}

    def visit(expression: Node) -> None:
        if expression not in ordered:
            for operand in () if expression.operation == "couple" else expression.inputs:
                visit(operand)
            ordered[expression] = None

    for expression in nodes:
        visit(expression)
    return list(ordered)
