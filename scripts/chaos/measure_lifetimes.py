"""Measure how long the central pendulum stays localised, against its initial amplitude."""

from pendula.datasets.netcdf import write
from pendula.problem import Problem
from pendula.studies.chaos.lifetimes import compare_numerics, localised, measure_lives


def measure_lifetimes(
    data: str,
    problem: dict,
    amplitudes: list[float],
    ratio: float,
    compared: float,
    choices: list[tuple[float, str]],
    size: float,
    members: int,
    settled: float,
    seed: int,
    kernels: list[str] | tuple = (),
) -> None:
    """Follow `members` from each of `amplitudes`; then one amplitude with each of `choices`."""
    given, drawn = Problem.of(problem), (size, members, settled, seed)
    lives, attributes = measure_lives(given, amplitudes, ratio, *drawn)
    numerics = compare_numerics(localised(given, compared, ratio), choices, *drawn, lives)
    write(data, lives | numerics, {**attributes, "ratio": ratio})


if __name__ == "__main__":
    from job import run

    run(measure_lifetimes, snakemake)  # noqa: F821
