"""The figures of one's own cases and sweeps."""

import numpy as np
import pytest
from latticode.drawing import style
from pendula.own_cases import figures


@pytest.fixture
def diverging(make_trajectory):
    """Return a run that a second one leaves at tau = 2."""
    second = make_trajectory(scale=1.02)[["linf", "l2"]]
    checks = second.rename(linf="second_linf", l2="second_l2").assign(divergence_time=2.0)
    return figures.draw_norms(figures.gather_norms(make_trajectory(), checks))


def test_the_second_run_stands_below_the_first_where_they_diverge(diverging, make_trajectory):
    grid = np.reshape(diverging.axes, (2, 2))
    for row, run in zip(grid, [make_trajectory(), make_trajectory(scale=1.02)], strict=True):
        for axes, name in zip(row, ["linf", "l2"], strict=True):
            lines = axes.get_lines()
            assert [line.get_color() for line in lines[:2]] == [style.RED, style.BLUE]
            for line, component in zip(lines[:2], ["A", "B"], strict=True):
                assert np.array_equal(line.get_ydata(), run[name].sel(component=component))
            assert lines[2].get_xdata()[0] == 2.0
    assert [axes.get_xlabel() for axes in grid[1]] == [r"$\tau$"] * 2


def test_titles_say_every_parameter(diverging):
    left, right = diverging.axes[:2]
    for sign, value in {r"\Omega": 8, r"\gamma": 1, r"\epsilon": 1, "M": 2}.items():
        assert f"${sign} = {value}$" in left.get_title("left")
    assert right.get_title("left") == "$(A_{0}, B_{0}) = (1, 0.1)$,  ends at rest"


@pytest.mark.parametrize("initial", ['{"-12": [1.234567, "-0.3456789+0.456789j"]}', "{}"])
def test_titles_stay_within_their_panels(make_trajectory, initial):
    run = make_trajectory(omega=-12.34567).assign_attrs(initial=initial, gamma=0.12345)
    drawn = [
        figures.draw_norms(figures.gather_norms(run)),
        figures.draw_spacetime(figures.gather_spacetime(run)),
    ]
    for figure in drawn:
        assert figure.get_tightbbox().x1 <= figure.bbox_inches.x1


@pytest.mark.parametrize(("output_step", "few"), [(0.0039, False), (0.004, True)])
def test_a_caption_says_where_outputs_are_too_few_for_pendula(make_trajectory, output_step, few):
    """At mu = 0.1, omega = 0 an eighth of the period of an angle is pi / 800 = 0.00393 in tau."""
    attributes = {"model": "pendula", "mu": 0.1, "omega": 0.0, "output_step": output_step}
    run = make_trajectory().assign_attrs(attributes)
    assert ("shorter output_step" in figures.gather_norms(run).attrs["caption"]) == few
