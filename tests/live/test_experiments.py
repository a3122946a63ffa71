"""Each experiment of the live page shows what the page says that one should see."""

from urllib.parse import parse_qs

import numpy as np
import pytest
from latticode.measures.difference import VISIBLE, first_above, norm_difference
from latticode.measures.levels import correlation
from latticode.simulation.simulate import simulate
from oracle import CASES
from pendula.live.experiments import EXPERIMENTS
from pendula.studies.breathers.fates import is_localised, power_by_distance
from problems import problem_of

ODE45 = {"name": "ode45", "rtol": 1e-7, "atol": 1e-9}
BY_TITLE = {experiment.title: experiment for experiment in EXPERIMENTS}


def run_experiment(title: str, factor: float = 1.0):
    """Return the run of an experiment, from initial data times a factor."""
    link = {key: values[0] for key, values in parse_qs(BY_TITLE[title].link).items()}
    a, b = CASES[link["case"]][1]
    pair = float(link.get("a_re", a)), float(link.get("b_re", b))
    changes = {"omega": float(link["omega"])} if "omega" in link else {}
    case = problem_of(link["case"], **changes, initial={0: pair}, end_time=50.0, solver=ODE45)
    return simulate(case.changed(initial=case.initial * factor, snapshot_every=4))


def test_stable_motion_leaves_the_centre_and_a_and_b_take_turns():
    run = run_experiment("Stable")
    assert run.linf[:, -1].max() < 0.4 * run.linf[:, 0].max()
    assert correlation(*run.l2**2) < -0.9


def test_unstable_motion_fills_the_chain_and_levels_off():
    run = run_experiment("Unstable")
    late = run.tau >= 20.0
    assert run.modulus[:, [0, -1], 20 * 10].max() > 1.0
    assert run.modulus[:, :, 20 * 10 :].max(axis=-1).min() > 2.0
    assert run.linf.max() < 8.0
    l2 = run.l2[:, late]
    assert l2.std() < 0.1 * l2.mean()


def test_synchronised_pendula_are_not_driven():
    run = run_experiment("Synchronised")
    assert np.array_equal(run.modulus[0], run.modulus[1])
    assert np.ptp(run.l2) < 1e-5
    assert run.modulus[0, 30, -1] < 0.5


def test_localised_motion_stays_at_the_centre():
    run = run_experiment("Localised")
    states = np.moveaxis(run.modulus, -1, 0)
    assert all(is_localised(power_by_distance(state)) for state in states)


@pytest.mark.parametrize(("perturbation", "time"), [(1e-6, 8.0), (1e-12, 16.0)])
def test_two_chaotic_runs_agree_for_as_long_as_the_page_says(perturbation, time):
    assert "perturbation=1e-6" in BY_TITLE["Chaotic"].link
    first, second = run_experiment("Chaotic"), run_experiment("Chaotic", 1 + perturbation)
    difference = norm_difference(first.linf, first.l2, second.linf, second.l2)
    assert first_above(first.tau, difference, VISIBLE) == pytest.approx(time, abs=1.5)
