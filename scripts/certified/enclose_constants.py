"""Enclose the constants of the paper's theorems, beside what the study of the theory stored."""

from collections.abc import Mapping

from pendula.datasets.netcdf import read, write
from pendula.problem import Problem
from pendula.studies.certified.constants import constants_contents


def enclose_constants(
    datasets: list[str], data: str, names: list[str], problems: dict[str, Mapping], theory: dict
) -> None:
    """Write the enclosures; `names` are those of the datasets, `problems` are plain values."""
    given = {name: read(path) for name, path in zip(names, datasets, strict=True)}
    cases = {case: Problem.of(problem) for case, problem in problems.items()}
    write(data, *constants_contents(cases, theory, given))


if __name__ == "__main__":
    from job import run

    run(enclose_constants, snakemake)  # noqa: F821
