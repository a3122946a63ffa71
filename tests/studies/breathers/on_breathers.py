"""The breathers that tests start from."""

import numpy as np
from latticode.simulation.simulate import simulate
from pendula.problem import Constants, PaperProblem
from pendula.studies.breathers.periodic import Breather, find_breather

BELOW = Constants(epsilon=1.0, gamma=1.0, omega=-4.0)
ABOVE = Constants(epsilon=1.0, gamma=1.0, omega=8.0)
"""Detunings below and above the band of linear waves: those of Figs 3 and 2."""


def at_twelve(constants: Constants, family: str, half_width: int) -> Breather:
    """Return the breather of a family at the frequency 12."""
    return find_breather(family, constants, 12.0, half_width)


def unfolded(data: np.ndarray) -> np.ndarray:
    """Return even data (component, site 0..M) on the whole chain, (component, site -M..M)."""
    return np.concatenate([data[..., :0:-1], data], axis=-1)


def run_from(constants: Constants, initial: np.ndarray, end_time: float, output_step: float):
    """Run data (component, site -M..M) on their own chain by the Taylor method."""
    return simulate(
        PaperProblem(
            parameters=vars(constants),
            half_width=initial.shape[1] // 2,
            boundary="dirichlet",
            initial=initial.astype(complex),
            end_time=end_time,
            output_step=output_step,
            solver={"name": "taylor", "rtol": 1e-15, "atol": 1e-15},
        )
    )
