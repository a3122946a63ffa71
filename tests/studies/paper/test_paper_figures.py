"""What figures of norms and sweeps show of other runs than the paper's."""

import numpy as np
import pytest
from pendula.studies.paper import figures, solvers


@pytest.fixture
def leaving(make_trajectory):
    """Return a run and a reference that it leaves at tau = 2."""
    run, true = make_trajectory(), make_trajectory()
    true["l2"][0, 4:] *= 1.5
    return run, true


def drawn(runs, references, *ensembles):
    return figures.draw_norms(figures.gather_norms(runs, references, *ensembles))


def test_where_a_run_leaves_its_reference_both_stand_apart_and_a_line_shows_when(leaving):
    run, true = leaving
    figure = drawn([run, run], [true, run])
    assert len(figure.axes) == 6
    for axes in figure.axes[:4]:
        assert axes.get_lines()[2].get_xdata()[0] == 2.0
    assert np.array_equal(figure.axes[3].get_lines()[0].get_ydata(), true["l2"].sel(component="A"))
    for axes in figure.axes[4:]:
        assert len(axes.get_lines()) == 4  # and no line: the reference lies under the run


def test_the_line_stands_where_the_dataset_of_horizons_says(leaving):
    run, true = leaving
    shown = figures.gather_norms([run, run], [true, run])["divergence_time"]
    runs = {f"{name}.ode45": run for name in figures.SIZES}
    horizons = solvers.trust_solvers(runs, {"small": true, "large": run})["horizon"]
    stored = horizons.sel(level="visible", solver="ode45")
    assert np.array_equal(shown, stored) and list(shown) == [2.0, np.inf]


def test_runs_of_different_lengths_are_drawn_whole(make_trajectory):
    pair = [make_trajectory(), make_trajectory(end_time=7.0)]
    figure = drawn(pair, pair)
    ends = [axes.get_lines()[2].get_xdata()[-1] for axes in figure.axes]
    assert [axes.get_xlim()[1] for axes in figure.axes] == ends
    assert ends == [5.0, 5.0, 7.0, 7.0]


def test_gather_reads_the_window_and_statistic_of_text_and_caption(make_sweep):
    sweep = make_sweep()
    data = figures.gather_sweeps(sweep, sweep, "[10, 70]", "[10, 40]").sel(panel="left")
    for name in ("l2", "linf"):
        pair = sweep[name].sel(quantity="pair")
        text = pair.sel(statistic="max", window="[10, 70]")
        caption = pair.sel(statistic="mean", window="[10, 40]")
        assert np.array_equal(data[name].sel(reading="text"), text)
        assert np.array_equal(data[name].sel(reading="caption"), caption)


def test_sweeps_over_different_half_widths_keep_all_their_dots(make_sweep):
    left, right = make_sweep(), make_sweep().assign_coords(half_width=[7, 10, 300])
    figure = figures.draw_sweeps(figures.gather_sweeps(left, right, "[10, 70]", "[10, 40]"))
    shown = [list(axes.get_lines()[0].get_xdata()) for axes in figure.axes]
    assert shown == [[5, 10, 20], [7, 10, 300]]


def test_the_drift_is_drawn_as_its_largest_value_so_far(trajectories, swept_pairs):
    measured = solvers.compare_solvers(trajectories, *swept_pairs)
    measured["drift"][..., -1] = 0.0  # it comes back to nothing, as an oscillation does
    drawn = figures.gather_drift(measured)["drift_so_far"]
    assert np.array_equal(drawn.isel(tau=-1), measured["drift"].isel(tau=-2))
    assert np.array_equal(drawn.isel(tau=5), measured["drift"].isel(tau=5))
