"""The energy's drift, the agreement of the solvers and their errors in pictures."""

import numpy as np
from pendula.datasets.registry import SOLVER_NAMES
from pendula.measures.difference import VISIBLE
from pendula.studies.paper import figures, solvers


def test_energy_panels_draw_each_solver_and_the_claim(gathered):
    figure = figures.draw_drift(gathered["drift"])
    for axes, claim in zip(figure.axes, [1e-6, 1e-4], strict=True):
        *curves, line = axes.get_lines()
        assert axes.get_yscale() == "log"
        drawn = [SOLVER_NAMES[name] for name in gathered["drift"]["solver"].values]
        assert sorted(curve.get_label() for curve in curves) == sorted(drawn)
        assert set(line.get_ydata()) == {claim}


def test_the_drift_is_drawn_as_its_largest_value_so_far(trajectories, swept_pairs):
    measured = solvers.compare(trajectories, swept_pairs)
    measured["drift"][..., -1] = 0.0  # it comes back to nothing, as an oscillation does
    drawn = figures.gather_drift(measured)["drift_so_far"]
    assert np.array_equal(drawn.isel(tau=-1), measured["drift"].isel(tau=-2))
    assert np.array_equal(drawn.isel(tau=5), measured["drift"].isel(tau=5))


def test_agreement_panels_draw_each_pair_and_what_is_visible(gathered):
    for axes in figures.draw_agreement(gathered["agreement"]).axes:
        lines = axes.get_lines()
        assert len([line for line in lines if " / " in line.get_label()]) == 3
        assert set(lines[-1].get_ydata()) == {VISIBLE}


def test_a_mark_shows_when_a_solver_leaves_the_reference(gathered):
    drawn = gathered["trust"].copy(deep=True)
    drawn["horizon"][:, :, 0] = np.inf
    data = drawn.sel(level="visible")
    panels = figures.draw_trust(drawn).axes
    for axes, case in zip(panels, data["case"].values, strict=True):
        marks = [line for line in axes.get_lines() if len(line.get_xdata()) == 1]
        first, *others = (mark.get_xdata()[0] for mark in marks)
        assert first == float(data["tau"][-1])  # it never leaves: at the end of its curve
        assert others == list(data["horizon"].sel(case=case)[1:])


def test_a_proven_bound_is_drawn_to_its_end_and_only_where_there_is_one(gathered):
    drawn = gathered["trust"].copy(deep=True)
    first = drawn["case"].values[0]
    end = float(drawn["tau"][3])
    drawn["proved_until"].loc[{"case": first}] = end
    drawn["largest_bound"].loc[{"case": first}] = 1e-14
    for axes, case in zip(figures.draw_trust(drawn).axes, drawn["case"].values, strict=True):
        bounds = [line for line in axes.get_lines() if line.get_label() == "proven bound"]
        marks = [line for line in axes.get_lines() if line.get_marker() == "*"]
        assert len(bounds) == int(case == first) and len(marks) == 2 * len(bounds)
        assert all(line.get_xdata()[-1] == end for line in marks)
        assert all(set(line.get_ydata()) == {1e-14} for line in marks)
