"""A lattice with a wrong method, which turns all fields and leaves every modulus as it is."""

import numpy as np
from latticode import Model, abs2, lap
from latticode.equations.initial_values import on_sites
from latticode.simulation.equations import CompiledMethod
from latticode.simulation.problem import Problem
from latticode.simulation.traced import TracedEquations

EXTRA_TURN = 1e-3
"""Radians by which the fields are wrong per unit of time."""


def lattice() -> Model:
    """Return a discrete nonlinear Schroedinger equation, whose methods are right."""
    return Model(fields="u", parameters={}, i_dt=lambda p, u: lap(u) + abs2(u) * u)


def problem(equations_class: type[TracedEquations] = TracedEquations, **changes) -> Problem:
    """Return a regular run of it, integrated by a class of equations."""

    class Planted(Problem):
        @property
        def equations(self):
            return equations_class(self)

    return Planted(
        **{
            "model": lattice(),
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


def with_wrong(
    *names: str, equations: type[TracedEquations] = TracedEquations, rate: float = EXTRA_TURN
) -> type[TracedEquations]:
    """Return equations whose methods of these names are wrong, and turn the fields too fast."""

    class WrongEquations(equations):
        def compiled(self, name):
            compiled = super().compiled(name)
            return turned(compiled, rate) if name in names else compiled

    return WrongEquations


def turned(compiled: CompiledMethod, rate: float) -> CompiledMethod:
    """Return a method whose fields turn by `rate` a unit of time more than they should."""

    def run(system, y, times, controls, work, record, stop):
        outcome = compiled.run(system, y, times, controls, work, record, stop)
        y[0::2], y[1::2] = rotated(y[0::2], y[1::2], rate * times[-1])
        if record.every:
            states = record.snapshots
            states[0], states[1] = rotated(states[0], states[1], rate * times[:: record.every])
        return outcome

    return compiled._replace(run=run)


def rotated(real, imaginary, angle):
    """Return both parts of fields that are turned by an angle."""
    turn = np.exp(-1j * angle)
    fields = (real + 1j * imaginary) * turn
    return fields.real.copy(), fields.imag.copy()
