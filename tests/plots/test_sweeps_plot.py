"""Figures 5 and 6."""

import numpy as np
import pytest
from pendula.drawing import style
from pendula.studies.paper import figures_sweeps as sweeps


def test_gather_reads_the_window_and_statistic_of_text_and_caption(make_sweep):
    sweep = make_sweep()
    data = sweeps.gather(sweep, sweep, "[10, 70]", "[10, 40]").sel(panel="left")
    for name in ("l2", "linf"):
        pair = sweep[name].sel(quantity="pair")
        text = pair.sel(statistic="max", window="[10, 70]")
        caption = pair.sel(statistic="mean", window="[10, 40]")
        assert np.array_equal(data[name].sel(reading="text"), text)
        assert np.array_equal(data[name].sel(reading="caption"), caption)


def test_a_window_that_no_sweep_has_is_refused(make_sweep):
    with pytest.raises(KeyError):
        sweeps.gather(make_sweep(), make_sweep(), "[10, 60]", "[10, 40]")


def test_dots_are_red_and_blue_filled_and_hollow(gathered):
    data = gathered["sweeps"]
    for axes, panel in zip(sweeps.draw(data).axes, ["left", "right"], strict=True):
        dots = iter(axes.get_lines())
        for name, colour in (("l2", style.RED), ("linf", style.BLUE)):
            for reading, face in (("text", colour), ("caption", "white")):
                line = next(dots)
                assert np.array_equal(
                    line.get_ydata(), data[name].sel(panel=panel, reading=reading)
                )
                assert (line.get_color(), line.get_markerfacecolor()) == (colour, face)


def test_one_norm_alone_can_be_drawn(make_sweep):
    data = sweeps.gather(make_sweep(), make_sweep(), "[10, 70]", "[10, 40]", norms=["l2"])
    assert [len(axes.get_lines()) for axes in sweeps.draw(data).axes] == [2, 2]


def test_sweeps_over_different_half_widths_keep_all_their_dots(make_sweep):
    left, right = make_sweep(), make_sweep().assign_coords(half_width=[7, 10, 300])
    figure = sweeps.draw(sweeps.gather(left, right, "[10, 70]", "[10, 40]"))
    drawn = [list(axes.get_lines()[0].get_xdata()) for axes in figure.axes]
    assert drawn == [[5, 10, 20], [7, 10, 300]]


def test_panels_name_omega(gathered):
    titles = [axes.get_title("left") for axes in sweeps.draw(gathered["sweeps"]).axes]
    assert [r"\Omega = -4" in titles[0], r"\Omega = 0" in titles[1]] == [True, True]
