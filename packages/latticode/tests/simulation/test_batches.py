"""Batches: each run has the bits of the run alone, and runs that do not fit are computed alone."""

import numpy as np
import pytest
from dimers import DIMERS, dimers
from latticode import Model, abs2, lap, sin
from latticode.equations.initial_values import on_sites
from latticode.simulation import survey_runs
from latticode.simulation.problem import Problem
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


def test_a_run_that_its_series_does_not_lead_on_leaves_its_batch(in_batches, in_a_batch, capsys):
    """u' = u^2 from 1 / 2 ends, from 2 it blows up at t = 1 / 2, and 0 and 1e300 have no step."""
    model = Model(fields="u", parameters={"g": 1.0}, dt=lambda p, u: p.g * (u * u))
    solver = {"name": "taylor", "rtol": 1e-14, "atol": 1e-14}
    problem = Problem(
        model=model,
        half_width=1,
        boundary="dirichlet",
        initial=on_sites({0: (0.5,)}, 1),
        end_time=1.0,
        output_step=0.25,
        solver=solver,
    )
    values = [0.5, 2.0, 0.0, -1.0, -0.5, 1e300, 0.25, 0.75]
    alone, together = in_batches(problem, Survey({"initial.0.0": values}, ("final_l2",)))
    assert in_a_batch == [5]
    assert np.isnan(together["final_l2"][:, 0]).tolist() == [n in (1, 5) for n in range(8)]
    for name, results in alone.items():
        np.testing.assert_array_equal(together[name], results, err_msg=name)
    assert capsys.readouterr().out.count("2 of 8 runs failed") == 2


def test_other_solvers_drives_and_far_neighbours_are_left_to_runs_alone():
    far = Model(fields="u", parameters={}, i_dt=lambda p, u: u.right.right + u.left.left)
    driven = Model(fields="u", parameters={}, i_dt=lambda p, u: lap(u) + sin(p.t) * u)
    solver = {"name": "dop853", "rtol": 1e-12, "atol": 1e-12}
    one_field = {"initial": on_sites({0: (1.0,)}, 1), "parameters": {}}
    for problem in (
        dimers(solver=solver),
        dimers(half_width=100),
        dimers().changed(model=far, **one_field),
        dimers().changed(model=driven, **one_field),
    ):
        assert not [*norms_in_batches([problem] * 8)]
