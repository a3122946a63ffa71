"""What is measured of the chains without ends, and the thermal states that it is compared with."""

from collections.abc import Iterator, Mapping

import xarray as xr

from pendula.datasets.trajectories import Contents
from pendula.problem import Constants

from .extremes import maximum_variables
from .front import measure_front
from .long_runs import measure_growth
from .thermal import NoStateError, ThermalState, state_of_energy, thermal_variables


def measure(
    runs: Mapping[str, xr.Dataset],
    omegas: xr.Dataset,
    bulk: xr.Dataset,
    large: xr.Dataset,
    thermal: xr.Dataset,
) -> Iterator[xr.Dataset]:
    """Yield the growth of `runs`, which are by case, and the front.

    `omegas` are runs over Omega; `bulk` and `large` are the two whose bulk is looked at, in an
    unstable and in a stable chain at rest; `thermal` are the states that it is compared with.
    """
    yield measure_growth(runs, thermal)
    yield measure_front(omegas, bulk, large, thermal)


def solve_thermal(
    epsilon: float, gamma: float, omegas: list[float], bulk_omega: float, warm_omega: float,
    energies: list[float], nodes: int, density_nodes: int,
) -> Contents:  # fmt: skip
    """Return the states without energy at all `omegas`, and those of `energies` at `warm_omega`.

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
    return {**variables, **maximum_variables(nearest)}, attributes
