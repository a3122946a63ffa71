"""Batches: each run has the bits of the run alone, and runs that do not fit are computed alone."""

import numpy as np
import pytest
from dimers import DIMERS, dimers
from latticode import Model, abs2, lap, sign, sin
from latticode.equations.initial_values import on_sites
from latticode.simulation import survey_runs
from latticode.simulation.problem import Problem
from latticode.simulation.runs import run_chunk
from latticode.simulation.simulate import simulate
from latticode.simulation.survey import NAMES, Members, Survey
from latticode.simulation.survey_runs import norms_in_batches, run_survey


def saturable(p, u):
    return lap(u) + p.g * abs2(u) / (1 + abs2(u)) * u + lap(abs2(u) * u) + p.disorder * u


MODELS = {
    "two fields": DIMERS,
    "pendula": Model(fields="u", parameters={"g": 1.0}, d2_dt2=lambda p, u: lap(u) - p.g * sin(u)),
    "disorder": Model(fields="u", parameters={"g": 1.0, "disorder": 0.0}, i_dt=saturable),
}
DATA = {"even": {0: 1.0, 1: 0.3, -1: 0.3}, "lopsided": {-2: 0.2, 0: 1.0, 1: -0.7}}


def problems_of(name, boundary, data, count):
    """Return problems that differ in a parameter and in their data."""
    model = MODELS[name]
    key = "omega" if name == "two fields" else "g"
    fields = {site: (value,) * len(model.fields) for site, value in DATA[data].items()}
    problem = Problem(
        model=model,
        parameters={"disorder": np.linspace(-1, 1, 9)} if name == "disorder" else {},
        half_width=4,
        boundary=boundary,
        initial=on_sites(fields, len(model.fields)),
        end_time=3.0,
        output_step=0.1,
        solver={"name": "taylor", "rtol": 1e-14, "atol": 1e-14},
    )
    factors = np.array([1.0, -0.6])[: len(model.fields), None]
    return [
        problem.changed(**{key: 0.4 * n - 1.0}, initial=(1 + 0.1 * n) * factors * problem.initial)
        for n in range(count)
    ]


@pytest.mark.parametrize("data", DATA)
@pytest.mark.parametrize("boundary", ["dirichlet", "free", "periodic", "antiperiodic"])
@pytest.mark.parametrize("name", MODELS)
def test_a_run_in_a_batch_has_the_bits_of_the_run_alone(name, boundary, data):
    problems = problems_of(name, boundary, data, 13)
    (places, norms), (rest, fewer) = norms_in_batches(problems)
    assert [*places, *rest] == [*range(13)]
    for place, problem in enumerate(problems):
        run = norms.of_run(place) if place < 8 else fewer.of_run(place - 8)
        alone = simulate(problem, conserved=False)
        np.testing.assert_array_equal(run.tau, alone.tau)
        np.testing.assert_array_equal(run.linf, alone.linf)
        np.testing.assert_array_equal(run.l2, alone.l2)
        assert (run.l2 > 0.0).all()


@pytest.fixture
def in_batches(monkeypatch):
    """Return a function: the results of a survey alone and in batches."""

    def make(problem, survey):
        monkeypatch.setattr(survey_runs, "MANY", np.inf)
        alone = run_survey(problem, survey)
        monkeypatch.setattr(survey_runs, "MANY", 1)
        return alone, run_survey(problem, survey)

    return make


@pytest.fixture
def in_a_batch(monkeypatch):
    """Return the numbers of runs in each batch of a survey."""
    counts = []

    def counted(problems):
        for places, norms in norms_in_batches(problems):
            counts.append(len(places))
            yield places, norms

    monkeypatch.setattr(survey_runs, "norms_in_batches", counted)
    return counts


def test_all_results_of_a_survey_are_the_same_in_batches(in_batches, in_a_batch):
    axes = {"omega": [-4.0, 0.0, 3.0], "initial.0.0": [1.0, 1.5, 2.0]}
    survey = Survey(axes, NAMES, (1.0, 3.0), Members(count=3, size=0.1, seed=3))
    alone, together = in_batches(dimers(), survey)
    assert in_a_batch == [8, 8, 8] and [*alone] == [*together]  # the last 3 of 27 are alone
    for name, values in alone.items():
        np.testing.assert_array_equal(together[name], values, err_msg=name)


def test_runs_of_unlike_chains_and_times_form_batches_of_their_own(in_batches, in_a_batch):
    axes = {"omega": [-4.0, 0.0, 3.0, 4.0], "half_width": [2, 100, 3], "end_time": [1.0, 2.0]}
    alone, together = in_batches(dimers(), Survey(axes, ("final_l2", "mean_linf")))
    assert in_a_batch == [4, 4, 4, 4]  # those of the longest chain are alone
    for name, values in alone.items():
        np.testing.assert_array_equal(together[name], values, err_msg=name)


def problem_of(model, boundary="dirichlet", **data):
    """Return a problem of one field that is 1 / 2 at the centre of three sites."""
    return Problem(
        model=model,
        half_width=1,
        boundary=boundary,
        initial=on_sites({0: (0.5,)} | data.get("initial", {}), 1),
        end_time=1.0,
        output_step=0.25,
        solver={"name": "taylor", "rtol": 1e-14, "atol": 1e-14},
    )


def are_equal(alone, together, capsys):
    """Assert that both surveys have the same results and print the same lines."""
    assert [*alone] == [*together]
    for name, values in alone.items():
        np.testing.assert_array_equal(together[name], values, err_msg=name)
    lines = capsys.readouterr().out.splitlines()
    assert lines[: len(lines) // 2] == lines[len(lines) // 2 :]
    return len(lines) // 2


BLOW_UP = Model(fields="u", parameters={"g": 1.0}, dt=lambda p, u: p.g * (u * u))


@pytest.mark.parametrize(
    ("values", "failed", "ended"),
    [
        # u' = u^2 from 2 blows up at t = 1 / 2, and 0 and 1e300 have no step
        ([0.5, 2.0, 0.0, -1.0, -0.5, 1e300, 0.25, 0.75], (1, 5), [5]),
        ([2.0, 3.0, 4.0, 5.0, 6.0], range(5), []),
        ([0.0] * 5, (), []),
    ],
    ids=["some", "all of them fail", "all of them rest"],
)
def test_runs_without_a_step_leave_their_batch(
    values, failed, ended, in_batches, in_a_batch, capsys
):
    survey = Survey({"initial.0.0": values}, ("final_l2",))
    alone, together = in_batches(problem_of(BLOW_UP), survey)
    assert in_a_batch == ended
    is_failed = np.isnan(together["final_l2"][:, 0])
    assert np.flatnonzero(is_failed).tolist() == [*failed]
    assert are_equal(alone, together, capsys) == bool(failed)


def test_means_of_one_field_in_a_window_have_the_bits_of_a_run_alone(in_batches, capsys):
    """NumPy adds an array of one row in another order than one of several rows."""
    cubic = Model(fields="u", parameters={"c": 1.0}, i_dt=lambda p, u: p.c * lap(u) + abs2(u) * u)
    problem = problem_of(cubic).changed(end_time=20.0, output_step=0.05)
    survey = Survey({"c": [*np.linspace(0.3, 2.0, 20)]}, ("mean_l2", "mean_linf"), (5.0, 15.0))
    assert are_equal(*in_batches(problem, survey), capsys) == 0


MODELS_THAT_FAIL = {
    "no series": lambda p, u: lap(u) - p.g * sign(u) * u,
    "no number": lambda p, u: lap(u) - (1 / p.g) * u,
}


@pytest.mark.parametrize("name", MODELS_THAT_FAIL)
def test_a_run_that_fails_alone_fails_in_a_survey_with_batches(name, in_batches, capsys):
    model = Model(fields="u", parameters={"g": 1.0}, dt=MODELS_THAT_FAIL[name])
    survey = Survey({"g": [0.0, 1.0, 2.0, 3.0, -1.0, 0.5]}, ("final_l2",))
    assert are_equal(*in_batches(problem_of(model), survey), capsys) == 1


def test_numbers_and_values_by_site_are_in_different_batches(in_batches, in_a_batch, capsys):
    model = Model(fields="u", parameters={"v": 1.0}, i_dt=lambda p, u: lap(u) + p.v * u)
    by_site = [np.linspace(-1.0, 1.0, 3) * k for k in range(5)]
    survey = Survey({"v": [*by_site, np.array(0.5), 1.0]}, ("final_linf",))
    alone, together = in_batches(problem_of(model, initial={1: (0.2,)}), survey)
    assert in_a_batch == [5]
    are_equal(alone, together, capsys)


def test_results_of_runs_are_retained_as_they_arrive(monkeypatch):
    """An interrupt loses no run that ended: batches of eight, then the runs alone, one by one."""
    monkeypatch.setattr(survey_runs, "MANY", 1)
    runs = survey_runs.runs_of_survey(dimers(), Survey({"omega": [*np.linspace(-1.0, 1.0, 19)]}))
    counts, retained = [], {}
    run_chunk(runs.problems, runs.retain, 0, 1, lambda *_: counts.append(len(retained)), retained)
    assert counts == [*range(1, 20)]


def test_other_solvers_drives_far_neighbours_and_long_runs_are_left_to_runs_alone():
    far = Model(fields="u", parameters={}, i_dt=lambda p, u: u.right.right + u.left.left)
    driven = Model(fields="u", parameters={}, i_dt=lambda p, u: lap(u) + sin(p.t) * u)
    solver = {"name": "dop853", "rtol": 1e-12, "atol": 1e-12}
    one_field = {"initial": on_sites({0: (1.0,)}, 1), "parameters": {}}
    for problem in (
        dimers(solver=solver),
        dimers(half_width=100),
        dimers(output_step=1e-5),
        dimers().changed(model=far, **one_field),
        dimers().changed(model=driven, **one_field),
    ):
        assert not [*norms_in_batches([problem] * 8)]
