"""Kernels of a traced model, written as a module in the style of `amplitudes`: rates and series.

The text of the module depends on the model alone, and on which of its parameters have a value for
each site. It is kept beside the kernels, which are named by it (see pendula.kernel_cache).

Rates. Every node is a statement, in the order of the trace, for one site or a vector of sites.

Series. The coefficient of order k of a sum is the sum of those of its terms, that of a product is a
sum over orders, and that of half a square is half as long. All orders are kept of what stands in a
product and of nothing else. Orders go in pairs: the pass over an even order k also sums the
products of order k + 1, but for the terms that hold its unknown coefficients, and adds these when
they are known. Partial sums are kept of a sum of products as a whole. The factor 1 / (k + 1) goes
into the constants of the terms of a rate where that costs no multiplication more. The sine of an
expression s has the rate cos(s) s', and is carried along with the fields.
"""

import sys
from collections.abc import Callable, Iterable
from functools import cache
from types import ModuleType
from typing import NamedTuple

import numpy as np

from pendula.integrators.taylor import ORDER
from pendula.kernel_cache import keep_source
from pendula.model import (
    BUILD,
    CLOCK,
    CONSTANT,
    LEAVES,
    MOTION,
    ZERO,
    Model,
    ModelError,
    Node,
    derivative,
    in_order,
    is_number,
    mul,
    neg,
    node,
    number,
    rebuilt,
    shifted,
)

TWO = number(2.0)

USED = {
    "pendula.compiled": "inlined_by_llvm, kernel",
    "pendula.integrators": "taylor",
    "pendula.integrators.taylor": "EXTRA, ORDER, ORDER_STRIDE, X, Y, block_start, spare_start",
    "pendula.models.chain": "at_every_site, close, widen",
    "pendula.models.generated": "System",
    "pendula.models.pendula": "sine_and_cosine",
    "pendula.models.series": "close_widely, in_waves, partner_of, sides_of",
    "pendula.simd": "LANES, define_shift, fill, left_neighbours, load, right_neighbours, store",
}
"""What a generated module takes from the library."""
HEAD = "\n".join(f"from {module} import {names}" for module, names in USED.items()) + "\n\n"
CONTINUE = """
@kernel
def continue_series(system, series):
    continue_in_waves(system, series)
"""
WRITE_CLOCKS = "    write_clocks(system, series.memory, spare_start(series))\n"
MOST_ROWS = 64
"""Sines whose rates hold the sine of a neighbour, and so on, would need ever more rows."""


class System(NamedTuple):
    """What the kernels of any traced model are given."""

    constants: tuple[float, ...]
    clocks: tuple[float, ...]  # the functions of the time, and behind them their derivatives
    at: np.ndarray  # (row, 1 + site), parameters that depend on the site, with room for a vector
    wide: np.ndarray  # (row, reach + site), room for a state with more ghost columns
    left: int
    right: int


class Parts(NamedTuple):
    """What the kernels of a model take from outside: constants and functions of the time."""

    constants: tuple[Node, ...]  # one number each
    at_sites: tuple[Node, ...]  # one number a site each
    clocks: tuple[Node, ...]  # sines and cosines of the time, and the time itself


def parts_of(nodes: Iterable[Node], site_dependent: frozenset[str]) -> Parts:
    """Return the largest expressions of parameters alone, and the functions of time."""
    constants, at_sites, clocks = {}, {}, {}

    def visit(one: Node) -> None:
        if one.level == CONSTANT and not is_number(one):
            names = {part.operands[0] for part in parameters_in(one)}
            (at_sites if names & site_dependent else constants)[one] = None
        elif one.level == CLOCK and one.operation in ("sin", "cos", "time"):
            clocks[one] = None
            for found in () if one.operation == "time" else affine(one.operands[0]):
                if {part.operands[0] for part in parameters_in(found)} & site_dependent:
                    raise ModelError("the sine of an angle that depends on time and site")
                visit(found)
        elif one.operation not in LEAVES:
            for operand in one.operands:
                visit(operand)

    for one in nodes:
        visit(one)
    return Parts(tuple(constants), tuple(at_sites), tuple(clocks))


def parts_of_rates(rates: tuple[Node, ...], site_dependent: frozenset[str]) -> Parts:
    """Return the parts of rates, and of what their series carry along."""
    _, found = with_carried(list(rates))
    return parts_of([*rates, *(one for pair in found for one in pair)], site_dependent)


def parameters_in(expression: Node) -> list[Node]:
    """Return the parameters that an expression holds."""
    return [one for one in in_order([expression]) if one.operation == "parameter"]


def affine(angle: Node) -> tuple[Node, Node]:
    """Return frequency and phase of an angle that grows steadily with the time."""
    time = node("time")
    frequency = derivative([angle], lambda one: number(one is time))[0]
    phase = rebuilt([angle], lambda one, _: ZERO if one is time else None)[0]
    if frequency.level > CONSTANT:
        raise ModelError("a sine or cosine of the time must be of frequency times p.t plus phase")
    return frequency, phase


# --- Statements ---------------------------------------------------------------------------------


class Code:
    """Statements of a function, with a name for each value, so that none is computed twice."""

    def __init__(self, indent: int):
        self.lines: list[str] = []
        self.indent, self._names = indent, {}

    def __call__(self, text: str, deeper: int = 0) -> None:
        """Write a line."""
        self.lines.append("    " * (self.indent + deeper) + text)

    def name(self, key, text: Callable[[], str] | str) -> str:
        """Return the name of a value, whose statement is written where it is first asked for."""
        if key not in self._names:
            text = text if isinstance(text, str) else text()
            self._names[key] = f"v{len(self._names)}"
            self(f"{self._names[key]} = {text}")
        return self._names[key]

    def alias(self, key, name: str) -> None:
        """Let a value have a name that exists."""
        self._names[key] = name


class Names:
    """How numbers that do not depend on the fields are called in the text of a module."""

    def __init__(self, parts: Parts):
        self.constants = {one: f"system.constants[{i}]" for i, one in enumerate(parts.constants)}
        self.at_sites = {one: i for i, one in enumerate(parts.at_sites)}
        self.clocks = {one: i for i, one in enumerate(parts.clocks)}


def sum_text(a: str, b: str, scalar: tuple[bool, bool], minus: bool) -> str:
    """Return a + b or a - b, with a plain number first: it may stand there beside a vector."""
    if scalar[1] and not scalar[0]:
        return f"{'-' * minus}{b} + {a}"
    return f"{a} {'-' if minus else '+'} {b}"


# --- Rates --------------------------------------------------------------------------------------


def rates_text(rows: tuple[Node, ...], names: Names, reach: int) -> str:
    """Return the functions that write the rates of a state of so many rows."""
    code = Code(1)
    offset = reach - 1

    def value(one: Node) -> str:
        return code.name(one, lambda: text(one))

    def scalar(one: Node) -> bool:
        return one.level < MOTION and not any(part in names.at_sites for part in in_order([one]))

    def text(one: Node) -> str:
        if one in names.constants:
            return names.constants[one]
        if one in names.at_sites:
            return f"at[{names.at_sites[one]}, j]"
        if one in names.clocks:
            return f"system.clocks[{names.clocks[one]}]"
        match one.operation, *one.operands:
            case "number", x:
                return repr(x)
            case "field", component, part, by:
                by += offset
                return f"y[{2 * component + part}, j{f' {by:+d}' if by else ''}]"
            case "neg", a:
                return f"-{value(a)}"
            case "mul", a, b:
                a, b = (b, a) if scalar(b) else (a, b)
                return f"{value(a)} * {value(b)}"
            case "add" | "sub" as how, a, b:
                return sum_text(value(a), value(b), (scalar(a), scalar(b)), how == "sub")
            case "sin" | "cos" as which, a:
                both = code.name(("both", a), lambda: f"sine_and_cosine({value(a)})")
                return f"{both}[{int(which == 'cos')}]"
        raise ModelError(f"{one.operation} of a field or of the time has no rule")

    results = []
    for row, rate in enumerate(rows):
        found = value(rate)
        results.append(f"{found} + 0.0 * y[{row}, j{f' + {offset}' * bool(offset)}]"
                       if scalar(rate) else found)  # fmt: skip
    for row, found in enumerate(results):
        code(f"dy[{row}, j] = {found}")
    states = "y, at = states[0], states[1]" if names.at_sites else "y = states[0]"
    given = ("system.wide" if reach > 1 else "y") + (", system.at" * bool(names.at_sites))
    prepare = "widen(system, y, system.wide)" if reach > 1 else "close(system, y)"
    return "\n".join([
        "@inlined_by_llvm",
        "def rates_at_site(system, states, re, j, dy):",
        f"    {states}",
        *code.lines, "", "",
        f"write_rates = at_every_site(rates_at_site, {len(rows)})", "", "",
        "@kernel",
        "def rates(system, y, dy):",
        f"    {prepare}",
        f"    write_rates(system, ({given},), dy)", "", "",
    ])  # fmt: skip


# --- Power series -------------------------------------------------------------------------------


def doubled_out(nodes: list[Node]) -> list[Node]:
    """Return expressions with squares as twice half of them, and factors of two moved outwards."""

    def twice(one: Node) -> bool:
        return one.operation == "mul" and one.operands[0] is TWO

    def change(one: Node, operands: list[Node]) -> Node | None:
        if one.operation == "mul":
            a, b = operands
            if a is b and one.level == MOTION:
                return mul(TWO, node("half_square", a))
            if is_number(a) and twice(b):
                return mul(number(2.0 * a.operands[0]), b.operands[1])
        if one.operation in ("add", "sub") and all(map(twice, operands)):
            return mul(TWO, BUILD[one.operation](*(a.operands[1] for a in operands)))
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


def with_carried(rates: list[Node]) -> tuple[list[Node], list[tuple[Node, Node]]]:
    """Return the rates with sines and cosines as leaves, and (angle, rate) of what is carried.

    The leaves are ("carried", i): the sine of an angle, and its cosine behind it.
    """
    angles: list[Node] = []

    def leaf(one: Node, operands: list[Node]) -> Node | None:
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

    made, found = rebuilt(rates, leaf), []
    while len(found) < 2 * len(angles):
        i = len(found) // 2
        angle, speed = rebuilt([angles[i], derivative([angles[i]], flow)[0]], leaf)
        found += [(angle, mul(carried(2 * i + 1), speed)), (angle, neg(mul(carried(2 * i), speed)))]
        if len(found) > MOST_ROWS:
            raise ModelError("the sine of what depends on neighbours needs ever more of them")
    return made, found


def carried(i: int) -> Node:
    """Return the leaf of a sine or cosine that is carried along."""
    return node("carried", i)


class Series:
    """The text of the rule that continues the series of a model."""

    def __init__(self, model_rates: tuple[Node, ...], names: Names, alike: bool = False):
        self.alike = alike
        rates, self.found = with_carried(list(model_rates[:2] if alike else model_rates))
        nodes = doubled_out([*rates, *(part for pair in self.found for part in pair)])
        self.components, self.names = len(rates) // 2, names
        self.rates = nodes[: len(rates)]
        self.angles = nodes[len(rates) :: 2]
        self.flows = nodes[len(rates) + 1 :: 2]
        self.kept: dict[Node, int] = {}  # its place among what the rule keeps at each site
        for i in range(len(self.found)):
            self.kept[carried(i)] = len(self.kept)
        self.products = [one for one in in_order([*self.rates, *self.flows]) if is_product(one)]
        for product in self.products:
            for operand in product.operands:
                if not (operand.operation == "field" and operand.operands[2] == 0):
                    self.kept.setdefault(operand, len(self.kept))
        if alike:
            require_alike(model_rates, [*self.kept])
        self.partial: dict[Node, int] = {}  # sums of products that are not kept
        more = max(0, len(self.kept) - self.components)
        self.spare = more * (ORDER + 1)  # vectors of a block beside its own

    # --- Places in memory

    def place(self, one: Node, order: str) -> str:
        """Return where the coefficient of an order of a kept node or a field lies."""
        if one not in self.kept:
            component, part, _ = one.operands
            return f"i{component} + ({order}) * ORDER_STRIDE + {'XY'[part]}"
        i = self.kept[one]
        if i < self.components:
            return f"i{i} + ({order}) * ORDER_STRIDE + EXTRA"
        return f"s + ({(i - self.components) * (ORDER + 1)} + {order}) * LANES"

    def partial_place(self, one: Node, even: bool) -> str:
        """Return where a sum of products of an odd order waits for its last terms.

        The places of the order after it are free until then.
        """
        if one in self.kept:
            return self.place(one, "k + 1" if even else "k")
        i = self.partial.setdefault(one, len(self.partial))
        if i < len(self.rates):
            return f"i{i // 2} + (k + {1 + even}) * ORDER_STRIDE + {'XY'[i % 2]}"
        return f"s + {self.spare + i - len(self.rates)} * LANES"

    # --- The coefficient of order k

    def body(self, even: bool) -> tuple[list[str], list[str]]:
        """Return the factors of an order, and the statements that write order k + 1 of a block."""
        code = Code(3)
        level: dict[Node, int] = {}
        for one in in_order([*self.rates, *self.flows, *self.kept]):
            below = () if one.operation in LEAVES else one.operands
            level[one] = max((level[operand] for operand in below), default=0) + is_product(one)
        most = max(level.values(), default=0)
        self._carry_start(code, even)
        for now in range(1, most + 2):
            for one in self.kept:
                if one.operation != "carried" and level[one] == now - 1:
                    code(f"store(m, {self.place(one, 'k')}, {self._value(code, one, even)})")
            products = [one for one in self.products if level[one] == now]
            if products:
                self._sums(code, products, even)
        shares = {}
        rows = [self._scaled(code, rate, even, shares) for rate in [*self.rates, *self.flows]]
        for i, found in enumerate(rows):
            if i < len(self.rates):
                to = f"i{i // 2} + (k + 1) * ORDER_STRIDE + {'XY'[i % 2]}"
            else:
                to = self.place(carried(i - len(self.rates)), "k + 1")
            code(f"store(m, {to}, {found})")
        return [f"        {name} = {text}" for text, name in shares.items()], code.lines

    def _carry_start(self, code: Code, even: bool) -> None:
        """Write sines and cosines at order 0, from their angles."""
        for i in range(0, len(self.found), 2) if even else ():
            code("if k == 0:")
            code.indent += 1
            code(f"sine, cosine = sine_and_cosine({self._start(code, self.angles[i])})")
            code(f"store(m, {self.place(carried(i), '0')}, sine)")
            code(f"store(m, {self.place(carried(i + 1), '0')}, cosine)")
            code.indent -= 1

    def _start(self, code: Code, one: Node) -> str:
        """Return the expression of the coefficient of order 0."""
        match one.operation, *one.operands:
            case "half_square", a:
                return f"0.5 * ({self._start(code, a)}) * ({self._start(code, a)})"
            case "add" | "sub" | "mul" as how, a, b if one.level > CONSTANT:
                sign = {"add": "+", "sub": "-", "mul": "*"}[how]
                return f"({self._start(code, a)}) {sign} ({self._start(code, b)})"
            case "neg", a:
                return f"-({self._start(code, a)})"
        return self._constant(one) if one.level == CONSTANT else self._text(code, one, True)

    def _load(self, code: Code, one: Node, order: str) -> str:
        return f"load(m, {self.place(one, order)})"

    def _sums(self, code: Code, products: list[Node], even: bool) -> None:
        """Write the sums over orders of products whose operands are known up to order k."""
        squares = [one for one in products if one.operation == "half_square"]
        others = [one for one in products if one.operation != "half_square"]
        if not even:
            for one in squares:
                a = one.operands[0]
                ends = [code.name((a, o), self._load(code, a, o)) for o in ("0", "k")]
                code.alias(("last", one), f"{ends[0]} * {ends[1]}")
            for one in others:
                (a0, ak), (b0, bk) = (
                    [code.name((x, o), self._load(code, x, o)) for o in ("0", "k")]
                    for x in one.operands
                )
                code.alias(("last", one), f"({ak} * {b0} + {a0} * {bk})")
            return
        if squares:
            self._squares(code, squares)
        if others:
            self._skew(code, others)

    def _squares(self, code: Code, squares: list[Node]) -> None:
        names = {one: f"q{self.products.index(one)}" for one in squares}
        for one, q in names.items():
            a = one.operands[0]
            middle = code.name((a, "k // 2"), self._load(code, a, "k // 2"))
            code(f"{q}, {q}n = 0.5 * {middle} * {middle}, fill(0.0)")
            code(f"{q}l = {self._load(code, a, '0')}")
        code("for j in range(1, k // 2 + 1):")
        for one, q in names.items():
            a = one.operands[0]
            code(f"{q}h = {self._load(code, a, 'k + 1 - j')}", 1)
            code(f"{q} = {q} + {q}l * {q}h", 1)
            code(f"{q}l = {self._load(code, a, 'j')}", 1)
            code(f"{q}n = {q}n + {q}l * {q}h", 1)
        for one, q in names.items():
            code.alias(("now", one), q)
            code.alias(("next", one), f"{q}n")

    def _skew(self, code: Code, products: list[Node]) -> None:
        """Write a_j b_{k-j} summed, and a_{j+1} b_{k-j} for the next order, all in one loop."""
        names = {one: f"q{self.products.index(one)}" for one in products}
        firsts = {one.operands[0]: f"a{i}" for i, one in enumerate(products)}
        for a, name in firsts.items():
            code(f"{name} = {self._load(code, a, '0')}")
        for q in names.values():
            code(f"{q}, {q}n = fill(0.0), fill(0.0)")
        code("for j in range(k):")
        seconds = {one.operands[1]: f"b{i}" for i, one in enumerate(products)}
        for b, name in seconds.items():
            code(f"{name} = {self._load(code, b, 'k - j')}", 1)
        for one, q in names.items():
            a, b = firsts[one.operands[0]], seconds[one.operands[1]]
            code(f"{q} = {q} + {a} * {b}", 1)
        for a, name in firsts.items():
            code(f"{name} = {self._load(code, a, 'j + 1')}", 1)
        for one, q in names.items():
            a, b = firsts[one.operands[0]], seconds[one.operands[1]]
            code(f"{q}n = {q}n + {a} * {b}", 1)
        for one, q in names.items():
            last, first = (
                code.name((x, o), self._load(code, x, o))
                for x, o in zip(one.operands, ("k", "0"), strict=True)
            )
            code(f"{q} = {q} + {last} * {first}")
            code.alias(("now", one), q)
            code.alias(("next", one), f"{q}n")

    def _value(self, code: Code, one: Node, even: bool) -> str:
        """Return the name of the coefficient of order k of a node."""
        return code.name(("value", one), lambda: self._text(code, one, even))

    def _linear(self, code: Code, one: Node, which: str) -> str:
        """Return a sum of products, each by its sum `which`: now, next or last."""
        if is_product(one):
            return code._names[which, one]
        operands = [
            self._constant(part) if part.level == CONSTANT else self._linear(code, part, which)
            for part in one.operands
        ]
        sign = {"add": "+", "sub": "-", "mul": "*"}.get(one.operation)
        return f"({operands[0]} {sign} {operands[1]})" if sign else f"(-{operands[0]})"

    def _constant(self, one: Node) -> str:
        if one in self.names.at_sites:
            row = self.names.at_sites[one]
            return f"load(system.at, {row} * system.at.shape[1] + 1 + block * LANES)"
        return self.names.constants.get(one) or repr(one.operands[0])

    def _text(self, code: Code, one: Node, even: bool) -> str:
        """Return the expression of the coefficient of order k."""
        if is_sum_of_products(one):
            if even:
                later = self._linear(code, one, "next")
                code(f"store(m, {self.partial_place(one, even)}, {later})")
                return self._linear(code, one, "now")
            return f"load(m, {self.partial_place(one, even)}) + {self._linear(code, one, 'last')}"
        if one.level == CONSTANT:
            numbers = self._constant(one)
            at_sites = one in self.names.at_sites
            return f"at_start * {numbers}" if at_sites else f"fill(at_start * {numbers})"
        if one in self.names.clocks:
            return f"fill(m[d + {self.names.clocks[one]} * (ORDER + 1) + k])"
        match one.operation, *one.operands:
            case "field", _, _, 0:
                return self._load(code, one, "k")
            case "field", component, part, by:
                place = f"{'left' if by < 0 else 'right'}{component} + {'XY'[part]}"
                side = code.name(("side", place), f"load(m, {place})")
                here = self._value(code, node("field", component, part, 0), even)
                function = SHIFTS.get(by, f"shift_{by % 8}")
                return f"{function}({f'{side}, {here}' if by < 0 else f'{here}, {side}'})"
            case "carried", _:
                return self._load(code, one, "k")
            case "neg", a:
                return f"-{self._value(code, a, even)}"
            case "mul", a, b:
                return f"{self._constant(a)} * {self._value(code, b, even)}"
            case "add" | "sub" as how, a, b:
                sign = "+" if how == "add" else "-"
                return f"{self._value(code, a, even)} {sign} {self._value(code, b, even)}"
        raise ModelError(f"{one.operation} of a field or of the time has no rule")

    def _scaled(self, code: Code, rate: Node, even: bool, shares: dict[str, str]) -> str:
        """Return the coefficient of order k of a rate, over k + 1."""

        def has_factor(one: Node) -> bool:
            return (
                one.operation == "mul"
                and one.operands[0].level == CONSTANT
                and one.operands[0] not in self.names.at_sites
                and not is_sum_of_products(one)
            )

        def terms(one: Node) -> list[Node]:
            if one.operation in ("add", "sub", "neg") and not is_sum_of_products(one):
                return [term for operand in one.operands for term in terms(operand)]
            return [one]

        if sum(not has_factor(term) for term in terms(rate)) > 1 or rate.operation == "field":
            return f"share * {self._value(code, rate, even)}"

        def write(one: Node, sign: str) -> tuple[str, str]:
            if one.operation in ("add", "sub", "neg") and not is_sum_of_products(one):
                other = {"+": "-", "-": "+"}[sign]
                if one.operation == "neg":
                    return write(one.operands[0], other)
                (s, a), (t, b) = (
                    write(one.operands[0], sign),
                    write(one.operands[1], sign if one.operation == "add" else other),
                )
                if s == "-" and t == "+":
                    return "+", f"({b} - {a})"
                return s, f"({a} {'+' if s == t else '-'} {b})"
            if has_factor(one):
                factor = f"{'-' * (sign == '-')}(share * {self._constant(one.operands[0])})"
                name = shares.setdefault(factor, f"f{len(shares)}")
                return "+", f"{name} * {self._value(code, one.operands[1], even)}"
            return sign, f"share * {self._value(code, one, even)}"

        sign, text = write(rate, "+")
        return f"-{text}" if sign == "-" else text

    # --- The whole

    def text(self, reach: int, clocks: int) -> str:
        """Return the functions that continue the series."""
        (shares, even), (_, odd) = self.body(True), self.body(False)
        size = f"{self.spare + max(0, len(self.partial) - len(self.rates))} * LANES"
        here = {0: "component", 1: "series.components - 1 - component"}
        here = here if self.alike else {c: str(c) for c in range(self.components)}
        start = "(component * series.blocks + block)" if self.alike else "block"
        begin = [
            "        for block in range(first, last):",
            f"            s = d + {clocks} * (ORDER + 1) + {start} * SPARE",
            *(f"            i{c} = block_start(series, {at}, block)" for c, at in here.items()),
            *(
                f"            left{c}, _, right{c} = sides_of(series, k, {at}, block)"
                for c, at in here.items()
            ),
        ]
        work = ["    if k % 2 == 0:", *shares, *begin, *even, "    else:", *shares, *begin, *odd]
        if self.alike:
            work = [
                "    for component in range(series.components):",
                *("    " + line for line in work),
            ]
        return "\n".join([
            f"SPARE = {size}",
            '"""Numbers of a block beside those of its fields."""',
            *(f"shift_{by} = define_shift({by})" for by in range(2, 7)), "",
            f"WORK = taylor.work_arrays(-(-(SPARE + {clocks} * (ORDER + 1)) // {self.components}))",
            "", "",
            "@inlined_by_llvm",
            "def write_next_order(system, series, k, first, last):",
            "    m, d, share = series.memory, spare_start(series), 1.0 / (k + 1)",
            "    at_start = 1.0 if k == 0 else 0.0",
            *work,
            "", "",
            "continue_in_waves = in_waves(write_next_order"
            + (f", close_widely({reach}))" if reach > 1 else ")"), "", "",
        ])  # fmt: skip


def require_alike(rates: tuple[Node, ...], kept: list[Node]) -> None:
    """Raise ModelError unless two fields move alike, and each of what is kept is of one field.

    One rule then serves both fields, and one of them alone where the two are the same.
    """

    def exchanged(one: Node, _) -> Node | None:
        if one.operation != "field":
            return None
        component, part, by = one.operands
        return node("field", 1 - component, part, by)

    mixed = any(part.operation == "field" and part.operands[0] for part in in_order(kept))
    if mixed or rebuilt(rates, exchanged) != [*rates[2:], *rates[:2]]:
        raise ModelError("the two fields do not obey the same equation with their names exchanged")


SHIFTS = {1: "right_neighbours", -1: "left_neighbours"}


# --- The module ---------------------------------------------------------------------------------


def clocks_text(parts: Parts, names: Names) -> str:
    """Return the functions that know the time: `at_time`, and the series of its functions."""
    made, series, count = [], [], len(parts.clocks)
    for i, clock in enumerate(parts.clocks):
        start = f"d + {i} * (ORDER + 1)"
        if clock.operation == "time":
            made.append(f"    k{i}, l{i} = t, 1.0")
            speed = "0.0"
        else:
            speed, phase = (names.constants.get(one) or repr(one.operands[0])
                            for one in affine(clock.operands[0]))  # fmt: skip
            pair = f"sine, {speed} * cosine"
            if clock.operation == "cos":
                pair = f"cosine, -({speed} * sine)"
            made += [f"    sine, cosine = sine_and_cosine({speed} * t + {phase})",
                     f"    k{i}, l{i} = {pair}"]  # fmt: skip
        series += [f"    value, slope = system.clocks[{i}], system.clocks[{count + i}]",
                   f"    square = {speed} * {speed}",
                   "    for k in range(ORDER + 1):",
                   f"        m[{start} + k] = value",
                   "        share = 1.0 / (k + 1)",
                   "        value, slope = share * slope, -(share * square * value)"]  # fmt: skip
    values = "".join(f"{x}{i}, " for x in "kl" for i in range(count))
    return "\n".join([
        "@kernel",
        "def at_time(system, t):",
        *made,
        f"    clocks = ({values})",
        "    others = system.at, system.wide, system.left, system.right",
        "    return System(system.constants, clocks, *others)", "", "",
        "@inlined_by_llvm",
        "def write_clocks(system, m, d):",
        *(series or ["    pass"]), "", "",
    ]) + CONTINUE.replace("    cont", WRITE_CLOCKS + "    cont")  # fmt: skip


def series_text(model: Model) -> str:
    """Return the text of the series of two fields that move alike, driven by no time.

    The system has the parameters of the model by their names.
    """
    parts = parts_of_rates(model.rates, frozenset())
    names = Names(parts)
    names.constants = {one: f"system.{one.operands[0]}" for one in parts.constants}
    series = Series(model.rates, names, alike=True).text(model.reach, 0)
    return HEAD + series + CONTINUE


def module_text(rates: tuple[Node, ...], reach: int, site_dependent: frozenset[str]) -> str:
    """Return the text of the module of a model with these rates."""
    parts = parts_of_rates(rates, site_dependent)
    names = Names(parts)
    return "".join([
        HEAD,
        rates_text(rates, names, reach),
        Series(rates, names).text(reach, len(parts.clocks)),
        clocks_text(parts, names),
    ])  # fmt: skip


@cache
def load_text(text: str) -> ModuleType:
    """Return the module of a text, kept in a file so that its kernels can be.

    numba restores a kept kernel only where it can import the modules of its parts, so the module
    has a name that follows from its text in every process.
    """
    file = keep_source("model.py", text)
    module = ModuleType(f"pendula_model_{file.parent.name}")
    sys.modules[module.__name__] = module
    exec(compile(text, str(file), "exec"), module.__dict__)
    return module
