"""Figures 2 to 6 and the pictures beside them."""

import numpy as np
import pytest
from pendula.drawing import style
from pendula.studies.paper import figures


@pytest.fixture(scope="module")
def panels(gathered):
    return np.reshape(figures.draw_norms(gathered["norms"]).axes, (2, 2))


def test_gather_returns_what_the_trajectories_hold(make_trajectory):
    small, large = make_trajectory(), make_trajectory(scale=5.0)
    data = figures.gather_norms([small, large], [small, small])
    for name in ("linf", "l2"):
        assert (data[name].sel(initial_size="small") == small[name]).all()
        assert (data[name].sel(initial_size="large") == large[name]).all()


def test_panels_stand_as_in_the_paper(gathered, panels):
    data = gathered["norms"]
    for row, size in enumerate(["small", "large"]):
        for column, name in enumerate(["linf", "l2"]):
            lines = panels[row, column].get_lines()[2:4]  # above the true ones
            assert [line.get_color() for line in lines] == [style.RED, style.BLUE]
            for line, component in zip(lines, ["A", "B"], strict=True):
                expected = data[name].sel(initial_size=size, component=component)
                assert np.array_equal(line.get_ydata(), expected)


def test_axes_say_what_they_show(panels):
    assert [axes.get_ylabel() for axes in panels[0]] == [r"$\ell^\infty$ norm", r"$\ell^2$ norm"]
    assert [axes.get_xlabel() for axes in panels[1]] == [r"$\tau$"] * 2
    assert all(r"\Omega = 8" in axes.get_title("left") for axes in panels.flat)


def test_no_curve_leaves_its_panel(gathered, panels):
    for axes in panels.flat:
        low, high = axes.get_ylim()
        values = np.concatenate([line.get_ydata() for line in axes.get_lines()[:4]])
        assert low <= values.min() and values.max() <= high


def test_true_curves_lie_below_and_a_mark_shows_where_they_part(make_trajectory):
    run, true = make_trajectory(), make_trajectory()
    true["l2"][0, 4:] *= 1.5
    figure = figures.draw_norms(figures.gather_norms([run, run], [true, run]))
    for axes, expected in zip(figure.axes, [2.0, 2.0, np.inf, np.inf], strict=True):
        assert np.array_equal(axes.get_lines()[4].get_xdata(), [expected], equal_nan=True)
    lines = figure.axes[1].get_lines()
    assert np.array_equal(lines[0].get_ydata(), true["l2"].sel(component="A"))
    assert lines[0].get_zorder() <= lines[2].get_zorder()


def test_another_case_than_the_reference_stands_alone(make_trajectory):
    run, other = make_trajectory(), make_trajectory(omega=7.0)
    data = figures.gather_norms([run, run], [other, other])
    assert data["true_l2"].isnull().all() and data["divergence_time"].isnull().all()


def test_runs_of_different_lengths_are_drawn_whole(make_trajectory):
    pair = [make_trajectory(), make_trajectory(end_time=7.0)]
    figure = figures.draw_norms(figures.gather_norms(pair, pair))
    ends = [axes.get_lines()[2].get_xdata()[-1] for axes in figure.axes]
    assert ends == [5.0, 5.0, 7.0, 7.0]


def test_spacetime_shows_the_moduli_site_by_site(gathered, make_trajectory):
    figure = figures.draw_spacetime(gathered["spacetime"])
    images = [axes.images[0] for axes in figure.axes if axes.images]
    modulus = make_trajectory()["modulus"]
    for image, component in zip(images[:2], ["A", "B"], strict=True):
        assert np.array_equal(image.get_array(), modulus.sel(component=component))
        assert (image.origin, image.get_extent()) == ("lower", [-0.5, 5.5, -2.5, 2.5])
        assert image.get_clim() == (0, float(modulus.max()))
    titles = [axes.get_title("left") for axes in figure.axes[:4]]
    assert [title[:7] for title in titles] == ["$|A_n|$", "$|B_n|$"] * 2


def test_gather_reads_the_window_and_statistic_of_text_and_caption(make_sweep):
    sweep = make_sweep()
    data = figures.gather_sweeps(sweep, sweep, "[10, 70]", "[10, 40]").sel(panel="left")
    for name in ("l2", "linf"):
        pair = sweep[name].sel(quantity="pair")
        text = pair.sel(statistic="max", window="[10, 70]")
        caption = pair.sel(statistic="mean", window="[10, 40]")
        assert np.array_equal(data[name].sel(reading="text"), text)
        assert np.array_equal(data[name].sel(reading="caption"), caption)


def test_a_window_that_no_sweep_has_is_refused(make_sweep):
    with pytest.raises(KeyError):
        figures.gather_sweeps(make_sweep(), make_sweep(), "[10, 60]", "[10, 40]")


def test_dots_are_red_and_blue_filled_and_hollow(gathered):
    data = gathered["sweeps"]
    for axes, panel in zip(figures.draw_sweeps(data).axes, ["left", "right"], strict=True):
        dots = iter(axes.get_lines())
        for name, colour in (("l2", style.RED), ("linf", style.BLUE)):
            for reading, face in (("text", colour), ("caption", "white")):
                line = next(dots)
                assert np.array_equal(
                    line.get_ydata(), data[name].sel(panel=panel, reading=reading)
                )
                assert (line.get_color(), line.get_markerfacecolor()) == (colour, face)


def test_one_norm_alone_can_be_drawn(make_sweep):
    data = figures.gather_sweeps(make_sweep(), make_sweep(), "[10, 70]", "[10, 40]", norms=["l2"])
    assert [len(axes.get_lines()) for axes in figures.draw_sweeps(data).axes] == [2, 2]


def test_sweeps_over_different_half_widths_keep_all_their_dots(make_sweep):
    left, right = make_sweep(), make_sweep().assign_coords(half_width=[7, 10, 300])
    figure = figures.draw_sweeps(figures.gather_sweeps(left, right, "[10, 70]", "[10, 40]"))
    drawn = [list(axes.get_lines()[0].get_xdata()) for axes in figure.axes]
    assert drawn == [[5, 10, 20], [7, 10, 300]]


def test_panels_name_omega(gathered):
    titles = [axes.get_title("left") for axes in figures.draw_sweeps(gathered["sweeps"]).axes]
    assert [r"\Omega = -4" in titles[0], r"\Omega = 0" in titles[1]] == [True, True]
