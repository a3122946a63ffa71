"""Surveys: each run is the one that is made alone, in any number of parts, and says what it is."""

from functools import partial

import numpy as np
import pytest
import xarray as xr
from dimers import dimers
from latticode.datasets.netcdf import as_xarray
from latticode.datasets.surveys import survey_contents
from latticode.equations.initial_values import on_sites
from latticode.simulation import survey_runs
from latticode.simulation.runs import join_chunks, run_all, run_chunk
from latticode.simulation.simulate import simulate
from latticode.simulation.survey import Members, Survey, Surveyed
from latticode.simulation.survey_runs import run_survey

AXES = {"omega": [-4.0, 0.0, 3.0], "initial.0.0": [1.0, 2.0 + 0.5j]}


def test_a_run_of_a_survey_is_the_one_that_is_made_alone():
    problem = dimers()
    quantities = ("max_l2", "mean_linf", "final_l2")
    surveyed = run_survey(problem, Survey(AXES, quantities, (1.0, 3.0)))
    alone = simulate(problem.changed(omega=0.0, initial=on_sites({0: (2.0 + 0.5j, 0.1)})))
    inside = (alone.tau >= 1.0) & (alone.tau <= 3.0)
    np.testing.assert_array_equal(surveyed["max_l2"][1, 1], alone.l2[:, inside].max(axis=1))
    trapezoids = np.trapezoid(alone.linf[:, inside], alone.tau[inside]) / 2.0
    np.testing.assert_allclose(surveyed["mean_linf"][1, 1], trapezoids, rtol=1e-14)
    np.testing.assert_array_equal(surveyed["final_l2"][1, 1], alone.l2[:, -1])


@pytest.mark.parametrize("chunks", [2, 5, 24, 30])
def test_the_bits_do_not_depend_on_the_number_of_parts(chunks):
    problem = dimers()
    survey = Survey(AXES, ("max_l2",), members=Members(count=4, size=0.1, seed=3))
    unsplit = run_survey(problem, survey)["max_l2"]

    def in_parts(problems, make):
        return join_chunks([run_chunk(problems, make, chunk, chunks) for chunk in range(chunks)])

    np.testing.assert_array_equal(run_survey(problem, survey, in_parts)["max_l2"], unsplit)
    assert unsplit.shape == (3, 2, 4, 2) and np.unique(unsplit[0, 0, :, 0]).size == 4


@pytest.mark.parametrize("cores", [1, 3])
def test_cores_change_no_bit_and_an_interrupt_ends_all_of_them(cores, monkeypatch):
    problem, survey = dimers(), Survey(AXES, members=Members(count=5, size=0.1, seed=3))
    on_one_core = run_survey(problem, survey, run_chunk)["max_l2"]
    run = partial(run_all, cores=cores)
    np.testing.assert_array_equal(run_survey(problem, survey, run)["max_l2"], on_one_core)

    started = []

    def interrupted(problem):
        started.append(problem)
        if len(started) == 4:
            raise KeyboardInterrupt
        return simulate(problem, conserved=False)

    monkeypatch.setattr(survey_runs, "simulate", lambda problem, conserved: interrupted(problem))
    with pytest.raises(KeyboardInterrupt):
        run_survey(problem, survey, run)
    assert len(started) < 30  # of all runs, which would be made if nothing ended them


def test_members_are_small_changes_of_the_data():
    problem, survey = dimers(), Survey({}, members=Members(count=50, size=1e-3, seed=1))
    drawn = np.array([member.initial for member in Surveyed(problem, survey)])
    relative = np.abs(drawn / problem.initial - 1.0)
    assert 0.5e-3 < relative.mean() < 2e-3


def test_half_widths_and_end_times_are_axes():
    survey = Survey({"half_width": [2, 8], "end_time": [1.0, 2.0]}, ("final_l2",))
    norms = run_survey(dimers(), survey)["final_l2"]
    alone = simulate(dimers(half_width=2, end_time=2.0)).l2[:, -1]
    np.testing.assert_array_equal(norms[0, 1], alone)


def test_an_exponent_is_that_of_the_power():
    """At gamma = 0 and without coupling the power is conserved: its exponent is zero."""
    surveyed = run_survey(dimers(epsilon=0.0), Survey({"gamma": [0.0, 1.0]}, ("exponent",)))
    assert abs(surveyed["exponent"][0]) < 1e-13 < 1e-4 < abs(surveyed["exponent"][1])


def test_a_function_of_the_users_is_kept_by_its_name():
    def late(problem, run):
        assert problem.parameters["omega"] == 1.0
        return run.l2[0, -2:]

    survey = Survey({"omega": [1.0]}, (late, "final_l2"))
    surveyed = run_survey(dimers(), survey)
    assert surveyed["late"].shape == (1, 2) and surveyed["late"][0, 1] == surveyed["final_l2"][0, 0]
    data = as_xarray(*survey_contents("own", dimers(), survey, surveyed))
    assert data["late"].dims == ("omega", "late_0")


def test_values_of_unlike_shapes_have_nan_behind_the_shorter():
    problems = [dimers(end_time=end) for end in (1.0, 2.0, 1.0)]

    def make(problem):
        return {"l2": simulate(problem).l2[0], "count": 1}

    unsplit, joined = (
        join_chunks([run_chunk(problems, make, chunk, chunks) for chunk in range(chunks)])
        for chunks in (1, 2)
    )
    assert np.isnan(unsplit["l2"][:, -1]).tolist() == [True, False, True]
    assert unsplit["count"].tolist() == [1, 1, 1] and unsplit["count"].dtype.kind == "i"
    np.testing.assert_array_equal(joined["l2"], unsplit["l2"])


def test_the_names_of_one_axis_vary_together():
    survey = Survey({"omega, initial.0.1": [(1.0, 0.5), (2.0, 0.25)], "gamma": [0.0, 0.5]})
    norms = run_survey(dimers(), survey)["max_l2"]
    alone = dimers(gamma=0.5).changed(omega=2.0, initial=on_sites({0: (1.0, 0.25)}))
    np.testing.assert_array_equal(norms[1, 1], simulate(alone).l2.max(axis=1))
    data = as_xarray(*survey_contents("pairs", dimers(), survey, {"max_l2": norms}))
    assert data["max_l2"].dims == ("omega", "gamma", "component")
    assert data["initial_0_1"].dims == ("omega",)


def test_a_run_that_cannot_end_is_nan_and_the_others_are_numbers():
    surveyed = run_survey(dimers(), Survey({"omega": [1.0, 1e300]}, ("max_l2", "exponent")))
    assert np.isnan(surveyed["max_l2"][1]).all() and np.isfinite(surveyed["max_l2"][0]).all()
    assert np.isnan(surveyed["exponent"][1])


def test_failed_runs_are_counted_and_each_has_its_reason(capsys):
    survey = Survey({"omega": [1.0, 1e300, 2.0], "gamma": [0.0, 1.0]}, ("max_l2",))
    surveyed = run_survey(dimers(), survey)
    (line,) = capsys.readouterr().out.splitlines()
    assert line.startswith(
        "2 of 6 runs failed and have NaN; the first, omega = 1e+300, gamma = 0: "
    )
    failed = np.isnan(surveyed["max_l2"]).all(axis=-1)
    assert ((surveyed["failure"] != "") == failed).all() and failed.sum() == 2
    assert "taylor stopped at t = 0" in surveyed["failure"][1, 0]
    data = as_xarray(*survey_contents("own", dimers(), survey, surveyed))
    assert data.attrs["failed_runs"] == 2 and data["failure"].dims == ("omega", "gamma")
    finished = run_survey(dimers(), Survey({"omega": [1.0]}, ("max_l2",)))
    data = as_xarray(*survey_contents("own", dimers(), Survey({"omega": [1.0]}), finished))
    assert data.attrs["failed_runs"] == 0 and "failure" not in data
    assert capsys.readouterr().out == ""


@pytest.mark.parametrize("chunks", [2, 3])
def test_reasons_of_failed_runs_are_joined_from_parts(chunks):
    survey = Survey({"omega": [1.0, 2.0, 1e300, 3.0]}, ("max_l2",))

    def in_parts(problems, make):
        return join_chunks([run_chunk(problems, make, chunk, chunks) for chunk in range(chunks)])

    surveyed = run_survey(dimers(), survey, in_parts)
    assert [bool(text) for text in surveyed["failure"]] == [False, False, True, False]


@pytest.mark.parametrize(
    ("axes", "keep", "message"),
    [
        ({"omgea": [1.0]}, ("max_l2",), "axes: 'omgea' cannot be varied; give one of eps"),
        ({"initial.1.0": [1.0]}, ("max_l2",), "has no initial value: SITE is one of 0, and"),
        ({"initial.0.2": [1.0]}, ("max_l2",), r"FIELD one of 0\.\.1"),
        ({"omega": [1.0]}, ("max_l3",), "keep: unknown result 'max_l3'; give one of max_l2"),
        ({"omega": [1.0]}, (lambda problem, run: 1.0,), "this one has none .a lambda"),
        ({"omega": [1.0]}, (abs,), r"keep: abs must accept the arguments \(problem, run\)"),
    ],
)
def test_what_cannot_be_done_is_said_before_any_run(axes, keep, message):
    with pytest.raises(ValueError, match=message):
        run_survey(dimers(), Survey(axes, keep))


def test_a_survey_as_a_dataset_has_its_axes_as_dimensions():
    problem, survey = dimers(), Survey(AXES, ("max_l2", "exponent"), (1.0, 3.0))
    data = as_xarray(*survey_contents("map", problem, survey, run_survey(problem, survey)))
    assert isinstance(data, xr.Dataset)
    assert data["max_l2"].dims == ("omega", "initial_0_0", "component")
    assert (data.attrs["title"], data.attrs["case"]) == ("The survey map", "map")
    assert data["exponent"].dims == ("omega", "initial_0_0")
    assert data["initial_0_0"].values.tolist() == ["(1+0j)", "(2+0.5j)"]
    assert data["max_l2"].attrs["long_name"].startswith("largest l2 norm")
