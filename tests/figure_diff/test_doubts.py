"""What may not be accepted: datasets of another problem than their name says, and lost numbers."""

import made_up_results as made_up
import numpy as np
import pytest
from made_up_results import CHAOTIC, REGULAR, change_a
from pendula.figure_diff import doubts
from pendula.figure_diff.acceptance import AcceptanceError

CASE = {
    "omega": 8.0,
    "gamma": 1.0,
    "epsilon": 1.0,
    "half_width": 30,
    "boundary": "dirichlet",
    "initial": {"0": ["1+0j", "0.1+0.5j"]},
    "end_time": 50.0,
    "output_step": 0.025,
    "solver": {"name": "ode45", "rtol": 1e-7},
}
SWEEP = {"case": "small", "windows": [[10, 40], [10, 70]], "solver": None}
CONFIGURATION = {"cases": {"small": CASE}, "sweeps": {"wide": SWEEP}}
RIGHT = {
    **{key: CASE[key] for key in doubts.OF_A_CASE},
    "initial": '{"0": [1.0, "0.1+0.5j"]}',
    "solver": "ode45",
}


def told(name: str, **changed) -> list[str]:
    """Return what is said of a dataset with these attributes, and all others right."""
    expected = doubts.problem_of(name, CONFIGURATION)
    return doubts._unlike_the_case(RIGHT | changed, expected)


def test_a_trajectory_of_its_case_raises_no_doubt():
    assert told("trajectories/small.nc") == []
    assert told("trajectories/small.taylor.nc", solver="taylor") == []
    assert told("trajectories/of_no_case.nc", omega=1.0) == []
    assert told("checks/small.nc", omega=1.0) == []


@pytest.mark.parametrize(
    ("key", "wrong"),
    [
        ("omega", -4.0),
        ("gamma", 0.5),
        ("epsilon", 1.0 + 1e-15),
        ("half_width", 31),
        ("boundary", "free"),
        ("end_time", 49.0),
        ("output_step", 0.05),
        ("initial", '{"0": [1.0, 0.1]}'),
        ("solver", "taylor"),
    ],
)
def test_a_trajectory_of_another_problem_is_named(key, wrong):
    (said,) = told("trajectories/small.nc", **{key: wrong})
    assert said.startswith(f"{key} is {wrong}, but ") and said.endswith(" in the configuration")


def test_another_solver_than_the_name_says_is_named():
    assert told("trajectories/small.taylor.nc") == [
        "solver is ode45, but taylor in the configuration"
    ]


def test_a_sweep_ends_with_its_last_window_and_has_many_widths():
    assert told("sweeps/wide.nc", end_time=70.0, half_width=5) == []
    assert told("sweeps/wide.nc")[0].startswith("end_time is 50.0, but 70")


def test_accepting_refuses_a_dataset_of_another_problem(run):
    run.change(REGULAR, lambda data: data.assign_attrs(omega=-4.0))
    with pytest.raises(AcceptanceError, match=r"fig2_small.nc: omega is -4.0, but 8 in the conf"):
        run.accept()


def lose(data):
    """Put NaN in place of two numbers of a curve."""
    data["l2"].values[0, [300, 301]] = np.nan
    return data


def test_accepting_refuses_nan_in_place_of_numbers_unless_the_file_is_named(run):
    run.change(CHAOTIC, lose)
    said = r"NaN in place of 2 numbers .*accept=trajectories/fig4_small, or all files: accept='\*'"
    with pytest.raises(AcceptanceError, match=said):
        run.accept()
    run.accept(chosen=[CHAOTIC])
    assert not run.faults()
    run.change(CHAOTIC, lambda data: change_a(made_up.chaotic(seed=2), 1.0))  # numbers again
    assert f"changed: {CHAOTIC}" in run.accept()
