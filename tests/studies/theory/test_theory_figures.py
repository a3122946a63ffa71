"""The stability chart, the growth rates and the bounds."""

import numpy as np
import pytest
from made_up_checks import chart, short_chart, threshold
from pendula.studies.theory import figures


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
    lines = labelled(panel)
    tau, line = lines[r"$4 \gamma \tau$"].get_data()
    np.testing.assert_allclose(line, 8 * np.asarray(tau))
    np.testing.assert_allclose(
        lines["one mode, finite chain"].get_ydata(), threshold()["grown"][0].values
    )
    assert panel.get_xscale() == panel.get_yscale() == "log"


def test_bounds_say_where_each_case_stands(gathered):
    cases = figures.draw_bounds(gathered["bounds"]).axes[0]
    assert [text.get_text() for text in cases.texts] == [
        "inside; 0.25 of\nTheorem 1",
        "outside; 0.4\nof Theorem 3",
    ]
    lines = labelled(cases)
    assert lines["largest seen"].get_xdata().tolist() == [1.0, 800.0]
    assert lines["Theorem 1"].get_xdata()[0] == 4.0
    assert "Theorem 2" not in lines  # it covers neither case


def test_bounds_draw_all_samples_and_the_worst(gathered):
    samples = figures.draw_bounds(gathered["bounds"]).axes[1]
    clouds = [line for line in samples.get_lines() if line.get_marker() == "."]
    assert sum(len(cloud.get_xdata()) for cloud in clouds) == 24
    lines = labelled(samples)
    assert lines["worst, chain of 3"].get_xdata().tolist() == [0.7, 0.3, 0.95]
    assert lines["worst, ring of 3"].get_xydata().tolist() == [[0.6, 0.0]]


def test_bounds_draw_each_sweep_in_its_panel(gathered):
    panels = figures.draw_bounds(gathered["bounds"]).axes[2:]
    assert len(panels) == 2
    for axes, title in zip(panels, (r"$\Omega = -4$", r"$\Omega = 8$"), strict=True):
        assert axes.get_title(loc="left").startswith(title)
        assert axes.get_yscale() == "log"
        lines = labelled(axes)
        seen, bound = (lines[name].get_ydata() for name in ("largest seen", "Theorem 3"))
        np.testing.assert_allclose(bound, 400 * np.asarray(seen))
