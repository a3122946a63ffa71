"""How far trajectories are from the truth, and until when."""

import numpy as np
import pytest
import xarray as xr
from pendula.measures.divergence import (
    LEVELS,
    PARAMETERS,
    difference,
    first_above,
    horizons,
    write_table,
)


def run(count=11, omega=8.0, changes=()):
    """Return norms that are 2 for A and 1 for B, but for `changes` {(norm, row, time): value}."""
    norms = np.repeat([[2.0], [1.0]], count, axis=1)
    data = xr.Dataset(
        {name: (("component", "tau"), norms.copy()) for name in ("linf", "l2")},
        {"tau": 0.5 * np.arange(count), "component": ["A", "B"]},
        {**dict.fromkeys(PARAMETERS, 1.0), "omega": omega},
    )
    data["energy"] = ("tau", np.zeros(count))
    for (name, row, time), value in dict(changes).items():
        data[name][row, time] = value
    return data


def test_differences_are_parts_of_the_largest_value_of_their_curve():
    changed = run(changes={("l2", 0, 3): 1.0, ("linf", 1, 5): 1.25})
    found = difference(changed, run())
    assert found[3] == pytest.approx(1.0 / 2.0)
    assert found[5] == pytest.approx(0.25 / 1.25)
    assert float(found.sum()) == pytest.approx(0.7)


def test_a_longer_reference_is_cut_and_rounded_times_are_the_same_times():
    longer = run(count=21)
    longer["tau"] = longer["tau"] * (1 + 1e-15)
    found = difference(run(), longer)
    assert found.sizes == {"tau": 11}
    assert not found.any()


def test_the_first_time_above_a_level_counts():
    found = difference(run(changes={("l2", 0, 4): 2.03, ("l2", 0, 8): 3.0}), run())
    assert first_above(found, 0.005) == 2.0
    assert first_above(found, 0.2) == 4.0
    assert np.isnan(first_above(found, 0.5))


def test_each_solver_has_its_horizon_at_each_level():
    runs = {"good": run(), "bad": run(changes={("l2", 1, 2): 1.008, ("l2", 1, 6): 1.02})}
    found = horizons(runs, run())
    assert found["horizon"].sel(solver="bad").to_series().to_dict() == {"line": 1.0, "visible": 3.0}
    assert found["horizon"].sel(solver="good").isnull().all()
    assert found["size"].values.tolist() == list(LEVELS.values())


def test_another_case_has_no_horizon():
    found = horizons({"run": run(changes={("l2", 0, 1): 9.0})}, run(omega=7.0))
    assert found["horizon"].isnull().all() and found["difference"].isnull().all()


def test_the_table_says_when_each_solver_is_lost_or_never():
    runs = {"good": run(), "bad": run(changes={("l2", 1, 6): 1.02})}
    found = horizons(runs, run())
    page = write_table(found.assign(horizon=found["horizon"].expand_dims(case=["fig2_small"])))
    assert "| fig2_small | bad | 3 | 3 |" in page
    assert "| fig2_small | good | never | never |" in page
