"""The dataset of speed against error, on a short run of one case."""

import numpy as np
import pytest
from pendula.datasets.netcdf import read, write
from pendula.simulation.simulate import simulate
from problems import problem_of

from benchmarks import contestants, points, work_precision
from benchmarks.contestants import OURS
from benchmarks.problems import OUTPUT_STEP, Reference, until

TIGHT = {"name": "dop853", "rtol": 1e-14, "atol": 1e-14}
PROBLEM = problem_of(
    "fig3_small", half_width=4, end_time=50.0, output_step=OUTPUT_STEP, solver=TIGHT
).changed(snapshot_every=4)


def counted(action):
    """Return what `action()` returns, and a time that depends on its work alone."""
    run = action()
    return run, 1e-4 * run.outcome.evaluations


@pytest.fixture(scope="module")
def measured(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(points, "ENOUGH", 0.0)
        patch.setattr(contestants, "timed", counted)
        exact = simulate(PROBLEM.changed(end_time=2.0))
        problem, peer = until(PROBLEM, 2.0), {"someone": OURS["ode45"]}
        references = {"fig3_small": Reference(exact.final, exact.linf, exact.l2)}
        for contestant in OURS.values():  # what compiles for long may be broken off
            contestant.prepare(problem)(contestant.accuracies[0])
        said = []
        variables = work_precision.measure({"fig3_small": problem}, references, peer, said.append)
    path = tmp_path_factory.mktemp("work") / "work.nc"
    write(path, variables, {"absent": "another one is not installed"})
    assert said[0] == "fig3_small: ode45" and len(said) == len(OURS) + 1
    return read(path)


def test_every_solver_reaches_the_reference(measured):
    case = measured.sel(case="fig3_small")
    for solver in ("ode45", "dop853", "taylor"):
        assert float(case["error"].sel(contestant=solver).min()) < 1e-11
        assert float(case["norm_error"].sel(solver=solver).min()) < 1e-11
        assert float(case["energy_drift"].sel(solver=solver).min()) < 1e-11
    assert float(case["error"].sel(contestant="crank_nicolson").min()) < 1e-4


def test_times_and_errors_stand_together(measured):
    timed, erred = np.isfinite(measured["seconds"]), np.isfinite(measured["error"])
    assert bool((timed == erred).all())
    assert bool((measured["least"] <= measured["seconds"]).where(timed, True).all())
    assert bool((measured["seconds"] <= measured["most"]).where(timed, True).all())


def test_the_pair_is_compared_below_the_target(measured):
    pair = measured.sel(case="fig3_small", peer="someone")
    assert float(pair["peer_error"]) <= 1e-10 and float(pair["our_error"]) <= 1e-10
    assert pair["our_best"].item() in ("dop853", "taylor")
    assert 1.0 < float(pair["ratio"]) < 100.0
