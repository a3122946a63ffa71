"""Maxima of the norms over [10, T] on chains of half-width M: the map over (M, T)."""

import numpy as np
from job import step
from pendula.datasets.netcdf import write
from pendula.problem import Problem
from pendula.studies.unbounded.long_runs import (
    START,
    Ensemble,
    attributes,
    map_variables,
    member,
    window_map,
)


def map_windows(
    data: str,
    name: str,
    problem: dict,
    rest: float,
    half_widths: list[int],
    members: int,
    perturbation: float,
    seed: int,
    kernels: list[str] | tuple = (),
) -> None:
    """Write the maxima of an ensemble for every T between 10 and the end of the runs."""
    whole = Problem.of(problem)
    ends = np.arange(START + 2.0, whole.end_time + 1.0, 2.0)
    maps, ensemble = [], Ensemble(members, perturbation, seed)
    for number in range(members):
        started = whole.changed(initial=member(whole.initial, ensemble, number))
        maps.append(window_map(started, rest, half_widths, ends))
        step(f"{name}: member {number + 1} of {members} done")
    title = f"Maxima of the norms over half-widths and time windows, case of {name}"
    about = attributes(title, name, [whole], rest, ensemble)
    write(data, map_variables(maps, half_widths, ends, whole), about)


if __name__ == "__main__":
    from job import run

    run(map_windows, snakemake)  # noqa: F821
