"""Integrate one case on chains of many half-widths into a sweep dataset."""

from pendula import datasets
from pendula.sweep_dataset import as_variables
from pendula.sweeps import sweep
from pendula.trajectory_dataset import as_attributes, count_work


def sweep_case(
    statistics: str,
    name: str,
    problem: dict,
    half_widths: list[int],
    windows: list[tuple[float, float]],
    kernels: str = "",
) -> None:
    """Sweep `problem` over `half_widths` and write maxima and means over `windows`."""

    def progress(message: str) -> None:
        print(f"{name} ({problem['solver']['name']}): {message}")

    result = sweep(problem, half_widths, windows, progress)
    attributes = as_attributes(name, problem)
    del attributes["half_width"]
    datasets.write(
        statistics,
        as_variables(result, half_widths, windows),
        {**attributes, **count_work(result.outcomes)},
    )


if __name__ == "__main__":
    from job import run

    run(sweep_case, snakemake)  # noqa: F821
