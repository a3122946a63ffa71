"""Functions of what stands at another site, next to each kind of end, against plain NumPy."""

import numpy as np
import pytest
from latticode.equations.ends import ENDS
from latticode.equations.model import Model, ModelError, shift
from latticode.equations.symbols import LONGEST_SHIFT
from latticode.simulation.problem import Problem
from latticode.simulation.simulate import simulate
from numpy_lattice import slope_of, solution, traced

MOVING = "lap(b) + 0.2 * b.left * b.right + 0.1"
"""A rate that sees neighbours, and that is not odd in the fields as antiperiodic ends are."""
FORMS = {
    "quotient": "a / (1 + abs2(b.left))",
    "exponential": "a * exp(b.left.real) - exp(1j * shift(b, 3).imag)",
    "sine": "a * sin(b.left.real - a.real) + cos(shift(b, -2).imag)",
    "power": "a * (2 + b.right.real) ** 1.5",
    "root": "a * sqrt(1 + abs2(b.left)) / log(3 + b.right.real)",
}


def largest_error(rates, boundary, solver, half_width=5):
    """Return the largest error at t = 1 of a model with the fields a and b, from random data."""
    text = f"def i_dt(p, a, b):\n    return {rates}\n"
    model = Model(fields=("a", "b"), parameters={}, i_dt=traced(text)["i_dt"], text=text)
    sites = 2 * half_width + 1
    start = np.random.default_rng(1).normal(size=(2, sites, 2)) @ (0.4, 0.4j)
    problem = Problem(
        model=model,
        half_width=half_width,
        boundary=boundary,
        initial=start,
        end_time=1.0,
        output_step=1.0,
        solver={"name": solver, "rtol": 1e-12, "atol": 1e-12},
    )
    expected = solution(slope_of(text, {}, boundary, 2, "i_dt"), start.ravel(), 1.0)
    return np.abs(simulate(problem).final.ravel() - expected).max()


@pytest.mark.parametrize("form", FORMS)
def test_taylor_knows_a_function_of_a_neighbour_next_to_every_end(form):
    errors = {
        boundary: largest_error(f"{FORMS[form]}, {MOVING}", boundary, "taylor") for boundary in ENDS
    }
    assert max(errors.values()) < 1e-10, errors


@pytest.mark.parametrize("solver", ["taylor", "dop853"])
def test_the_farthest_look_is_that_of_every_solver(solver):
    rates = "shift(b, 7) + abs2(shift(shift(b, -4).left, -2)) * a, shift(a.right, -7) + lap(b)"
    errors = {boundary: largest_error(rates, boundary, solver, half_width=9) for boundary in ENDS}
    assert max(errors.values()) < 1e-10, errors


@pytest.mark.parametrize("by", [LONGEST_SHIFT + 1, -LONGEST_SHIFT - 1])
def test_a_look_that_is_too_far_is_refused_with_a_way_out(by):
    expected = "a neighbour 8 sites away; the limit is 7, .* with separate fields for even"
    with pytest.raises(ModelError, match=expected):
        Model(fields="u", parameters={}, i_dt=lambda p, u: shift(u.right, by - 1) + u)


@pytest.mark.parametrize("by", [1.5, "a", None])
def test_a_shift_by_no_whole_number_is_refused(by):
    with pytest.raises(ModelError, match="requires an integer m, such as 2, not"):
        Model(fields="u", parameters={}, i_dt=lambda p, u: shift(u, by))
