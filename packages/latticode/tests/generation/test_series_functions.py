"""The coefficients of functions of power series, computed by the text of their rules."""

from math import cos, exp, log, sin, sqrt

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from latticode.equations.graph import leaf, node
from latticode.generation.series_functions import members, write_function
from latticode.generation.statements import FunctionText
from numpy.polynomial import polynomial

ORDER = 16
ARGUMENT = leaf(0, 0, 1)
FUNCTIONS = {
    "fill": float,
    "sine_and_cosine": lambda x: (sin(x), cos(x)),
    "exponential": exp,
    "logarithm_and_inverse": lambda x: (log(x), 1.0 / x),
    "root_and_inverse": lambda x: (sqrt(x), 1.0 / sqrt(x)),
}
DIRECT = {
    "sin": np.sin,
    "cos": np.cos,
    "exp": np.exp,
    "div": lambda s: 1.0 / s,
    "log": np.log,
    "sqrt": np.sqrt,
}


def function_of_argument(name):
    return node(name, node("number", 1.0), ARGUMENT) if name == "div" else node(name, ARGUMENT)


def coefficients(name, argument):
    """Return the coefficients of a function of the series `argument`, all orders one by one."""
    function = function_of_argument(name)
    places = {member: f"row{i}" for i, member in enumerate([ARGUMENT, *members(function)])}
    rows = {place: np.zeros(ORDER + 1) for place in places.values()} | {"row0": argument}
    for k in range(ORDER + 1):
        code = FunctionText(0)
        write_function(
            code,
            function,
            lambda member, order: f"{places[member]}[{order}]",
            lambda member, text: f"{places[member]}[k] = {text}",
            even=k % 2 == 0,
        )
        exec("\n".join(code.lines), {**FUNCTIONS, **rows, "k": k})
    return rows[places[function]]


series = st.lists(st.floats(-1, 1), min_size=ORDER, max_size=ORDER)


@pytest.mark.parametrize("name", DIRECT)
@given(first=st.floats(1, 3), higher=series)
def test_the_sum_of_the_series_is_the_function_of_the_sum(name, first, higher):
    """On a circle around zero, where the terms that are left out are below rounding."""
    argument = np.array([first, *higher])
    z = 0.04 * np.exp(2j * np.pi * np.arange(8) / 8)
    value = polynomial.polyval(z, coefficients(name, argument))
    expected = DIRECT[name](polynomial.polyval(z, argument))
    np.testing.assert_allclose(value, expected, rtol=1e-14, atol=1e-14)
