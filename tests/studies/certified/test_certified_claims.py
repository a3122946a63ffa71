"""Claims on certified curves and printed lines, each fed a right and a wrong case."""

import numpy as np
import pytest
import xarray as xr
from helpers import verdict_of
from pendula.drawing import strips, style
from pendula.ledger.claim import evaluate
from pendula.studies.certified.claims_curves import EIGHT, MINUS_FOUR, WRONG
from pendula.studies.certified.figures import draw_curves, gather_curves
from pendula.studies.certified.lines import contain
from pendula.studies.certified.regular import PARTS

TAU = np.linspace(0.0, 2.0, 81)
MODULE = "certified/claims_curves"


def attributes(omega):
    return {
        "case": "made_up", "omega": omega, "epsilon": 1.0, "gamma": 1.0, "half_width": 30,
        "boundary": "dirichlet", "initial": '{"0": [1.0, 0.1]}', "output_step": 0.025,
        "solver": "ode45",
    }  # fmt: skip


def curve(omega, off=0.0, **more):
    norm = xr.DataArray(
        np.array([1.0 + 0.1 * np.sin(TAU), 0.5 + 0.1 * np.cos(omega * TAU)]) + off,
        {"component": ["A", "B"], "tau": TAU},
        ("component", "tau"),
        attrs={"long_name": "norm", "units": "1"},
    )
    return xr.Dataset({"linf": norm, "l2": 1.5 * norm, **more}, attrs=attributes(omega))


def certified(omega, bound=1e-11):
    parts = np.full((len(PARTS), TAU.size), bound / len(PARTS))
    named = {"long_name": "made up", "units": "1"}
    return curve(
        omega,
        bound=("tau", np.full(TAU.size, bound), named),
        bound_parts=(("bound_part", "tau"), parts, named),
        bound_part=("bound_part", list(PARTS), named),
        reference_distance=("tau", np.full(TAU.size, 1e-15), named),
    )


@pytest.fixture
def sources():
    return {
        EIGHT: certified(8.0),
        MINUS_FOUR: certified(-4.0),
        WRONG: certified(-4.0, 1e-6),
        "trajectories/fig2_small": curve(8.0, 1e-7),
        "trajectories/fig3_small": curve(-4.0, 1e-7),
    }


def test_all_hold_where_they_should_and_every_control_is_refused(sources):
    rows = evaluate(sources, None, (MODULE,))
    assert {row["verdict"] for row in rows} == {"confirmed"} and len(rows) == 1
    assert all(control["passes"] for row in rows for control in row["controls"])


@pytest.mark.parametrize(
    ("name", "source", "change"),
    [
        ("curves_certified", EIGHT, lambda one: one.assign(bound=1e3 * one["bound"])),
        ("curves_certified", EIGHT, lambda one: one.assign(bound=one["bound"] + 0.01)),
        ("curves_certified", "trajectories/fig2_small", lambda one: one + 0.01),
    ],
)
def test_a_wrong_number_is_refused(sources, name, source, change):
    with xr.set_options(keep_attrs=True):
        changed = change(sources[source])
    assert verdict_of(name, {**sources, source: changed}, MODULE) == "not reproduced"


def test_a_line_contains_its_curve_until_it_leaves_it_and_what_is_not_proved_is_not_known():
    half = strips.half_line(1.65)
    leaving = curve(8.0).copy(deep=True)
    leaving["l2"].loc[{"component": "A", "tau": slice(1.0, None)}] += 1.01 * half
    found = contain({"one": leaving, "two": curve(-4.0)}, {"one": certified(8.0)}, {
        "one": curve(8.0), "two": curve(-4.0),
    })  # fmt: skip
    until = found["contained_until"]
    assert float(until.sel(case="one", norm="l2", component="A")) == TAU[TAU < 1.0][-1]
    assert float(until.sel(case="one", norm="l2", component="B")) == TAU[-1]
    assert until.sel(case="two").isnull().all()
    assert (found["measured_until"].sel(case="two") == TAU[-1]).all()


def test_a_curve_of_another_case_proves_nothing():
    found = contain({"one": curve(8.0)}, {"one": certified(-4.0)}, {"one": curve(-4.0)})
    assert found["contained_until"].isnull().all() and found["measured_until"].isnull().all()


def test_a_bound_at_another_time_proves_nothing():
    """Within a billionth of tau a curve moves further than its bound."""
    late = certified(8.0).assign_coords(tau=TAU + 1e-10)
    found = contain({"one": curve(8.0)}, {"one": late}, {"one": curve(8.0)})
    assert found["contained_until"].isnull().all()


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


def test_the_figure_shows_the_bound_and_all_its_parts():
    data = gather_curves([certified(8.0), certified(-4.0).assign_attrs(case="other")])
    figure = draw_curves(data)
    assert len(figure.axes) == 2
    assert all(len(axes.get_lines()) == 2 + len(PARTS) for axes in figure.axes)
