"""kahan_li: its coefficients, its order on driven pendula, and what a symplectic method keeps."""

import numpy as np
import pytest
from latticode.simulation.simulate import simulate
from on_pendula import final, pendula, undriven_energy


def by_steps_of(step, problem):
    return simulate(problem.changed(solver={"name": "kahan_li", "step": step}))


@pytest.mark.parametrize("gamma", [0.0, 0.5])
def test_its_order_is_eight_with_the_drive_and_without(gamma):
    problem = pendula(mu=0.3, gamma=gamma, end_time=2.0, output_step=2.0)
    exact = final(problem)
    errors = [np.abs(by_steps_of(44.4 / n, problem).final - exact).max() for n in (50, 100)]
    assert errors[1] > 1e-12 and 7.6 < np.log2(errors[0] / errors[1]) < 8.6


def test_its_energy_errs_but_does_not_drift():
    alike = {0: (1.0, 1.0), 1: (1j, 1j)}
    problem = pendula(mu=0.3, initial=alike, end_time=200.0, output_step=0.5, snapshot_every=1)
    states = np.moveaxis(by_steps_of(0.5, problem).snapshots, -1, 0)
    energies = np.array([undriven_energy(problem, *state) for state in states])
    spread = np.abs(energies / energies[0] - 1).max()
    halves = energies[:200].mean(), energies[200:].mean()
    assert 1e-9 < spread < 1e-7 and abs(halves[1] / halves[0] - 1) < 0.1 * spread
