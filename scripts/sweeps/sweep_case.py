"""Integrate one case on chains of many half-widths, by one solver or several."""

from pendula.datasets import write
from pendula.sweep_dataset import as_variables
from pendula.sweeps import sweep
from pendula.trajectory_dataset import as_attributes, count_work


def sweep_case(
    datasets: list[str],
    name: str,
    problems: list[dict],
    half_widths: list[int],
    windows: list[tuple[float, float]],
    kernels: list[str] | tuple = (),
) -> None:
    """Sweep each of `problems` over `half_widths`; write maxima and means over `windows`."""
    for path, problem in zip(datasets, problems, strict=True):
        label = f"{name} ({problem['solver']['name']})"
        result = sweep(problem, half_widths, windows, lambda done, at=label: print(f"{at}: {done}"))
        attributes = as_attributes(name, problem, problem["solver"])
        del attributes["half_width"]
        write(
            path,
            as_variables(result, half_widths, windows),
            {**attributes, **count_work(result.outcomes)},
        )


if __name__ == "__main__":
    from job import run

    run(sweep_case, snakemake)  # noqa: F821
