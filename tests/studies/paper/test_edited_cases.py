"""What is said of other cases than the paper's: nothing of a reference that is not their own."""

import numpy as np
import pytest
import xarray as xr
from latticode.measures.difference import PARAMETERS
from pendula.studies.paper import figures, solvers

EDITED = {
    "epsilon": 2.0,
    "gamma": 0.5,
    "omega": 1.0,
    "half_width": 3,
    "boundary": "periodic",
    "initial": '{"0": [2.0, 0.1]}',
    "output_step": 0.25,
}
KNOWS = ("never", "not by", "0 |", "reference lies", "multiprecision")
"""What words on a run say where they have a reference of it."""


def labels(figure) -> str:
    """Return all that is written in the panels of a figure and in its legend."""
    texts = [text.get_text() for axes in figure.axes for text in axes.texts]
    return " ".join(
        [*texts, *(t.get_text() for legend in figure.legends for t in legend.get_texts())]
    )


def trusted(trajectories, **edited) -> xr.Dataset:
    """Return what trust says of edited runs and of a reference of the case as it was."""
    runs = {
        case: {solver: run.assign_attrs(edited) for solver, run in by_solver.items()}
        for case, by_solver in trajectories.items()
    }
    return solvers.trust_solvers(runs, dict.fromkeys(runs, trajectories["fig2_small"]["taylor"]))


@pytest.mark.parametrize("key", EDITED)
def test_an_edited_case_has_no_reference(trajectories, make_trajectory, key):
    assert set(EDITED) == set(PARAMETERS)
    data = trusted(trajectories, **{key: EDITED[key]})
    assert data["horizon"].isnull().all() and data["known_until"].isnull().all()
    run, true = make_trajectory().assign_attrs({key: EDITED[key]}), make_trajectory()
    drawn = figures.gather_norms([run, run], [true, true])
    assert drawn["true_l2"].isnull().all() and drawn["divergence_time"].isnull().all()
    written = labels(figures.draw_norms(drawn))
    assert not [word for word in KNOWS if word in written]


def test_after_the_end_of_a_reference_nothing_is_said_of_it(trajectories):
    long = [by_solver["taylor"] for by_solver in trajectories.values()]
    true = long[0].isel(tau=slice(0, 7))
    data = solvers.trust_solvers(trajectories, dict.fromkeys(trajectories, true))
    data = data.sel(solver="taylor")
    assert (data["horizon"] == np.inf).all()
    assert (data["known_until"] == 3.0).all()
    drawn = figures.gather_norms(long, [true, true])
    lines = [line for axes in figures.draw_norms(drawn).axes for line in axes.lines]
    drawn_times = [line.get_xdata()[np.isfinite(line.get_ydata())] for line in lines]
    ends = [float(tau[-1]) for tau in drawn_times if len(tau) > 2]
    assert ends.count(3.0) == 8 and max(ends) > 3.0  # of A and of B in four panels


def test_of_another_case_the_paper_states_no_drift(trajectories):
    data = solvers.compare_solvers(trajectories, ["fig2_small"])
    assert np.isnan(float(data["stated_drift"].sel(case="fig2_small")))
    assert float(data["stated_drift"].sel(case="fig2_large")) == 1e-4
