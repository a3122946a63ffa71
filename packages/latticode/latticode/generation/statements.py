"""Statements of generated kernels, and the names of the numbers that these take from outside."""

from collections.abc import Callable, Iterable
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
        """Let a value have a name, or an expression, that exists."""
        self._names[key] = name

    def known(self, key) -> str:
        """Return the name of a value that has one."""
        return self._names[key]


class ModelInputs(NamedTuple):
    """What the kernels of a model take from outside: constants and functions of the time."""

    constants: tuple[Node, ...]  # one number each
    at_sites: tuple[Node, ...]  # one number a site each
    clocks: tuple[Node, ...]  # sines and cosines of the time, and the time itself
    couples: tuple[Node, ...] = ()  # products of a matrix, each after those that it is made of


def inputs_of(nodes: Iterable[Node], site_dependent: frozenset[str]) -> ModelInputs:
    """Return the largest expressions of parameters alone, and the functions of time."""
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
    """Return the products of a matrix in expressions, by how many stand inside one another.

    Those of a stage are made of earlier ones alone.
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
    """Return whether an expression has a parameter with a value for each site."""
    return any(leaf.operands[0] in site_dependent for leaf in leaves_in([expression], "parameter"))


def is_clock(expression: Node, site_dependent: frozenset[str]) -> bool:
    """Return whether a node is a sine or cosine of the time that is the same at all sites, and
    whose angle grows steadily."""
    if expression.level != CLOCK or expression.operation not in ("sin", "cos"):
        return False
    angle = expression.operands[0]
    return affine(angle)[0].level == CONSTANT and not depends_on_site(angle, site_dependent)


def affine(angle: Node) -> tuple[Node, Node]:
    """Return frequency and phase of an angle that grows steadily with the time."""
    time = node("time")
    frequency = derivative([angle], lambda expression: number(expression is time))[0]
    phase = rebuilt([angle], lambda expression, _: ZERO if expression is time else None)[0]
    return frequency, phase


class Names:
    """How numbers that do not depend on the fields are called in the text of a module.

    Where `by_name`, all are parameters or clocks that the system has by their names.
    """

    def __init__(self, inputs: ModelInputs, by_name: bool = False):
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
        """Return the text of a number, or of an expression of parameters alone."""
        return self.constants.get(expression) or repr(expression.operands[0])


def require_exchangeable(rates: Iterable[Node], stored: Iterable[Node] = ()) -> None:
    """Raise ModelError unless two fields move alike, and each of what is kept is of one field.

    One rule then serves both fields, and one of them alone where the two are the same. There may
    be several states of the two.
    """

    def exchanged(leaf: Node, _) -> Node | None:
        if leaf.operation != "field":
            return None
        component, *place = leaf.operands
        return node("field", component ^ 1, *place)

    first, second = list(rates)[:2], list(rates)[2:]
    mixed = any(leaf.operands[0] for leaf in leaves_in(stored, "field"))
    if mixed or rebuilt(first, exchanged) != second:
        raise ModelError("the two fields do not obey the same equation with their names exchanged")
