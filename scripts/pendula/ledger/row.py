"""A row of the ledger, declared above the function that decides it."""

from collections.abc import Callable
from typing import NamedTuple


class Claim(NamedTuple):
    """One sentence of the paper before it is decided.

    `needs` names the datasets that decide it: paths below results/ without their ending.
    """

    name: str
    place: str
    says: str
    needs: tuple[str, ...]
    decide: Callable


def claim(name: str, place: str, says: str, needs: tuple[str, ...]) -> Callable:
    """Return a decorator: the function, which takes the datasets in `needs`, decides this row."""

    def declare(function: Callable) -> Callable:
        function.claim = Claim(name, place, says, needs, function)
        return function

    return declare


def checks(*names: str) -> tuple[str, ...]:
    """Return the datasets of checks."""
    return tuple(f"checks/{name}" for name in names)


def runs(*names: str) -> tuple[str, ...]:
    """Return the datasets of trajectories."""
    return tuple(f"trajectories/{name}" for name in names)


def sweeps(*names: str) -> tuple[str, ...]:
    """Return the datasets of sweeps."""
    return tuple(f"sweeps/{name}" for name in names)


def unbounded(*names: str) -> tuple[str, ...]:
    """Return the datasets of runs on chains without ends."""
    return tuple(f"unbounded/{name}" for name in names)


def by_second(*datasets: str) -> tuple[str, ...]:
    """Return the same datasets by the paper's second solver."""
    return tuple(f"{dataset}.crank_nicolson" for dataset in datasets)


SMALL = runs("fig2_small", "fig3_small", "fig4_small")
LARGE = runs("fig2_large", "fig3_large", "fig4_large")
SWEEPS = sweeps("fig5_left", "fig5_right", "fig6_left", "fig6_right")
