"""The stability chart, the growth rates and the bounds."""

import numpy as np
import pytest
from made_up_checks import chart, short_chart, threshold
from pendula.studies.theory import bounds_figure, figures


def labelled(axes):
    return {line.get_label(): line for line in axes.get_lines()}


def test_chart_marks_the_papers_points_and_both_thresholds(gathered):
    figure = figures.draw_chart(gathered["stability_chart"])
    long, short, _ = figure.axes[:3]
    lines = labelled(long)
    marks = lines["the paper's figures"]
    assert set(zip(*marks.get_data(), strict=True)) == {(-4.0, 1.0), (0.0, 1.0), (8.0, 1.0)}
    infinite = lines[r"$\gamma_0$ of the infinite chain"].get_ydata()
    np.testing.assert_allclose(lines["threshold of the finite chain"].get_ydata(), infinite + 0.1)
    assert [axes.get_title(loc="left") for axes in (long, short)] == [
        "$N = 21$ sites, Dirichlet ends",
        "$N = 5$ sites, Dirichlet ends",
    ]


def test_chart_shows_each_measured_rate_in_its_cell(gathered):
    figure = figures.draw_chart(gathered["stability_chart"])
    for axes, cells in zip(figure.axes, (chart(), short_chart()), strict=False):
        (image,) = axes.collections
        shown = np.asarray(image.get_array()).reshape(cells["measured"].T.shape)
        np.testing.assert_allclose(shown, cells["measured"].T)


def test_chart_draws_a_line_for_each_chain(gathered):
    share = figures.draw_chart(gathered["stability_chart"]).axes[2]
    assert [line.get_label() for line in share.get_lines()] == ["$N = 5$", "$N = 11$", "$N = 21$"]
    assert len({line.get_color() for line in share.get_lines()}) == 3


def test_every_cell_is_one_row_with_its_chain(gathered):
    data = gathered["growth_rates"]
    assert data.sizes["cell"] == 5 * 3 + 3 * 2
    cell = data.isel(cell=(data["sites"] == 21) & (data["omega"] == 2) & (data["gamma"] == 0.5))
    assert cell["measured"].item() == pytest.approx(1.01) and cell["chain"].item() == "long"


def test_relative_errors_are_those_of_growing_cells(gathered):
    errors = figures.draw_rates(gathered["growth_rates"]).axes[1]
    lines = labelled(errors)
    np.testing.assert_allclose(lines["fastest mode"].get_ydata(), 0.01, rtol=1e-9)
    np.testing.assert_allclose(lines["linear flow of the data"].get_ydata(), 1e-9, rtol=1e-5)
    growing = int((gathered["growth_rates"]["finite_rate"] > 0).sum())
    assert len(lines["fastest mode"].get_ydata()) == growing


def test_growth_at_the_threshold_lies_on_its_line(gathered):
    panel = figures.draw_rates(gathered["growth_rates"]).axes[2]
    line, *_ = panel.get_lines()
    np.testing.assert_allclose(line.get_ydata(), 8 * np.asarray(line.get_xdata()))
    lines = labelled(panel)
    grown = lines["one wave: 1"].get_ydata()
    np.testing.assert_allclose(grown, threshold()["grown"][0].values)
    assert {"$s = 0.8$: 0.70 and 0.20", "one site: 0.50 and 0.00"} <= set(lines)
    spread = lines["one site: 0.50 and 0.00"]
    np.testing.assert_allclose(spread.get_ydata(), np.sqrt(spread.get_xdata()))
    assert panel.get_xscale() == panel.get_yscale() == "log"


def test_bounds_show_each_case_with_the_bounds_that_cover_it(gathered):
    lines = labelled(bounds_figure.draw_bounds(gathered["bounds"]).axes[0])
    assert lines["largest seen"].get_xdata().tolist() == [1.0, 800.0]
    assert lines["Theorem 1"].get_xdata()[0] == 4.0
    assert "Theorem 2" not in lines  # it covers neither case


def test_bounds_show_by_form_what_data_reach(gathered):
    panel = bounds_figure.draw_bounds(gathered["bounds"]).axes[1]
    assert [bar.get_width() for bar in panel.patches] == [0.6, 0.9, 0.2, 0.8]
    lines = labelled(panel)
    assert lines["search on 3 sites"].get_xdata().tolist() == [0.7, 0.8, 0.3, 0.95]
    waves = next(line for line in panel.get_lines() if line.get_marker() == "|")
    assert list(waves.get_xdata()) == [0.99, 0.98, 0.3, 0.97]
    assert "a wave on 33" in lines


def test_bounds_show_sweeps_over_their_bound_and_growth_with_the_chain(gathered):
    _, _, swept, growth = bounds_figure.draw_bounds(gathered["bounds"]).axes
    ratios = [line.get_ydata() for line in swept.get_lines()[:2]]
    np.testing.assert_allclose(ratios[0], [1 / 30, 2 / 30, 4 / 30])
    lines = labelled(growth)
    np.testing.assert_allclose(lines["$C_N$ of Theorem 3"].get_ydata(), [240, 528, 1008])
    runs = [line.get_ydata() for line in growth.get_lines() if line.get_marker() == "o"]
    np.testing.assert_allclose(runs, np.array([[17.0], [18.0]]) * [5, 11, 21])
