"""A solver made slightly wrong is seen: comparison with the reference has the teeth for it."""

from pathlib import Path

import numpy as np
import pytest
from pendula.compiled import uncached
from pendula.datasets.netcdf import read
from pendula.integrators import splitting
from pendula.models.amplitudes import linear_radius, linear_rates, nonlinear_flow
from pendula.simulation import solvers
from pendula.simulation.lattice import Reduction
from pendula.simulation.observables import observe
from pendula.simulation.simulate import simulate
from problems import problem_of

ROOT = Path(__file__).resolve().parents[3]
CASE, TAU = "fig2_large", 5.0
SOLVER = {"name": "splitting", "step": 0.005}


@pytest.fixture(scope="module")
def exact():
    """Return the amplitudes of the multiprecision reference at the end."""
    reference = read(ROOT / f"tests/baseline/reference/{CASE}.nc")
    at = reference["snapshot_tau"].values == TAU
    re, im = reference["amplitude"].isel(snapshot=at).squeeze("snapshot").values
    return re + 1j * im


def error(exact) -> float:
    """Return the largest error of a component at the end."""
    problem = problem_of(CASE, end_time=TAU, output_step=TAU, solver=SOLVER)
    final = simulate(problem, Reduction(even=True, synchronised=False)).final
    return float(np.abs(final - exact).max())


@pytest.fixture
def wrong_splitting(monkeypatch):
    """Put in place of the splitting one whose first weight is wrong in the seventh digit."""
    weights = splitting.NONLINEAR_PARTS.copy()
    weights[0] *= 1.0 + 1e-7
    monkeypatch.setattr(splitting, "NONLINEAR_PARTS", weights)
    # compiled afresh from the plain function: the cached kernel has the right weights built in
    wrong = uncached(splitting.build(linear_rates, linear_radius, nonlinear_flow, observe).py_func)
    changed = solvers.SOLVERS["splitting"]._replace(run=wrong)
    monkeypatch.setitem(solvers.SOLVERS, "splitting", changed)


def test_the_right_solver_agrees_with_the_reference(exact):
    assert error(exact) < 1e-10


def test_one_weight_wrong_in_the_seventh_digit_is_seen(wrong_splitting, exact):
    assert error(exact) > 1e-8
