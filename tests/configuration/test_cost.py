"""What a run is said to take, held against measured speeds; and what is too much."""

import json

import numpy as np
import pytest
from helpers import ROOT
from latticode.configuration.cost import find_excess, steps_of
from latticode.configuration.files import ConfigurationError, gather
from latticode.datasets.netcdf import read
from latticode.integrators.methods import METHODS
from latticode.simulation.simulate import simulate
from pendula.configuration.cost import CHEAP_VALUES, demand, estimate, integrated_pairs
from pendula.configuration.messages import STUDIES, load
from pendula.problem import PaperProblem

from benchmarks.contestants import controls

SPEED = ROOT / "tests/baseline/speed"
FACTOR = 3.0
"""An estimate is wrong by less: machines differ as much."""
SHORT_STEPS = {"name": "crank_nicolson", "step": 1e-9, "tolerance": 1e-13, "iterations": 50}
LIMITS = {"hours": 1.0, "gigabytes": 8.0}


def problem(**changes):
    settings = {
        "epsilon": 1.0,
        "gamma": 1.0,
        "omega": 0.0,
        "half_width": 30,
        "boundary": "dirichlet",
        "initial": {0: (1.0, 0.1)},
        "end_time": 50.0,
        "output_step": 50.0,
        "snapshot_every": 0,
        "solver": {"name": "taylor", "rtol": 1e-14, "atol": 1e-14},
    }
    return settings | changes


@pytest.fixture(scope="module")
def measured():
    return read(SPEED / "work_precision.nc")


@pytest.mark.parametrize("solver", ["ode45", "dop853", "taylor", "delfour_fortin_payre"])
def test_work_and_time_are_those_that_were_measured(solver, measured):
    """`measured` holds each of the paper's cases, from the loosest accuracy to the tightest."""
    for case in measured["case"].values:
        ratios = []
        row = measured.sel(case=case, contestant=solver, solver=solver)
        data = {0: tuple(complex(z) for z in json.loads(str(row["initial"].values))["0"])}
        span = float(row["horizon"])
        for point in range(row.sizes["point"]):
            accuracy, seconds = (float(row[name][point]) for name in ("accuracy", "seconds"))
            if not np.isfinite(seconds):
                continue
            values = problem(
                omega=float(row["omega"]),
                initial=data,
                end_time=span,
                output_step=span,
                solver=controls(solver, accuracy),
            )
            steps, evaluations = steps_of(values["solver"], values, demand(values))
            explicit = METHODS[solver].tightest is not None
            work = steps if explicit else evaluations
            run = simulate(PaperProblem.of(values)).outcome
            done = run.steps + run.rejected if explicit else run.evaluations
            assert 1 / FACTOR < work / done < FACTOR
            ratios.append(seconds / estimate(values).seconds)
        # the median, since the machine may have been busy at one of the points
        assert len(ratios) >= 5 and 1 / FACTOR < np.median(ratios) < FACTOR


@pytest.mark.parametrize(
    ("change", "key"),
    [
        ({"omega": 1e6, "end_time": 900.0}, "omega"),
        ({"epsilon": 1e7}, "epsilon"),
        ({"gamma": -1e7}, "gamma"),
        ({"initial": {0: (1e5, 0)}}, "initial"),
        ({"solver": SHORT_STEPS, "output_step": 0.025}, "solver"),
    ],
)
def test_the_key_that_costs_most_is_named(change, key):
    costly, text = find_excess(problem(**change), LIMITS, estimate, CHEAP_VALUES)
    assert costly == key and "the run would take" in text and "limits." in text


def test_a_limit_may_be_raised_and_a_long_run_is_announced():
    long = {"cases": {"mine": {"omega": 1e6, "end_time": 900}}}
    with pytest.raises(ConfigurationError, match=r"mine.omega: the run would take about 2 hours"):
        load(long)
    (output,) = load(long | {"limits": {"hours": 11}}).long_runs()
    assert output.startswith("cases.mine: the run and its checks take about 10 hours and ")
    assert load({"cases": {"mine": {"omega": 8}}}).long_runs() == []


def test_even_and_synchronised_data_cost_half_each():
    assert integrated_pairs(problem()) == 31
    assert integrated_pairs(problem(initial={1: (1, 0)})) == 61
    assert integrated_pairs(problem(initial={1: (1, 1), -1: (1, 1)})) == 15.5


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({}, []),
        (
            {"lifetimes": {"ratio": 50}},
            ["chaos.lifetimes.ratio: its runs together take about 2 hours"],
        ),
        (
            {"members": {"size": 100}},
            ["chaos.members.members: its runs together take about 1 hour"],
        ),
    ],
    ids=["the defaults", "larger data", "larger perturbations"],
)
def test_runs_of_a_study_that_last_for_minutes_are_announced(change, words):
    """Data of members are as large as their draws."""
    files = [ROOT / f"config/{name}.yaml" for name in ("config", *STUDIES)]
    output = load(gather(files, {"chaos": change})).long_runs()
    assert len(output) == len(words)
    assert all(line.startswith(start) for line, start in zip(output, words, strict=True))
