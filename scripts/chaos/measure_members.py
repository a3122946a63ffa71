"""Reduce the members of ensembles of every case to the numbers that sentences are about."""

from pendula.datasets.netcdf import write
from pendula.problem import by_name
from pendula.studies.chaos.members import member_numbers


def measure_members(
    data: str,
    problems: dict[str, dict],
    windows: list[tuple[float, float]],
    members: int,
    size: float,
    seed: int,
    kernels: list[str] | tuple = (),
) -> None:
    """Run `members` of each kind of each case, perturbed by `size`, and write their numbers."""
    write(data, *member_numbers(by_name(problems), windows, size, members, seed))


if __name__ == "__main__":
    from job import run

    run(measure_members, snakemake)  # noqa: F821
