"""Measure the state that fills the chain, of pendula beside that of the amplitudes."""

from pendula.datasets.netcdf import write
from pendula.problem import Problem
from pendula.studies.pendula import sea


def measure_sea(
    data: str,
    problem: dict,
    mus: list[float],
    window: tuple[float, float],
    size: float,
    members: int,
    seed: int,
    kernels: list[str] | tuple = (),
) -> None:
    """Write mean norms, spectra and distributions of members at each mu."""
    write(data, *sea.measure_sea(Problem.of(problem), mus, window, size, members, seed))


if __name__ == "__main__":
    from job import run

    run(measure_sea, snakemake)  # noqa: F821
