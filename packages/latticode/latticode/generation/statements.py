"""Statements of generated kernels, and the names of their inputs: constants, clocks, matrices."""

from collections.abc import Callable, Hashable, Iterable
from typing import NamedTuple

from latticode.equations.graph import (
    CLOCK,
    CONSTANT,
    ZERO,
    Node,
    derivative,
    in_order,
    is_number,
    leaves_in,
    node,
    number,
    rebuilt,
)
from latticode.equations.symbols import ModelError


class FunctionText:
    """Statements of a function. Each value has a name, so that none is computed twice."""

    def __init__(self, indent: int) -> None:
        self.lines: list[str] = []
        self.indent, self._names = indent, {}

    def __call__(self, text: str, deeper: int = 0) -> None:
        """Append a line, indented by `deeper` more levels."""
        self.lines.append("    " * (self.indent + deeper) + text)

    def name(self, key: Hashable, text: Callable[[], str] | str) -> str:
        """Return the name of a value; the first call appends the statement that computes it."""
        if key not in self._names:
            text = text if isinstance(text, str) else text()
            self._names[key] = f"v{len(self._names)}"
            self(f"{self._names[key]} = {text}")
        return self._names[key]

    def alias(self, key: Hashable, name: str) -> None:
        """Set the name of a value to an existing name or an expression."""
        self._names[key] = name

    def known(self, key: Hashable) -> str:
        """Return the name of a value; KeyError if it has none."""
        return self._names[key]


class ModelInputs(NamedTuple):
    """The inputs of a model's kernels: numbers independent of fields, and matrix products."""

    constants: tuple[Node, ...]  # one number each
    at_sites: tuple[Node, ...]  # a number for each site
    clocks: tuple[Node, ...]  # time, and sines and cosines of time
    couples: tuple[Node, ...] = ()  # products with a matrix, in order of evaluation


def inputs_of(nodes: Iterable[Node], site_dependent: frozenset[str]) -> ModelInputs:
    """Return the inputs of expressions; constants are the largest parts without time and fields."""
    constants, at_sites, clocks = {}, {}, {}

    def visit(expression: Node) -> None:
        if expression.level == CONSTANT:
            if not is_number(expression):
                (at_sites if depends_on_site(expression, site_dependent) else constants)[
                    expression
                ] = None
        elif expression.operation in ("time", "clock"):
            clocks[expression] = None
        elif is_clock(expression, site_dependent):
            clocks[expression] = None
            for coefficient in affine(expression.operands[0]):
                visit(coefficient)
        else:
            for operand in expression.inputs:
                visit(operand)

    nodes = list(nodes)
    for expression in nodes:
        visit(expression)
    couples = [expression for expression in in_order(nodes) if expression.operation == "couple"]
    return ModelInputs(tuple(constants), tuple(at_sites), tuple(clocks), tuple(couples))


def stages_of(nodes: Iterable[Node]) -> list[list[Node]]:
    """Return the products with a matrix, grouped into stages by their depth of nesting.

    Each product depends only on products of earlier stages.
    """
    depth: dict[Node, int] = {}
    for expression in in_order(nodes):
        depth[expression] = max((depth[a] for a in expression.inputs), default=0) + (
            expression.operation == "couple"
        )
    couples = [expression for expression in depth if expression.operation == "couple"]
    last = max((depth[expression] for expression in couples), default=0)
    return [
        [expression for expression in couples if depth[expression] == stage]
        for stage in range(1, last + 1)
    ]


def depends_on_site(expression: Node, site_dependent: frozenset[str]) -> bool:
    """Return whether an expression contains a parameter with a value for each site."""
    return any(leaf.operands[0] in site_dependent for leaf in leaves_in([expression], "parameter"))


def is_clock(expression: Node, site_dependent: frozenset[str]) -> bool:
    """Return whether a node is a sine or cosine of one angle for all sites, linear in time."""
    if expression.level != CLOCK or expression.operation not in ("sin", "cos"):
        return False
    angle = expression.operands[0]
    return affine(angle)[0].level == CONSTANT and not depends_on_site(angle, site_dependent)


def affine(angle: Node) -> tuple[Node, Node]:
    """Return the frequency and phase of an angle that is linear in time."""
    time = node("time")
    frequency = derivative([angle], lambda expression: number(expression is time))[0]
    phase = rebuilt([angle], lambda expression, _: ZERO if expression is time else None)[0]
    return frequency, phase


class Names:
    """The names of a model's inputs in the text of a module.

    With `by_name`, all inputs are attributes of the system: parameters or clocks.
    """

    def __init__(self, inputs: ModelInputs, by_name: bool = False) -> None:
        def named(group: str, nodes: tuple[Node, ...]) -> dict[Node, str]:
            return {
                expression: f"system.{expression.operands[0] if by_name else f'{group}[{i}]'}"
                for i, expression in enumerate(nodes)
            }

        self.constants = named("constants", inputs.constants)
        self.clocks = named("clocks", inputs.clocks)
        self.at_sites = {expression: i for i, expression in enumerate(inputs.at_sites)}
        self.couples = {expression: i for i, expression in enumerate(inputs.couples)}
        matrices = sorted({leaf.operands[0] for leaf in leaves_in(inputs.couples, "matrix")})
        self.matrices = {name: i for i, name in enumerate(matrices)}

    def constant(self, expression: Node) -> str:
        """Return the text of a number, or of an expression that depends only on parameters."""
        return self.constants.get(expression) or repr(expression.operands[0])


def require_exchangeable(rates: Iterable[Node], stored: Iterable[Node] = ()) -> None:
    """Raise ModelError unless an exchange of the two fields in all states exchanges their rates.

    One rule then gives the rates of both fields. `stored` nodes may depend only on the first field.
    """

    def exchanged(leaf: Node, _: list[Node]) -> Node | None:
        if leaf.operation != "field":
            return None
        component, *place = leaf.operands
        return node("field", component ^ 1, *place)

    first, second = list(rates)[:2], list(rates)[2:]
    mixed = any(leaf.operands[0] for leaf in leaves_in(stored, "field"))
    if mixed or rebuilt(first, exchanged) != second:
        raise ModelError(
            "the two fields are not exchangeable: the equation of the second must be that of the"
            " first with their names exchanged"
        )
