"""Measure how even data lose their evenness: by rounding, and by small odd perturbations."""

from pendula.datasets.netcdf import write
from pendula.problem import by_name
from pendula.studies.chaos.symmetry import odd_parts


def measure_symmetry(
    data: str,
    problems: dict[str, dict],
    size: float,
    members: int,
    seed: int,
    step: float,
    kernels: list[str] | tuple = (),
) -> None:
    """Follow the odd part of each case at each `step`, alone and perturbed by relative `size`."""
    write(data, *odd_parts(by_name(problems), size, members, seed, step))


if __name__ == "__main__":
    from job import run

    run(measure_symmetry, snakemake)  # noqa: F821
