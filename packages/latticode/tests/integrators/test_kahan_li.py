"""kahan_li: its order on driven pendula, and what a symplectic method keeps."""

import numpy as np
import pytest
from latticode import Model, lap
from latticode.equations.initial_values import on_sites
from latticode.simulation.problem import Problem
from latticode.simulation.simulate import simulate

TIGHT = {"name": "taylor", "rtol": 1e-15, "atol": 1e-15}


def pairs(p, x, y):
    drive = p.drive * np.cos(1.6 * p.t)
    return tuple(0.1 * lap(u) - np.sin(u) + drive * (v - u) for u, v in ((x, y), (y, x)))


def chain(x):
    return 0.1 * lap(x) - np.sin(x)


PAIRS = Model(fields=("x", "y"), parameters={"drive": 0.1}, d2_dt2=lambda p, x, y: pairs(p, x, y))
UNDRIVEN = Model(
    fields="x",
    parameters={},
    d2_dt2=lambda p, x: chain(x),
    conserved=lambda p, x, v: {
        "H": 0.5 * v * v + 1.0 - np.cos(x) + 0.05 * (x.right - x) * (x.right - x)
    },
)


def run(model, initial, end_time, outputs, solver, **parameters):
    data = on_sites(initial, len(model.fields))
    return simulate(
        Problem(
            model=model,
            parameters=parameters,
            half_width=2,
            boundary="dirichlet",
            initial=data,
            end_time=end_time,
            output_step=end_time / outputs,
            solver=solver,
        )
    )


def by_steps_of(step):
    return {"name": "kahan_li", "step": step}


@pytest.mark.parametrize("drive", [0.0, 0.1])
def test_its_order_is_eight_with_the_drive_and_without(drive):
    initial = {0: (0.6 + 0.3j, 0.1), 1: (0.2, -0.1j)}
    exact, coarse, fine = (
        run(PAIRS, initial, 44.4, 1, solver, drive=drive).final
        for solver in (TIGHT, by_steps_of(44.4 / 50), by_steps_of(44.4 / 100))
    )
    errors = [np.abs(final - exact).max() for final in (coarse, fine)]
    assert errors[1] > 1e-12 and 7.6 < np.log2(errors[0] / errors[1]) < 8.6


def test_its_energy_errs_but_does_not_drift():
    energies = run(UNDRIVEN, {0: (0.6,), 1: (0.6j,)}, 2000.0, 400, by_steps_of(0.5)).conserved["H"]
    spread = np.abs(energies / energies[0] - 1).max()
    halves = energies[:200].mean(), energies[200:].mean()
    assert 1e-9 < spread < 1e-6 and abs(halves[1] / halves[0] - 1) < 0.1 * spread
