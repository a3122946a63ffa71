"""The library's methods, compiled with the kernels of the paper's equations and cached, by name."""

from latticode.simulation.traced import load_runs

from . import amplitudes, pendula
from .equations import AMPLITUDE_MODEL, AMPLITUDES, METHODS_OF, PENDULA, PENDULUM_MODEL

SOLVERS = {
    AMPLITUDES: load_runs(
        amplitudes.__name__, AMPLITUDE_MODEL, [*METHODS_OF[AMPLITUDES], "ode45_real"]
    ),
    PENDULA: load_runs(pendula.__name__, PENDULUM_MODEL, METHODS_OF[PENDULA]),
}
"""The compiled methods of each model; for (4) also ode45 with the error norm of real unknowns."""
