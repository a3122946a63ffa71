"""Until when printed lines contain the true curves, by proofs and by references."""

import numpy as np
import pytest
import xarray as xr
from pendula.drawing import strips, style
from pendula.studies.certified.lines import contain_curves

TAU = np.linspace(0.0, 2.0, 81)


ATTRIBUTES = {
    "case": "made_up", "epsilon": 1.0, "gamma": 1.0, "half_width": 30, "boundary": "dirichlet",
    "initial": '{"0": [1.0, 0.1]}', "output_step": 0.025, "solver": "ode45",
}  # fmt: skip


def curve(omega, **more):
    norm = xr.DataArray(
        np.array([1.0 + 0.1 * np.sin(TAU), 0.5 + 0.1 * np.cos(omega * TAU)]),
        {"component": ["A", "B"], "tau": TAU},
        ("component", "tau"),
        attrs={"long_name": "norm", "units": "1"},
    )
    return xr.Dataset(
        {"linf": norm, "l2": 1.5 * norm, **more}, attrs={**ATTRIBUTES, "omega": omega}
    )


def certified(omega):
    return curve(omega, bound=("tau", np.full(TAU.size, 1e-11), {"long_name": "", "units": "1"}))


def test_a_line_contains_its_curve_until_it_leaves_it_and_what_is_not_proved_is_not_known():
    half = strips.half_line(1.65)
    leaving = curve(8.0).copy(deep=True)
    leaving["l2"].loc[{"component": "A", "tau": slice(1.0, None)}] += 1.01 * half
    runs, references = {"one": leaving, "two": curve(-4.0)}, {"one": curve(8.0), "two": curve(-4.0)}
    found = contain_curves(runs, {"one": certified(8.0)}, {}, references)
    until = found["contained_until"]
    assert float(until.sel(case="one", norm="l2", component="A")) == TAU[TAU < 1.0][-1]
    assert float(until.sel(case="one", norm="l2", component="B")) == TAU[-1]
    assert until.sel(case="two").isnull().all()
    assert (found["measured_until"].sel(case="two") == TAU[-1]).all()


@pytest.mark.parametrize(
    ("proof", "reference"),
    [
        (certified(-4.0), curve(-4.0)),
        # within a billionth of tau a curve moves further than its bound
        (certified(8.0).assign_coords(tau=TAU + 1e-10), curve(-4.0)),
    ],
    ids=["another case", "other times"],
)
def test_a_curve_of_another_case_or_at_other_times_proves_nothing(proof, reference):
    found = contain_curves({"one": curve(8.0)}, {}, {"one": proof}, {"one": reference})
    assert found["contained_until"].isnull().all() and found["measured_until"].isnull().all()


def test_no_panel_is_higher_than_the_width_of_a_line_takes_it_for():
    cases = [curve(8.0), curve(-4.0)]
    strip = strips.Strip("", "one run")
    figure, drawn = strips.draw_cases(cases, [[strip], [strip]])
    with style._style():
        figure.canvas.draw()
    for axes in (axes for grid in drawn for axes in grid.flat):
        assert axes.get_window_extent().height / figure.dpi <= strips.HIGHEST
        top = axes.get_ylim()[1]
        height = 72.0 * axes.get_window_extent().height / figure.dpi
        (line,) = {line.get_linewidth() for line in axes.get_lines()}
        assert strips.half_line(top / strips.HEADROOM) < 0.5 * line / height * top
