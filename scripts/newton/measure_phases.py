"""Follow the cases of the paper as pendula at several mu."""

from pendula.datasets.netcdf import write
from pendula.problem import by_name
from pendula.studies.pendula import phases


def measure_phases(
    data: str,
    problems: dict[str, dict],
    mus: list[float],
    look_every: int,
    ensemble: dict,
    kernels: list[str] | tuple = (),
) -> None:
    """Write norms and space-time pictures of each case, by the amplitudes and at each mu.

    `ensemble` names a case and a number of members. At the largest mu these members are compared
    with the bound of Theorem 1.
    """
    write(data, *phases.measure_phases(by_name(problems), mus, look_every, **ensemble))


if __name__ == "__main__":
    from job import run

    run(measure_phases, snakemake)  # noqa: F821
