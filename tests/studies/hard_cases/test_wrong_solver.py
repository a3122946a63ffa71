"""A solver made slightly wrong is seen: comparison with the reference has the teeth for it."""

from pathlib import Path

import numpy as np
import pytest
from pendula.compiled import uncached
from pendula.datasets.netcdf import read
from pendula.integrators import dop853
from pendula.models.amplitudes import rates
from pendula.simulation import solvers
from pendula.simulation.lattice import Reduction
from pendula.simulation.observables import observe
from pendula.simulation.simulate import simulate
from problems import problem_of

ROOT = Path(__file__).resolve().parents[3]
CASE, TAU = "fig2_large", 5.0
TIGHT = {"name": "dop853", "rtol": 1e-13, "atol": 1e-13}


@pytest.fixture(scope="module")
def exact():
    """Return the amplitudes of the multiprecision reference at the end."""
    reference = read(ROOT / f"tests/baseline/reference/{CASE}.nc")
    at = reference["snapshot_tau"].values == TAU
    re, im = reference["amplitude"].isel(snapshot=at).squeeze("snapshot").values
    return re + 1j * im


def error(exact) -> float:
    """Return the largest error of a component at the end."""
    problem = problem_of(CASE, end_time=TAU, output_step=TAU, solver=TIGHT)
    final = simulate(problem, Reduction(even=True, synchronised=False)).final
    return float(np.abs(final - exact).max())


@pytest.fixture
def wrong_dop853(monkeypatch):
    """Put in place of dop853 one whose last weight is wrong in the seventh digit."""
    weights = dop853.ROWS.weights.copy()
    weights[13, dop853.ROWS.terms[13] - 1] *= 1.0 + 1e-7
    # compiled afresh from the plain function: the cached kernel has the right weights built in
    namespace = {**vars(dop853), "ROWS": dop853.ROWS._replace(weights=weights)}
    plain = dop853.combine.py_func
    changed = type(plain)(plain.__code__, namespace)
    monkeypatch.setattr(dop853, "combine", uncached(changed))
    wrong = uncached(dop853.build(rates, observe).py_func)
    monkeypatch.setitem(solvers.SOLVERS, "dop853", solvers.SOLVERS["dop853"]._replace(run=wrong))


def test_the_right_solver_agrees_with_the_reference(exact):
    assert error(exact) < 1e-10


def test_one_weight_wrong_in_the_seventh_digit_is_seen(wrong_dop853, exact):
    assert error(exact) > 1e-8
