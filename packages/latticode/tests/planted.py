"""A lattice with a wrong method, which turns all fields and leaves every modulus as it is."""

import numpy as np
from latticode import Model, abs2, lap
from latticode.simulation.integration import Solver
from latticode.simulation.problem import Problem, on_sites
from latticode.simulation.systems import integration_of

EXTRA_TURN = 1e-3
"""Radians by which the fields are wrong per unit of time."""


def lattice() -> Model:
    """Return a discrete nonlinear Schroedinger equation, whose methods are right."""
    return Model(fields="u", parameters={}, i_dt=lambda p, u: lap(u) + abs2(u) * u)


def problem(model: Model, **changes) -> Problem:
    """Return a regular run of it."""
    return Problem(
        **{
            "model": model,
            "parameters": {},
            "half_width": 6,
            "boundary": "free",
            "initial": on_sites({0: (1.4,), 2: (0.3 + 0.2j,)}, 1),
            "end_time": 10.0,
            "output_step": 0.1,
            "solver": {"name": "taylor", "rtol": 1e-14, "atol": 1e-14},
        }
        | changes
    )


def with_wrong(names=("taylor",), model: Model | None = None, rate: float = EXTRA_TURN) -> Model:
    """Return the lattice with wrong methods of these names, which turn the fields too fast."""
    model = model or lattice()
    right = integration_of(problem(model))
    solvers = dict(right.solvers)
    for name in names:
        solvers[name] = turned(solvers[name], rate)
    model.integration = right._replace(solvers=solvers)
    return model


def turned(solver: Solver, rate: float) -> Solver:
    """Return a solver whose fields turn by `rate` a unit of time more than they should."""

    def run(system, y, times, controls, work, record, stop):
        outcome = solver.run(system, y, times, controls, work, record, stop)
        y[0::2], y[1::2] = rotated(y[0::2], y[1::2], rate * times[-1])
        if record.every:
            kept = record.kept
            kept[0], kept[1] = rotated(kept[0], kept[1], rate * times[:: record.every])
        return outcome

    return solver._replace(run=run)


def rotated(real, imaginary, angle):
    """Return both parts of fields that are turned by an angle."""
    turn = np.exp(-1j * angle)
    fields = (real + 1j * imaginary) * turn
    return fields.real.copy(), fields.imag.copy()
