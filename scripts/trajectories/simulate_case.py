"""Integrate one case into its trajectory dataset."""

from pendula import datasets
from pendula.simulation import simulate
from pendula.trajectory_dataset import as_attributes, as_variables, count_work


def simulate_case(trajectory: str, name: str, problem: dict, kernels: str = "") -> None:
    """Simulate `problem` (the arguments of `simulate`) and write its observables."""
    result = simulate(**problem)
    if problem["solver"]["name"] == "crank_nicolson" and result.outcome.rejected:
        print(f"{name}: the iteration did not contract; {result.outcome.rejected} steps were cut")
    datasets.write(
        trajectory,
        as_variables(result, problem["snapshot_every"]),
        {**as_attributes(name, problem), **count_work([result.outcome])},
    )


if __name__ == "__main__":
    from job import run

    run(simulate_case, snakemake)  # noqa: F821
