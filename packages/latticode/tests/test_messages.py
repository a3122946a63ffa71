"""Wrong inputs of a stranger: each is answered by its key and the way out."""

import numpy as np
import pytest
import xarray as xr
from latticode import (
    Case,
    ConfigurationError,
    DatasetError,
    Model,
    ModelError,
    abs2,
    draw_survey,
    lap,
    read,
    save,
    simulate,
    sin,
    survey,
)

DNLS = Model(fields="u", parameters={"a": 1.0}, i_dt=lambda p, u: p.a * lap(u) + abs2(u) * u)
CASE = Case(model=DNLS, initial={0: [1.5]}, half_width=4, end_time=1)
COMPLEX = xr.Dataset({"z": ("n", np.array([1j, 2]))})


def set_end_time():
    CASE.end_time = 5


@pytest.mark.parametrize(
    ("call", "error", "words"),
    [
        (lambda: draw_survey(simulate(CASE)), ConfigurationError, "expected a survey from `surv"),
        (
            lambda: simulate(CASE.changed(half_width=10**7)),
            ConfigurationError,
            "raise it by the argument gigabytes",
        ),
        (
            lambda: Model(fields="u", parameters={}, i_dt=lambda t, u: sin(t) * u),
            ModelError,
            "the first argument of the function is the parameters: write (p, ...)",
        ),
        (
            lambda: survey(CASE, {"a": [np.ones(9), np.zeros(9)]}),
            ConfigurationError,
            "1 error:\n  surveys.survey.axes.a: has a list where each run needs one number",
        ),
        (lambda: read("nothere.nc"), DatasetError, "nothere.nc is missing: "),
        (set_end_time, ConfigurationError, "case.changed(end_time=5) returns a changed copy"),
        (
            lambda: CASE.changed(solver="rk4"),
            ConfigurationError,
            "give one of taylor, dop853, ode45, crank_nicolson, auto",
        ),
        (lambda: save("z.nc", COMPLEX), DatasetError, "save z.real and z.imag"),
        (lambda: save("z.nc", COMPLEX["z"]), DatasetError, "it by data.to_dataset(name=...)"),
        (lambda: survey(CASE, ["a"]), ConfigurationError, "axes: is ['a'], not a mapping of"),
        (lambda: survey(CASE, {"a": [1]}, keep=[]), ConfigurationError, "keep: is empty"),
        (lambda: survey(CASE, {"a": [1]}, window=3), ConfigurationError, "is 3, not a pair"),
        (
            lambda: survey(CASE, {"a": [1]}, keep=[lambda problem, run: 1]),
            ConfigurationError,
            "keep: a function is stored under its name, and this one has none",
        ),
        (lambda: CASE.changed(model=None), ConfigurationError, "model: is empty; give a Model"),
        (lambda: CASE.changed(model=abs2), ConfigurationError, "give a Model, or the path of"),
    ],
)
def test_a_wrong_input_is_answered_by_the_way_out(call, error, words):
    with pytest.raises(error) as raised:
        call()
    assert words in str(raised.value)


def test_a_power_of_a_number_is_taken_to_a_parameter():
    decays = Model(fields="u", parameters={"a": 3.0}, i_dt=lambda p, u: 2**-p.a * u)
    final = simulate(Case(model=decays, initial={0: [1]}, half_width=1, end_time=1))["final"]
    re, im = final.sel(site=0, component="u").values
    assert abs(re + 1j * im - np.exp(-1j / 8)) < 1e-14


def test_a_model_shows_its_fields_its_parameters_and_its_equations():
    text = repr(DNLS)
    assert text.startswith("Model model: fields u; a = 1.0\n")
    assert "i_dt=lambda p, u: p.a * lap(u) + abs2(u) * u" in text
