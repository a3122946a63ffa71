"""Properties of the rates of a model: reflection symmetry, analyticity, power series."""

from typing import Any

import numpy as np

from .graph import (
    MOTION,
    ZERO,
    Node,
    add,
    derivative,
    evaluate,
    in_order,
    leaf,
    leaves_in,
    node,
    number,
    rebuilt,
    sub,
    switches,
)

Rates = tuple[Node, ...]


def are_even(rates: Rates) -> bool:
    """Return whether exchanging left and right changes no bit of the rates."""

    def ordered(entry: Node, operands: list[Node]) -> Node | None:
        return node("add", *sorted(operands, key=id)) if entry.operation == "add" else None

    def reflected(entry: Node, operands: list[Node]) -> Node | None:
        if entry.operation == "field":
            return leaf(*entry.operands[:-1], -entry.operands[-1])
        return ordered(entry, operands)

    return rebuilt(rates, reflected) == rebuilt(rates, ordered)


def continue_real_equations(rates: Rates) -> bool:
    """Return whether complex rates only extend equations of real fields, such as x' = x y.

    The criterion: real data stay real, the equations are nonlinear, and the rates are analytic in
    the fields (Cauchy-Riemann equations), so they contain no conjugate.
    """
    draw = np.random.default_rng(1).uniform(0.5, 1.5, 1000)
    leaves = leaves_in(rates, "field")
    weights = {
        (c, by): number(draw[i]) for i, (c, _, by) in enumerate(entry.operands for entry in leaves)
    }

    def along(re_im: int) -> list[Node]:
        return derivative(
            rates,
            lambda entry: (
                weights[entry.operands[::2]]
                if entry.operation == "field" and entry.operands[1] == re_im
                else ZERO
            ),
        )

    real, imaginary = along(0), along(1)
    real_rates = rebuilt(
        rates[1::2],
        lambda entry, _: ZERO if entry.operation == "field" and entry.operands[1] else None,
    )
    odd = [sub(a, b) for a, b in zip(real[::2], imaginary[1::2], strict=True)]
    odd += [add(a, b) for a, b in zip(real[1::2], imaginary[::2], strict=True)]
    return bool(leaves_in(real, "field")) and all(map(vanishes, [*real_rates, *odd]))


def stay_at_rest(rates: Rates) -> bool:
    """Return whether the rates of a chain at rest, with all fields zero, are zero at all times."""
    at_rest = rebuilt(rates, lambda entry, _: ZERO if entry.operation == "field" else None)
    return all(map(vanishes, at_rest))


def why_no_series(rates: Rates) -> str:
    """Return the reason why solutions have no power series, "" if they have one.

    For a real field x, |x| = sqrt(x * x) has a kink at x = 0. A power series would continue |x|
    beyond the kink as x or as -x.
    """
    if switches(rates):
        return "has max, abs, sign or where, which have no power series where they switch"
    roots = (entry for entry in in_order(rates) if entry.operation == "sqrt")
    if any(root.level == MOTION and _is_sum_of_squares(*root.operands) for root in roots):
        return "has a root of squares, such as |x|, which has no power series at 0"
    return ""


def _is_sum_of_squares(term: Node) -> bool:
    match term.operation, *term.operands:
        case "mul", a, b:
            return a is b or any(
                factor.level < MOTION and _is_sum_of_squares(square)
                for factor, square in ((a, b), (b, a))
            )
        case "div", a, b:
            return b.level < MOTION and _is_sum_of_squares(a)
        case "add", a, b:
            return _is_sum_of_squares(a) and _is_sum_of_squares(b)
    return False


def vanishes(entry: Node) -> bool:
    """Return whether an expression is zero up to rounding, tested with random leaf values."""
    if entry is ZERO:
        return True
    rng = np.random.default_rng(2017)
    drawn: dict[Node, Any] = {}

    def value(leaf: Node) -> Any:
        if leaf.operation == "number":
            return leaf.operands[0]
        shape = (8, 8) if leaf.operation == "matrix" else 8
        return drawn.setdefault(leaf, rng.uniform(0.5, 1.5, shape))

    return bool(np.abs(evaluate([entry], value)[0]).max() < 1e-12)
