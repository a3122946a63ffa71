"""Whether a solver can integrate a problem of the paper's equations."""

from collections.abc import Mapping

import numpy as np
from latticode.simulation import feasibility
from latticode.simulation.feasibility import Obstacle

from pendula.models.equations import Constants


def find_fault(
    constants: Constants, peak: float, span: float, solver: Mapping, mu: float | None = None
) -> Obstacle | None:
    """Return the key that prevents the integration of a problem and the reason, or None.

    `peak` bounds the initial amplitudes, `span` is the duration in tau, and only pendula have `mu`.
    """
    clock = 1.0 if mu is None else clock_of(mu)
    rates = rates_of(constants, peak, mu)
    return feasibility.find_fault(vars(constants), rates, peak, span, solver, clock)


def clock_of(mu: float) -> float:
    """Return dt/dtau = 2 / mu^2."""
    return 2.0 / (mu * mu) if mu * mu > 0.0 else np.inf


def rates_of(constants: Constants, peak: float, mu: float | None = None) -> dict[str, float]:
    """Return bounds on relative rates of change per unit of tau, by the key that causes them.

    The amplitudes are at most `peak`. Pendula of (1) swing at the rate 1 per unit of t; over the
    top they rotate at about their velocity.
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
    """Return a bound on the relative rate of change of amplitudes up to `peak`, per unit of tau."""
    return sum(rates_of(constants, peak, mu).values())
