"""What is measured of the solvers, and the tables that are made of it."""

import numpy as np
import pytest
from accepted import BASELINE
from held_digits import unlike
from pendula.studies.paper.figures import gather_norms
from pendula.studies.paper.solvers import compare_solvers, trust_solvers
from pendula.studies.paper.tables import tabulate_solvers


@pytest.mark.parametrize(("drift", "kept"), [(1.9e-6, 1), (2.1e-6, 0)])
def test_a_drift_is_kept_up_to_twice_the_stated_order(trajectories, swept_pairs, drift, kept):
    run = trajectories["fig2_small.ode45"]
    changed = {"fig2_small.ode45": run.assign(energy=7.0 + drift * (run["tau"] == 5.0))}
    found = compare_solvers(trajectories | changed, *swept_pairs).sel(case="fig2_small")
    assert found["kept"].sel(solver="ode45").values.tolist() == [kept, kept]


def test_the_tables_are_those_that_are_accepted(tmp_path):
    names = ("solvers", "trust")
    given = (f"{BASELINE}/checks/{name}.nc" for name in names)
    tabulate_solvers(*given, *(f"{tmp_path}/{name}.md" for name in names))
    for name in names:
        made, accepted = (folder / f"{name}.md" for folder in (tmp_path, BASELINE / "tables"))
        assert not unlike(accepted.read_text(), made.read_text()), name


def test_the_divergence_time_of_a_figure_is_the_horizon_of_the_dataset(make_trajectory):
    run, true = make_trajectory(), make_trajectory()
    true["l2"][0, 4:] *= 1.5
    shown = gather_norms([run, run], [true, run])["divergence_time"]
    runs = {"small.ode45": run, "large.ode45": run}
    horizons = trust_solvers(runs, {"small": true, "large": run})["horizon"]
    stored = horizons.sel(level="visible", solver="ode45")
    assert np.array_equal(shown, stored) and list(shown) == [2.0, np.inf]
