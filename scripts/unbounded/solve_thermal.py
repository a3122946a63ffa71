"""Solve the thermal states with which the bulk behind the front is compared."""

import numpy as np
from pendula.datasets.netcdf import write
from pendula.problem import Constants
from pendula.studies.unbounded.extremes import maximum_variables
from pendula.studies.unbounded.thermal import state_of_energy, thermal_variables


def solve_thermal(
    data: str,
    epsilon: float,
    gamma: float,
    omegas: list[float],
    bulk_omega: float,
    warm_omega: float,
    energies: list[float],
    nodes: int,
    density_nodes: int,
) -> None:
    """Write the states without energy at all `omegas`, and those of `energies` at `warm_omega`.

    The law of the largest modulus is that of the state whose Omega is nearest to `bulk_omega`.
    """

    def solve(omega: float, energy: float = 0.0):
        constants = Constants(epsilon=epsilon, gamma=gamma, omega=omega)
        return state_of_energy(constants, energy, nodes)

    states = [solve(omega) for omega in omegas]
    warm = [solve(warm_omega, energy) for energy in energies]
    attributes = {
        "title": "Thermal states of the infinite chain, by its transfer operator",
        "epsilon": epsilon, "gamma": gamma, "warm_omega": warm_omega, "nodes": 2 * nodes,
        "density_nodes": 2 * density_nodes,
    }  # fmt: skip
    nearest = states[int(np.abs(np.array(omegas) - bulk_omega).argmin())]
    variables = thermal_variables(states, warm, density_nodes)
    write(data, {**variables, **maximum_variables(nearest)}, attributes)


if __name__ == "__main__":
    from job import run

    run(solve_thermal, snakemake)  # noqa: F821
