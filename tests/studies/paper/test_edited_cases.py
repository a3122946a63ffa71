"""What is said of a case that its user has edited: nothing of a reference that is not its own."""

import numpy as np
import pytest
import xarray as xr
from accepted import dataset
from pendula.measures.difference import PARAMETERS
from pendula.studies.chaos.ensembles import norms_at
from pendula.studies.paper import figures, solvers
from pendula.studies.paper.tables import energy_part, trust_part
from pendula.studies.unbounded import figures as unbounded

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
    found = [text.get_text() for axes in figure.axes for text in axes.texts]
    return " ".join([*found, *(t.get_text() for one in figure.legends for t in one.get_texts())])


def trusted(trajectories, **edited) -> xr.Dataset:
    """Return what trust says of edited runs and of a reference of the case as it was."""
    runs = {key: run.assign_attrs(edited) for key, run in trajectories.items()}
    true = trajectories["fig2_small.dop853"]
    return solvers.trust_solvers(runs, {name.partition(".")[0]: true for name in runs})


def edited_norms(make_trajectory, key) -> xr.Dataset:
    """Return what a figure draws of a run that is edited in one place, beside the case itself."""
    run, true = make_trajectory().assign_attrs({key: EDITED[key]}), make_trajectory()
    return figures.gather_norms([run, run], [true, true])


@pytest.mark.parametrize("key", EDITED)
def test_an_edited_case_has_no_reference(trajectories, make_trajectory, key):
    assert set(EDITED) == set(PARAMETERS)
    data = trusted(trajectories, **{key: EDITED[key]})
    assert data["horizon"].isnull().all() and data["known_until"].isnull().all()
    *_, table = trust_part(data)
    assert table.count("no reference") == data["horizon"].size
    assert not [word for word in KNOWS if word in table]
    drawn = edited_norms(make_trajectory, key)
    assert drawn["true_l2"].isnull().all() and drawn["divergence_time"].isnull().all()


def test_figures_of_an_edited_case_say_so(trajectories, make_trajectory):
    trust = figures.draw_trust(figures.gather_trust(trusted(trajectories, omega=EDITED["omega"])))
    assert labels(trust).count("no reference") == 2
    written = labels(figures.draw_norms(edited_norms(make_trajectory, "omega")))
    assert not [word for word in KNOWS if word in written]


def test_after_the_end_of_a_reference_nothing_is_said_of_it(trajectories, make_trajectory):
    long = {key: run.copy() for key, run in trajectories.items() if key.endswith("dop853")}
    true = long["fig2_small.dop853"].isel(tau=slice(0, 7))
    data = solvers.trust_solvers(long, dict.fromkeys(("fig2_small", "fig2_large"), true))
    assert (data["horizon"] == np.inf).all()
    assert (data["known_until"] == 3.0).all() and (data["run_end"] == 5.0).all()
    *_, words, table = trust_part(data)
    assert "nothing is known of the time after it" in words and "never" not in table
    assert table.count("not by 3, the reference's end") == data["horizon"].size
    drawn = figures.gather_norms(list(long.values()), [true, true])
    assert labels(figures.draw_norms(drawn)).count(r"under it to $\tau = 3$") == 4


def test_of_another_case_the_paper_states_no_drift(trajectories, swept_pairs):
    data = solvers.compare_solvers(trajectories, *swept_pairs, ["fig2_small"])
    assert np.isnan(float(data["stated_drift"].sel(case="fig2_small")))
    assert data["kept"].sel(case="fig2_small").isnull().all()
    assert data["kept"].sel(case="fig2_large", solver="ode45").values.tolist() == [1, 1]
    *_, table = energy_part(data)
    small, large = table.splitlines()[-2:]
    assert "none: another case" in small and small.endswith("no claim |")
    assert "1e-04" in large and "early, to the end" in large
    assert "stated by the paper" in labels(figures.draw_drift(figures.gather_drift(data)))
    data = solvers.compare_solvers(trajectories, *swept_pairs, ["fig2_small", "fig2_large"])
    assert "stated" not in labels(figures.draw_drift(figures.gather_drift(data)))


def test_a_true_run_is_not_drawn_on_after_its_end(make_trajectory):
    pair = xr.Dataset(coords={"tau": np.linspace(0.0, 10.0, 21)})
    norms = norms_at(pair["tau"], ["fig2_small"], [make_trajectory()])
    assert norms.sel(tau=5.0).notnull().all() and norms.sel(tau=slice(5.1, None)).isnull().all()


def test_the_papers_window_is_not_drawn_on_a_map_that_ends_before():
    maps = {name: dataset(f"unbounded/map_{name}") for name in ("fig5_left", "fig5_right")}
    end = float(maps["fig5_left"]["end"][-1])
    data = unbounded.gather_window_map([*maps.values()], [*maps], [end, end + 1.0])
    assert np.isnan(data["paper_end"].values).tolist() == [False, True]
    assert labels(unbounded.draw_window_map(data)).count("the paper's $T$") == 4
    data = unbounded.gather_window_map([*maps.values()], [*maps], [end + 1.0, end + 1.0])
    assert "paper" not in labels(unbounded.draw_window_map(data))
