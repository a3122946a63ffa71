"""The text of rules that write the rates of a traced model at one site or a vector of sites.

Each node of the graph becomes a statement, in the order of the trace.
"""

from collections.abc import Callable
from typing import Any

from latticode.equations.graph import MOTION, Node, in_order
from latticode.equations.model import Model
from latticode.equations.symbols import ModelError

from .statements import FunctionText, Names, inputs_of, require_exchangeable, stages_of

RULE = """
@in_one_pass
def {name}_at_site(system, states, re, j, dy):
    {unpacked}
{statements}
"""
RATES = """
write_rates = at_every_site(rates_at_site, {rows})
@inlined_by_llvm
def rates(system, y, dy):
    {prepare}{couple}
    write_rates(system, ({states},), dy)
"""
"""The rates of a state, inlined: a call in each stage would pass the system, a kilobyte of values.
With such calls, runs of dop853 on short chains took two to four times as long."""
TANGENT_RATES = """
write_tangent_rates = at_every_site(tangent_rates_at_site, {rows})
@kernel
def bundle_rates(system, bundle, slopes):
    y = bundle[:{rows}]
    rates(system, y, slopes[:{rows}])
    for first in range({rows}, bundle.shape[0], {rows}):
        w = bundle[first : first + {rows}]
        {prepare}{couple}
        write_tangent_rates(system, ({states},), slopes[first : first + {rows}])
"""

COUPLED = """
write_{name} = at_every_site({name}_at_site, {rows})
"""
"""The factors that matrices multiply. They are written at all sites before the multiplication."""
CONSERVED = """
write_densities = at_every_site(densities_at_site, {rows})
@kernel
def observe(system, y, i, record):
    {observe}(system, y, i, record)
    if record.conserved.size == 0:
        return
    sums = system.sums
    unfold(system, y, sums.wide)
    write_densities(sums, (sums.wide{at},), sums.terms)
    for k in range({rows}):
        record.conserved[k, i] = sum_from_middle(sums.terms[k])
"""


class Rule:
    """Statements that compute nodes from the fields.

    place(component, part, by) returns the text of part 0 or 1 of a field at the site n + `by`. In a
    product or sum of a number and a vector, the number comes first.
    """

    def __init__(self, names: Names, place: Callable[[int, int, int], str]) -> None:
        self.code, self.names, self.place = FunctionText(1), names, place

    def value(self, expression: Node) -> str:
        """Return the name of a node's value; the first call for a node writes its statements."""
        return self.code.name(expression, lambda: self._text(expression))

    def is_scalar(self, expression: Node) -> bool:
        """Return whether a value is one number for all sites."""
        return expression.level < MOTION and not any(
            node in self.names.at_sites for node in in_order([expression])
        )

    def _text(self, expression: Node) -> str:
        if expression in self.names.at_sites:
            return f"at[{self.names.at_sites[expression]}, j]"
        if expression in self.names.clocks:
            return self.names.clocks[expression]
        if expression in self.names.constants or expression.operation == "number":
            return self.names.constant(expression)
        match expression.operation, *expression.operands:
            case "field", component, part, by:
                return self.place(component, part, by)
            case "couple", *_:
                return f"coupled[{self.names.couples[expression]}, j]"
            case "neg", a:
                return f"-{self.value(a)}"
            case "mul", a, b:
                a, b = (b, a) if self.is_scalar(b) else (a, b)
                factor = self._factor if a.level == b.level == MOTION else self.value
                return f"{factor(a)} * {factor(b)}"
            case "add" | "sub" as how, a, b:
                return self._sum(a, b, "+" if how == "add" else "-")
            case "sin" | "cos" as which, a:
                both = self.code.name(("both", a), lambda: f"sine_and_cosine({self.value(a)})")
                return f"{both}[{int(which == 'cos')}]"
            case "div", a, b if self.is_scalar(b) and not self.is_scalar(a):
                return f"(1.0 / {self.value(b)}) * {self.value(a)}"
            case "div", a, b:
                return f"{self.value(a)} / {self.value(b)}"
            case "where", condition, a, b:
                return f"select_positive({', '.join(map(self.value, (condition, a, b)))})"
            case "exp", a:
                return f"exponential({self.value(a)})"
            case "log" | "sqrt" as which, a:
                name = {"log": "logarithm", "sqrt": "root"}[which]
                return f"{name}_and_inverse({self.value(a)})[0]"
        raise ModelError(f"{expression.operation} of a field or of time is not supported")

    def _factor(self, expression: Node) -> str:
        """Return the name of a product's factor, with zero for tiny numbers (see `rest`)."""
        return self.code.name(
            ("factor", expression), lambda: f"zero_below(TINY, {self.value(expression)})"
        )

    def _sum(self, a: Node, b: Node, sign: str) -> str:
        first, second = self.value(a), self.value(b)
        if self.is_scalar(b) and not self.is_scalar(a):
            return f"{sign.replace('+', '')}{second} + {first}"
        return f"{first} {sign} {second}"

    def write(self, rows: list[str], rates: tuple[Node, ...]) -> str:
        """Return the statements that write rates to rows; a scalar rate is written at all sites."""
        values = [self.value(rate) for rate in rates]
        for c, (row, rate, value) in enumerate(zip(rows, rates, values, strict=True)):
            row_of_field = (c // 2, c % 2) if not self.names.couples else (0, 0)
            spread = f" + 0.0 * {self.place(*row_of_field, 0)}" if self.is_scalar(rate) else ""
            self.code(f"dy[{row}, j] = {value}{spread}")
        return "\n".join(self.code.lines)


class ExactRule(Rule):
    """A rule without thresholds, because values may be expressions of another program."""

    def _factor(self, expression: Node) -> str:
        return self.value(expression)


def rates_text(rates: tuple[Node, ...], names: Names, reach: int) -> str:
    """Return the text of the functions that write the rates of a state, one row for each rate."""
    wide, at = reach > 1, bool(names.at_sites)
    arguments = names, reach, ("y",), len(rates) // 2
    states = ("system.wide" if wide else "y") + ", system.at" * at
    states += ", system.couplings.products" * bool(names.couples)
    rules, couple = _coupling("rates", stages_of(rates), states, 1, *arguments)
    return (
        rules
        + _rule_of_rows("rates", rates, *arguments)
        + RATES.format(
            rows=len(rates),
            prepare="widen(system, y, system.wide)" if wide else "close(system, y)",
            couple=couple,
            states=states,
        )
    )


def tangents_text(tangent: Model, names: Names) -> str:
    """Return the text of the functions that write the rates of a solution and tangent vectors.

    One array, the bundle, has the rows of the solution, then as many rows for each tangent vector.
    `tangent` is the model that `Model.tangent` returns. The functions take a system of this model.
    """
    rows = len(tangent.rates) // 2
    wide, at = tangent.reach > 1, bool(names.at_sites)
    arguments = names, tangent.reach, ("y", "w"), rows // 2
    states = f"system.wide[:{rows}], system.wide[{rows}:]" if wide else "y, w"
    states += ", system.at" * at + ", system.couplings.products" * bool(names.couples)
    known = {expression for stage in stages_of(tangent.rates[:rows]) for expression in stage}
    stages = [
        [expression for expression in stage if expression not in known]
        for stage in stages_of(tangent.rates[rows:])
    ]
    rules, couple = _coupling("tangent_rates", stages, states, 2, *arguments)
    return (
        rates_text(tangent.rates[:rows], names, tangent.reach)
        + rules
        + _rule_of_rows("tangent_rates", tangent.rates[rows:], *arguments)
        + TANGENT_RATES.format(
            rows=rows,
            prepare=f"widen(system, w, system.wide[{rows}:])" if wide else "close(system, w)",
            couple=couple,
            states=states,
        )
    )


def _coupling(
    name: str, stages: list[list[Node]], states: str, indent: int, names: Names, *arguments: Any
) -> tuple[str, str]:
    """Return the rules that write the factors of matrices, and the statements that multiply them.

    The factors of each stage depend on the products of earlier stages.
    """
    rules, lines = [], []
    for stage, couples in enumerate(stages):
        rule = f"{name}_factors_{stage}"
        rows = [names.couples[expression] for expression in couples]
        factors = tuple(expression.operands[1] for expression in couples)
        if not factors:
            continue
        rules.append(_rule_of_rows(rule, factors, names, *arguments, rows=rows))
        rules.append(COUPLED.format(name=rule, rows=len(names.couples)))
        lines.append(f"write_{rule}(system, ({states},), system.couplings.factors)")
        for row, expression in zip(rows, couples, strict=True):
            matrix = names.matrices[expression.operands[0].operands[0]]
            arrays = f"system.couplings.factors[{row}], system.couplings.products[{row}]"
            lines.append(f"multiply_by_matrix(system.couplings, {matrix}, {arrays}, 1)")
    return "".join(rules), "".join(f"\n{'    ' * indent}{line}" for line in lines)


def densities_text(
    densities: tuple[Node, ...], names: Names, reach: int, fields: int, observe: str
) -> str:
    """Return the text of a function that calls the one named `observe` and stores density sums."""
    rule = _rule_of_rows("densities", densities, names, reach, ("y",), fields)
    at = ", sums.at" * bool(names.at_sites)
    return rule + CONSERVED.format(rows=len(densities), observe=observe, at=at)


def _rule_of_rows(
    name: str,
    rates: tuple[Node, ...],
    names: Names,
    reach: int,
    states: tuple[str, ...],
    fields: int,
    rows: list[int] | None = None,
) -> str:
    """Return the text of the rule that writes rates at a site to `rows`, by default the first ones.

    `fields` is the number of fields in each of the `states`.
    """
    offset = reach - 1

    def place(component: int, re_im: int, by: int) -> str:
        by += offset
        state, row = states[component // fields], 2 * (component % fields) + re_im
        return f"{state}[{row}, j{f' {by:+d}' if by else ''}]"

    rows = list(range(len(rates))) if rows is None else rows
    statements = Rule(names, place).write([str(row) for row in rows], rates)
    arrays = [*states, *["at"] * bool(names.at_sites), *["coupled"] * bool(names.couples)]
    unpacked = ", ".join(arrays)
    return RULE.format(name=name, unpacked=f"{unpacked}, = states", statements=statements)


def rule_text(rates: tuple[Node, ...], states: tuple[str, ...]) -> str:
    """Return the text of the rule that writes the rates of one of two exchangeable fields.

    `rates` contains the four rates of both fields. Each of the `states` contains both fields, or
    one if they are equal. The parameters are attributes of the system.
    """
    require_exchangeable(rates)
    rows = [["re", "re + 1"], ["other", "other + 1"]]

    def place(component: int, re_im: int, by: int) -> str:
        state, row = states[component // 2], rows[component % 2][re_im]
        return f"{state}[{row}, j{f' {by:+d}' if by else ''}]"

    names = Names(inputs_of(rates, frozenset()), by_name=True)
    statements = Rule(names, place).write(rows[0], rates[:2])
    partner = f"other = {states[0]}.shape[0] - 2 - re"
    unpacked = f"{', '.join(states)}, = states\n    {partner}"
    return RULE.format(name="rates", unpacked=unpacked, statements=statements)
