"""Measure what the scheme and the step of the second solver decide, in every case."""

from pendula.datasets.netcdf import read, write
from pendula.problem import Problem, by_name
from pendula.studies.paper.second_solver import measure


def measure_second_solver(
    firsts: list[str],
    problems: dict[str, dict],
    swept: dict,
    half_widths: list[int],
    windows: list[tuple[float, float]],
    ensemble: dict[str, float],
    data: str,
    kernels: list[str] | tuple = (),
) -> None:
    """Write the dataset; `firsts` are the runs of the first solver in the order of `problems`."""
    runs = dict(zip(problems, map(read, firsts), strict=True))
    sweep = Problem.of(swept), half_widths, windows, ensemble
    write(data, *measure(by_name(problems), runs, *sweep))


if __name__ == "__main__":
    from job import run

    run(measure_second_solver, snakemake)  # noqa: F821
