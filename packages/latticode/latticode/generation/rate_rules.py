"""The text of rules that write the rates of a traced model at one site, or at a vector of sites.

Every node of the graph is a statement, in the order of the trace.
"""

from collections.abc import Callable

from latticode.equations.graph import MOTION, Node, in_order
from latticode.equations.model import Model
from latticode.equations.symbols import ModelError

from .statements import Code, Names, parts_of, require_alike

RULE = """
@inlined_by_llvm
def {name}_at_site(system, states, re, j, dy):
    {given}
{statements}
"""
RATES = """
write_rates = at_every_site(rates_at_site, {rows})
@kernel
def rates(system, y, dy):
    {prepare}
    write_rates(system, ({states},), dy)
"""
TANGENT_RATES = """
write_tangent_rates = at_every_site(tangent_rates_at_site, {rows})
@kernel
def bundle_rates(system, bundle, slopes):
    y = bundle[:{rows}]
    rates(system, y, slopes[:{rows}])
    for first in range({rows}, bundle.shape[0], {rows}):
        w = bundle[first : first + {rows}]
        {prepare}
        write_tangent_rates(system, ({states},), slopes[first : first + {rows}])
"""

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
    """Statements that compute nodes from the fields; place(component, part, by) is one of a field.

    A plain number stands first in a product or a sum, since it may stand there beside a vector.
    """

    def __init__(self, names: Names, place: Callable[[int, int, int], str]):
        self.code, self.names, self.place = Code(1), names, place

    def value(self, one: Node) -> str:
        """Return the name of a value, whose statements are written where they are not yet."""
        return self.code.name(one, lambda: self._text(one))

    def is_scalar(self, one: Node) -> bool:
        """Return whether a value is one number for all sites."""
        return one.level < MOTION and not any(
            part in self.names.at_sites for part in in_order([one])
        )

    def _text(self, one: Node) -> str:
        if one in self.names.at_sites:
            return f"at[{self.names.at_sites[one]}, j]"
        if one in self.names.clocks:
            return self.names.clocks[one]
        if one in self.names.constants or one.operation == "number":
            return self.names.constant(one)
        match one.operation, *one.operands:
            case "field", component, part, by:
                return self.place(component, part, by)
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
        raise ModelError(f"{one.operation} of a field or of the time has no rule")

    def _factor(self, one: Node) -> str:
        """Return the name of a factor of a product, which is zero where it is tiny: see `rest`."""
        return self.code.name(("factor", one), lambda: f"zero_below(TINY, {self.value(one)})")

    def _sum(self, a: Node, b: Node, sign: str) -> str:
        first, second = self.value(a), self.value(b)
        if self.is_scalar(b) and not self.is_scalar(a):
            return f"{sign.replace('+', '')}{second} + {first}"
        return f"{first} {sign} {second}"

    def write(self, rows: list[str], rates: tuple[Node, ...]) -> str:
        """Return the statements that write rates to rows; one number becomes that of all sites."""
        found = [self.value(rate) for rate in rates]
        for c, (row, rate, value) in enumerate(zip(rows, rates, found, strict=True)):
            spread = f" + 0.0 * {self.place(c // 2, c % 2, 0)}" if self.is_scalar(rate) else ""
            self.code(f"dy[{row}, j] = {value}{spread}")
        return "\n".join(self.code.lines)


def rates_text(rates: tuple[Node, ...], names: Names, reach: int) -> str:
    """Return the functions that write the rates of a state, one row of it for each of `rates`."""
    wide, at = reach > 1, bool(names.at_sites)
    rule = _rule_of_rows("rates", rates, names, reach, ("y",), len(rates) // 2)
    return rule + RATES.format(
        rows=len(rates),
        prepare="widen(system, y, system.wide)" if wide else "close(system, y)",
        states=("system.wide" if wide else "y") + ", system.at" * at,
    )


def tangents_text(tangent: Model, names: Names) -> str:
    """Return the functions that write the rates of a bundle: of a solution and its tangent vectors.

    All have as many rows as the solution, and lie one after the other. `tangent` is what
    `Model.tangent` returns, with whose rates a system is made.
    """
    rows = len(tangent.rates) // 2
    wide, at = tangent.reach > 1, bool(names.at_sites)
    given = tangent.rates[rows:], names, tangent.reach, ("y", "w"), rows // 2
    rule = _rule_of_rows("tangent_rates", *given)
    states = f"system.wide[:{rows}], system.wide[{rows}:]" if wide else "y, w"
    return (
        rates_text(tangent.rates[:rows], names, tangent.reach)
        + rule
        + TANGENT_RATES.format(
            rows=rows,
            prepare=f"widen(system, w, system.wide[{rows}:])" if wide else "close(system, w)",
            states=states + ", system.at" * at,
        )
    )


def densities_text(
    densities: tuple[Node, ...], names: Names, reach: int, fields: int, observe: str
) -> str:
    """Return the function `observe` that keeps the sums of densities beside what another keeps."""
    rule = _rule_of_rows("densities", densities, names, reach, ("y",), fields)
    at = ", sums.at" * bool(names.at_sites)
    return rule + CONSERVED.format(rows=len(densities), observe=observe, at=at)


def _rule_of_rows(
    name: str, rates: tuple[Node, ...], names: Names, reach: int, states: tuple[str, ...],
    fields: int,
) -> str:  # fmt: skip
    """Return the rule that writes all rates at a site; each of `states` has so many fields."""
    offset = reach - 1

    def place(component: int, part: int, by: int) -> str:
        by += offset
        state, row = states[component // fields], 2 * (component % fields) + part
        return f"{state}[{row}, j{f' {by:+d}' if by else ''}]"

    statements = Rule(names, place).write([str(row) for row in range(len(rates))], rates)
    given = ", ".join([*states, *["at"] * bool(names.at_sites)])
    return RULE.format(name=name, given=f"{given}, = states", statements=statements)


def rule_text(rates: tuple[Node, ...], states: tuple[str, ...]) -> str:
    """Return the rule for two fields that move alike, or for one where they are the same.

    `rates` are those of the four rows; the fields are two of each of `states`. The system has the
    parameters by their names.
    """
    require_alike(rates)
    rows = [["re", "re + 1"], ["other", "other + 1"]]

    def place(component: int, part: int, by: int) -> str:
        state, row = states[component // 2], rows[component % 2][part]
        return f"{state}[{row}, j{f' {by:+d}' if by else ''}]"

    names = Names(parts_of(rates, frozenset()), by_name=True)
    statements = Rule(names, place).write(rows[0], rates[:2])
    other = f"other = {states[0]}.shape[0] - 2 - re"
    given = f"{', '.join(states)}, = states\n    {other}"
    return RULE.format(name="rates", given=given, statements=statements)
