"""Integrate one case on chains of many half-widths, by one solver or several."""

from job import step
from pendula.datasets.netcdf import write
from pendula.datasets.trajectories import sweep_contents
from pendula.problem import Problem
from pendula.simulation.sweep import sweep


def sweep_case(
    datasets: list[str],
    name: str,
    problems: list[dict],
    half_widths: list[int],
    windows: list[tuple[float, float]],
    kernels: list[str] | tuple = (),
) -> None:
    """Sweep each of `problems` over `half_widths`; write maxima and means over `windows`."""
    for path, problem in zip(datasets, map(Problem.of, problems), strict=True):
        label = f"{name} ({problem.solver['name']})"
        result = sweep(problem, half_widths, windows, lambda done, at=label: step(f"{at}: {done}"))
        write(path, *sweep_contents(name, problem, half_widths, windows, result))


if __name__ == "__main__":
    from job import run

    run(sweep_case, snakemake)  # noqa: F821
