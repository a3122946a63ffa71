"""A survey in a configuration: what it may say, and the words for what it may not."""

import numpy as np
import pytest
from latticode import notebook
from latticode.configuration.files import ConfigurationError
from latticode.configuration.schema import load
from latticode.datasets.surveys import make_survey
from latticode.equations.model import Model, abs2, lap
from latticode.simulation.problem import Problem

CHAIN = Model(
    fields="u", parameters={"c": 1.0, "exponent": 0}, i_dt=lambda p, u: p.c * lap(u) + abs2(u) * u
)
CASES = {"mine": {"model": CHAIN, "half_width": 5, "initial": {0: [1], 1: [0.5]}, "end_time": 5}}


def loaded(**survey):
    return load({"cases": CASES, "surveys": {"map": {"case": "mine", **survey}}})


def test_a_survey_is_read_with_its_grids_and_whole_numbers():
    axes = {"c": {"first": 0, "last": 1, "points": 5}, "half_width": [2, 4], "initial.1.0": ["1j"]}
    settings = loaded(axes=axes, members={"count": 3, "size": 0.1, "seed": 1}, keep=["exponent"])
    plan = settings.surveys["map"].plan
    assert plan.axes == {
        "c": [0.0, 0.25, 0.5, 0.75, 1.0],
        "half_width": [2, 4],
        "initial.1.0": [1j],
    }
    assert plan.shape == (5, 2, 1, 3)
    assert settings.plain_survey("map")["members"]["count"] == 3
    full, tenth = settings.cost_of_survey("map"), settings.cost_of_survey("map", 10)
    assert tenth.seconds == pytest.approx(full.seconds / 10)


def test_what_varies_together_is_the_last_axis():
    plan = loaded(axes={"half_width": [2, 4]}, together={"c": [1, 1], "initial.0.0": [1, "2j"]})
    plan = plan.surveys["map"].plan
    assert plan.axes == {"half_width": [2, 4], "c, initial.0.0": [(1.0, 1.0), (1.0, 2j)]}
    assert loaded(together={"c": [1, 2]}).surveys["map"].plan.axes == {"c": [1.0, 2.0]}


@pytest.mark.parametrize(
    ("survey", "message"),
    [
        ({}, "surveys.map.axes: is empty, and there are no members"),
        ({"case": "mien", "axes": {"c": [1]}}, "there is no case 'mien'; did you mean 'mine'"),
        ({"axes": {"d": [1]}}, "surveys.map.axes: 'd' cannot be varied; give one of c, exp"),
        ({"axes": {"initial.2.0": [1]}}, "has no initial value: SITE is one of 0, 1, and"),
        ({"axes": {"initial.0.1": [1]}}, "FIELD one of 0..0"),
        ({"axes": {"c": []}}, "surveys.map.axes.c: is empty; give at least 1"),
        ({"axes": {"c": [1, 1.0]}}, "the same value is given twice"),
        ({"axes": {"c": {"first": 0, "last": 1, "points": 1}}}, "it must be at least 2"),
        ({"axes": {"half_width": [0, 3]}}, "surveys.map.axes: at half_width = 0"),
        ({"axes": {"half_width": [1, 0, 3]}}, "surveys.map.axes: at half_width = 0"),
        ({"together": {"c": [1, 1, 1], "half_width": [3, 0, 4]}}, "axes: at c = 1, half_width = 0"),
        ({"together": {"c": [1], "half_width": [1, 2]}}, "together: has 1 of c, 2 of half_width"),
        ({"axes": {"c": [1]}, "together": {"c": [1]}}, "together: varies c, which is listed"),
        ({"together": {"d": [1]}}, "surveys.map.together: 'd' cannot be varied"),
        ({"axes": {"end_time": [1, 1.01]}}, "at end_time = 1.01, end_time: 1.01 is not a whole"),
        ({"axes": {"exponent": [1]}, "keep": ["exponent"]}, "keep: exponent is an axis too"),
        ({"axes": {"c": [1]}, "keep": ["max_l3"]}, "keep.0: is 'max_l3'; give one of max_l2"),
        ({"axes": {"c": [1]}, "window": [2, 1]}, r"\[2, 1\] must satisfy 0 <= start < end"),
        ({"axes": {"c": [1]}, "window": [2, 9]}, "ends at 9, after the shortest run, which ends"),
        ({"members": {"count": 3, "size": 0.1, "seed": 1, "kind": "odd"}}, "give one of even, un"),
        ({"members": {"count": 10**8, "size": 0.1, "seed": 1}}, "0 runs; at most 10000000 are"),
        (
            {"axes": {"end_time": [500]}, "members": {"count": 10**7, "size": 0.1, "seed": 1}},
            "limits.hours allows 1 h",
        ),
    ],
)
def test_what_a_survey_may_not_say(survey, message):
    with pytest.raises(ConfigurationError, match=message):
        loaded(**survey)


FUNCTIONS = {
    "a defect at the left end": lambda n: (n == n.min()) * 1.0,
    "a defect two sites left of the centre": lambda n: (n == -2) * 1.0,
    "one number for each length": lambda n: 0.1 * n.size,
}


def driven(at):
    """Return a chain of half-width 4 which is driven where a function of the sites says so."""
    model = Model(
        fields="u",
        parameters={"force": 0.1, "at": at},
        i_dt=lambda p, u: lap(u) + abs2(u) * u + 1j * p.force * p.at,
    )
    return notebook.Case(model=model, half_width=4, initial={0: [0.1]}, end_time=3)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_function_is_evaluated_on_the_sites_of_each_run_of_a_survey(name):
    case, half_widths = driven(FUNCTIONS[name]), [3, 4, 6]
    surveyed = notebook.survey(case, {"half_width": half_widths}, keep=["final_l2"])
    alone = [notebook.simulate(case.changed(half_width=m)) for m in half_widths]
    expected = [run["l2"].values[:, -1] for run in alone]
    np.testing.assert_array_equal(surveyed["final_l2"], expected)
    assert '"6": {"at":' in surveyed.attrs["parameters_by_half_width"]


def test_a_survey_of_a_file_evaluates_functions_on_the_sites_of_each_run():
    case = driven(lambda n: (n == n.min()) * 1.0)
    asked = {"case": "mine", "keep": ["final_l2"]}
    asked["together"] = {"force": [0.1, 0.2], "half_width": [3, 6]}
    settings = load({"cases": {"mine": case}, "surveys": {"ends": asked}})
    problem = Problem.of(settings.surveyed_problem("ends"))
    variables, _ = make_survey("ends", problem, settings.plain_survey("ends")).make()
    alone = case.changed(half_width=6, parameters={"force": 0.2})
    assert variables["final_l2"].values[1] == notebook.simulate(alone)["l2"].values[0, -1]


def test_values_on_an_axis_take_the_place_of_a_function():
    case = driven(lambda n: (n == 0) * 1.0)
    surveyed = notebook.survey(case, {"half_width": [3, 6], "at": [0.5]}, keep=["final_l2"])
    alone = notebook.simulate(case.changed(half_width=6, parameters={"at": 0.5}))
    assert surveyed["final_l2"].values[1, 0] == alone["l2"].values[0, -1]
