"""A dataset states what its job was given, as attributes that netCDF can hold."""

import numpy as np
import pytest
from dimers import dimers
from latticode.datasets.stated import stated

CONSTANTS = {"epsilon": 1.0, "gamma": 0.5, "omega": -4.0}


@pytest.mark.parametrize(
    ("arguments", "attributes"),
    [
        ({"seed": 3, "window": None}, {"seed": 3}),
        ({"constants": CONSTANTS}, CONSTANTS),
        ({"solver": {"name": "ode45", "rtol": 1e-6}}, {"solver": "ode45", "solver_rtol": 1e-6}),
        ({"sizes": [3, 9], "is": True}, {"sizes": "[3, 9]", "is": "true"}),
        ({"pair": (1 + 2j, 0.5)}, {"pair": '["(1+2j)", 0.5]'}),
        ({"grid": np.arange(2.0)}, {"grid": "[0.0, 1.0]"}),
        ({"between": {"a": [1, 2]}}, {"between": '{"a": [1, 2]}'}),
        ({"ends": {0.2: 1, 0.1: 2}}, {"ends": '{"0.2": 1, "0.1": 2}'}),
    ],
)
def test_arguments_become_numbers_and_text(arguments, attributes):
    assert stated(arguments, (), [], make) == attributes | {"computed_by": f"{__name__}.make"}


def test_several_problems_state_what_they_share_once_and_the_rest_by_name():
    problems = {name: dimers(boundary=ends) for name, ends in (("a", "free"), ("b", "periodic"))}
    computed = stated({"problems": problems}, (), ["checks/a", "checks/b"], make)
    assert computed["half_width"] == 8 and "boundary" not in computed
    assert computed["problems"] == '{"a": {"boundary": "free"}, "b": {"boundary": "periodic"}}'
    assert computed["computed_from"] == "checks/a, checks/b"
    assert "problems" not in stated({"problems": problems}, ("boundary",), [], make)


def make():
    """Stand for the function of a job."""
