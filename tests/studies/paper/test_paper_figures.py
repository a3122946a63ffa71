"""Figures 2 to 6 and the pictures beside them."""

import made_up_chaos
import numpy as np
import pytest
from pendula.drawing import style
from pendula.studies.paper import figures, solvers


@pytest.fixture(scope="module")
def panels(gathered):
    """Return the axes by strip and norm: a run alone, and a run above two strips."""
    return np.reshape(figures.draw_norms(gathered["norms"]).axes, (4, 2))


@pytest.fixture
def ensembles():
    """Return an ensemble of fig4_large alone."""
    return made_up_chaos.ensembles().isel(case=[1])


def test_gather_returns_what_the_trajectories_hold(make_trajectory):
    small, large = make_trajectory(), make_trajectory(scale=5.0)
    data = figures.gather_norms([small, large], [small, small])
    for name in ("linf", "l2"):
        assert (data[name].sel(initial_size="small") == small[name]).all()
        assert (data[name].sel(initial_size="large") == large[name]).all()


def test_panels_stand_as_in_the_paper(gathered, panels):
    data = gathered["norms"]
    for row, size in ((0, "small"), (1, "large")):
        for column, name in enumerate(["linf", "l2"]):
            lines = panels[row, column].get_lines()
            drawn = [lines[-2:], lines[:2]][row]  # the small run lies above its reference
            assert [line.get_color() for line in drawn] == [style.RED, style.BLUE]
            for line, component in zip(drawn, ["A", "B"], strict=True):
                expected = data[name].sel(initial_size=size, component=component)
                assert np.array_equal(line.get_ydata(), expected)


def test_axes_say_what_they_show(panels):
    assert [axes.get_ylabel() for axes in panels[0]] == [r"$\ell^\infty$ norm", r"$\ell^2$ norm"]
    assert [axes.get_xlabel() for axes in panels[-1]] == [r"$\tau$"] * 2
    titled = [axes.get_title("left") for axes in panels[[0, 1]].flat]
    assert [r"\Omega = 8" in title for title in titled] == [True, True, False, False]
    labels = [row[0].texts[0].get_text() for row in panels]
    assert "ode45; the reference lies under it" in labels[0] and "one run" in labels[1]
    assert "reference" in labels[2] and "3 runs" in labels[3]


def test_no_curve_leaves_its_panel(panels):
    for axes in panels.flat:
        low, high = axes.get_ylim()
        curves = [line.get_ydata() for line in axes.get_lines() if len(line.get_ydata()) == 11]
        values = np.concatenate(curves)
        assert len(curves) >= 2 and low <= values.min() and values.max() <= high


def test_where_a_run_leaves_its_reference_both_stand_apart_and_a_line_shows_when(make_trajectory):
    run, true = make_trajectory(), make_trajectory()
    true["l2"][0, 4:] *= 1.5
    figure = figures.draw_norms(figures.gather_norms([run, run], [true, run]))
    assert len(figure.axes) == 6
    for axes in figure.axes[:4]:
        assert axes.get_lines()[2].get_xdata()[0] == 2.0
    assert np.array_equal(figure.axes[3].get_lines()[0].get_ydata(), true["l2"].sel(component="A"))
    for axes in figure.axes[4:]:
        assert len(axes.get_lines()) == 4  # and no line: the reference lies under the run


def test_the_legend_names_what_is_seen_alone(make_trajectory):
    run, true = make_trajectory(), make_trajectory()
    true["l2"][0, 4:] *= 1.5
    for reference, entries in ((run, ["$A$", "$B$"]), (true, ["$A$", "$B$", figures.DIVERGED])):
        figure = figures.draw_norms(figures.gather_norms([run, run], [reference, run]))
        assert [text.get_text() for text in figure.legends[0].get_texts()] == entries


def test_a_band_is_drawn_from_the_ensemble_of_its_case(make_trajectory, ensembles):
    runs = [make_trajectory(), make_trajectory("fig4_large", omega=0.0, scale=5.0)]
    data = figures.gather_norms(runs, runs, ensembles)
    small, large = (data.sel(initial_size=size) for size in figures.SIZES)
    assert small["band_l2"].isnull().all() and int(large["members"]) == 3
    expected = ensembles["l2"].isel(case=0).sel(quantity="B", quantile=0.95)
    assert np.array_equal(large["band_l2"].sel(component="B", quantile=0.95), expected)


def test_the_line_stands_where_the_dataset_of_horizons_says(make_trajectory):
    run, true = make_trajectory(), make_trajectory()
    true["l2"][0, 4:] *= 1.5
    drawn = figures.gather_norms([run, run], [true, run])["divergence_time"]
    runs = {(name, "ode45"): run for name in figures.SIZES}
    horizons = solvers.trust(runs, {"small": true, "large": run})["horizon"]
    stored = horizons.sel(level="visible", solver="ode45")
    assert np.array_equal(drawn, stored) and list(drawn) == [2.0, np.inf]


def test_another_case_than_the_reference_stands_alone(make_trajectory):
    run, other = make_trajectory(), make_trajectory(omega=7.0)
    data = figures.gather_norms([run, run], [other, other])
    assert data["true_l2"].isnull().all() and data["divergence_time"].isnull().all()


def test_runs_of_different_lengths_are_drawn_whole(make_trajectory):
    pair = [make_trajectory(), make_trajectory(end_time=7.0)]
    figure = figures.draw_norms(figures.gather_norms(pair, pair))
    ends = [axes.get_lines()[2].get_xdata()[-1] for axes in figure.axes]
    assert [axes.get_xlim()[1] for axes in figure.axes] == ends
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


def test_bars_are_the_mean_and_deviation_of_the_ensemble_of_the_same_sweep(make_sweep):
    sweeps = [make_sweep(case="fig5_left"), make_sweep(0.0, "fig5_right")]
    ensembles = made_up_chaos.ensembles()
    data = figures.gather_sweeps(*sweeps, "[10, 70]", "[10, 40]", ensembles=ensembles)
    assert data["l2_mean"].sel(panel="left").isnull().all()
    at = {"quantity": "pair", "statistic": "mean", "window": "[10, 40]"}
    expected = ensembles.sel(sweep="fig5_right", **at)
    bars = data.sel(panel="right", reading="caption").dropna("half_width")
    assert np.array_equal(bars["half_width"], ensembles["half_width"])
    for name in ("l2_mean", "l2_deviation", "linf_mean"):
        assert np.array_equal(bars[name], expected[name])
    left, right = figures.draw_sweeps(data).axes
    drawn = [segment for bars in right.collections for segment in bars.get_segments()]
    low, high = expected["l2_mean"] - expected["l2_deviation"], expected["l2_mean"] * 1.1
    assert [list(segment[:, 1]) for segment in drawn[2:4]] == [
        pytest.approx([float(a), float(b)]) for a, b in zip(low, high, strict=True)
    ]
    assert not left.collections


def test_every_axis_of_norms_starts_at_zero_and_ends_above_its_marks(gathered):
    for name, draw in (("norms", figures.draw_norms), ("sweeps", figures.draw_sweeps)):
        for axes in draw(gathered[name]).axes:
            low, high = axes.get_ylim()
            assert low == 0.0 and high > 1.05 * axes.dataLim.ymax


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
