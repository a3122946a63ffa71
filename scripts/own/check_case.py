"""Set one case beside the paper's statements, and measure how far its run can be trusted."""

from pendula.datasets.netcdf import read, save
from pendula.own_cases.checks import check_run
from pendula.problem import Problem


def check_case(run: str, problem: dict, checks: str, kernels: list[str] | tuple = ()) -> None:
    """Check the trajectory `run` of `problem` (plain values of a Problem)."""
    save(checks, check_run(Problem.of(problem), read(run)))


if __name__ == "__main__":
    from job import run

    run(check_case, snakemake)  # noqa: F821
