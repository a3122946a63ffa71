"""The page and the figure of a localised state of a user's own case."""

import pytest
from latticode import abs2, lap
from latticode.checks import check_breather
from pendula import Case, Model, draw_breather
from pendula.own_cases import answers
from pendula.problem import Problem

CUBIC = Model(fields="u", parameters={}, i_dt=lambda p, u: 0.3 * lap(u) + abs2(u) * u)


def problem(model, data, half_width=10, end_time=1.0):
    """Return the problem of data (field, ...) on site 0."""
    case = Case(model=model, initial={0: data}, half_width=half_width, end_time=end_time)
    return Problem.of(case.problem(output_step=end_time))


@pytest.mark.parametrize(
    ("model", "data", "said"),
    [
        (CUBIC, [1.5], "turns at the frequency 1."),
        (CUBIC, [0.1], "but reaches the ends of the chain"),
        (CUBIC, [0], "the chain is at rest"),
    ],
)  # fmt: skip
def test_the_page_and_the_figure_say_what_is_found(model, data, said):
    found = check_breather(problem(model, data))
    assert said in answers.localised(found)
    figure = draw_breather(found.assign(divergence_time=1.0))
    assert len(figure.axes) == (2 if "breather" in found else 0)
