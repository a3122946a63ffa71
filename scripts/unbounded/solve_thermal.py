"""Solve the thermal states with which the bulk behind the front is compared."""

from pendula.datasets.netcdf import write
from pendula.problem import Constants
from pendula.studies.unbounded.extremes import maximum_variables
from pendula.studies.unbounded.thermal import (
    NoStateError,
    ThermalState,
    state_of_energy,
    thermal_variables,
)


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

    Where there is no such state it is left out. The law of the largest modulus is that of the state
    whose Omega is nearest to `bulk_omega`.
    """

    def solved(asked: list[tuple[float, float]]) -> list[ThermalState]:
        found = []
        for omega, energy in asked:
            constants = Constants(epsilon=epsilon, gamma=gamma, omega=omega)
            try:
                found.append(state_of_energy(constants, energy, nodes))
            except NoStateError as error:
                print(f"left out: {error}")
        return found

    states = solved([(omega, 0.0) for omega in omegas])
    warm = solved([(warm_omega, energy) for energy in energies])
    attributes = {
        "title": "Thermal states of the infinite chain, by its transfer operator",
        "epsilon": epsilon, "gamma": gamma, "warm_omega": warm_omega, "nodes": 2 * nodes,
        "density_nodes": 2 * density_nodes,
    }  # fmt: skip
    nearest = min(states, key=lambda one: abs(one.operator.constants.omega - bulk_omega))
    variables = thermal_variables(states, warm, density_nodes)
    write(data, {**variables, **maximum_variables(nearest)}, attributes)


if __name__ == "__main__":
    from job import run

    run(solve_thermal, snakemake)  # noqa: F821
