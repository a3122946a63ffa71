"""Which problems of the paper's equations no solver can follow."""

from collections.abc import Mapping

import numpy as np
from latticode.simulation import feasibility
from latticode.simulation.feasibility import Obstacle

from pendula.models.equations import Constants


def find_fault(
    constants: Constants, peak: float, span: float, solver: Mapping, mu: float | None = None
) -> Obstacle | None:
    """Return the key that keeps data of the size `peak` from being followed for a time `span`.

    Both are of the amplitudes; `mu` is that of pendula.
    """
    clock = 1.0 if mu is None else clock_of(mu)
    rates = rates_of(constants, peak, mu)
    return feasibility.find_fault(vars(constants), rates, peak, span, solver, clock)


def clock_of(mu: float) -> float:
    """Return the units of t, in which pendula swing, in one of tau."""
    return 2.0 / (mu * mu) if mu * mu > 0.0 else np.inf


def rates_of(constants: Constants, peak: float, mu: float | None = None) -> dict[str, float]:
    """Return bounds of the relative rates at which data of the size `peak` turn or grow, by key.

    They are per unit of tau. Pendula of (1) swing at the rate 1 per unit of t, and those that go
    over the top turn at a rate of the size of their velocity.
    """
    if mu is not None:
        couplings = {"epsilon": 8.0 * abs(constants.epsilon), "gamma": 8.0 * abs(constants.gamma)}
        swing = {"omega": abs(float(constants.omega)), "mu": clock_of(mu)}
        return couplings | swing | {"initial": 2.0 * mu * peak * clock_of(mu)}
    return {
        "epsilon": 4.0 * abs(constants.epsilon),
        "omega": abs(float(constants.omega)),
        "gamma": 2.0 * abs(constants.gamma),
        "initial": 0.5 * (peak * peak),
    }


def rate(constants: Constants, peak: float, mu: float | None = None) -> float:
    """Return a bound of the relative rate at which data of the size `peak` turn or grow."""
    return sum(rates_of(constants, peak, mu).values())
