"""Maxima of the norms over [10, T] on chains of half-width M: the map over (M, T)."""

from functools import partial

import numpy as np
from job import step
from pendula.datasets.netcdf import write
from pendula.problem import Problem
from pendula.studies.unbounded.long_runs import (
    START,
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
    kernels: list[str] | tuple = (),
) -> None:
    """Write the maxima of an ensemble for every T between 10 and the end of the runs."""
    whole = Problem.of(problem)
    ends = np.arange(START + 2.0, whole.end_time + 1.0, 2.0)
    maps = []
    for number in range(members):
        started = whole.changed(initial=member(whole.initial, number))
        label = f"{name}, member {number + 1} of {members}"
        tell = partial(tell_step, label)
        maps.append(window_map(started, rest, half_widths, ends, tell))
    title = f"Maxima of the norms over half-widths and time windows, case of {name}"
    about = attributes(title, name, [whole], rest, members)
    write(data, map_variables(maps, half_widths, ends, whole), about)


def tell_step(label: str, done: str) -> None:
    """Say how far one member is."""
    step(f"{label}: {done}")


if __name__ == "__main__":
    from job import run

    run(map_windows, snakemake)  # noqa: F821
