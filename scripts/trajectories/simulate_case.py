"""Integrate one case, by one solver or by several, into a trajectory dataset each."""

from pendula.datasets.netcdf import write
from pendula.datasets.trajectories import trajectory_contents
from pendula.problem import Problem
from pendula.simulation.simulate import simulate


def simulate_case(
    datasets: list[str], name: str, problems: list[dict], kernels: list[str] | tuple = ()
) -> None:
    """Simulate each of `problems` (plain values of a Problem) and write its observables."""
    for path, problem in zip(datasets, map(Problem.of, problems), strict=True):
        result = simulate(problem)
        if "iterations" in problem.solver and result.outcome.rejected:
            cut = result.outcome.rejected
            print(f"{name}: the iteration did not contract; {cut} steps were cut")
        write(path, *trajectory_contents(name, problem, result))


if __name__ == "__main__":
    from job import run

    run(simulate_case, snakemake)  # noqa: F821
