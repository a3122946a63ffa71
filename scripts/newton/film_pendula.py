"""Film the pendula: the angle of each, several times in each period."""

from pendula.datasets.netcdf import write
from pendula.problem import by_name
from pendula.studies.pendula import film


def film_pendula(
    data: str,
    problems: dict[str, dict],
    reach: int,
    periods: int,
    per_period: int,
    kernels: list[str] | tuple = (),
) -> None:
    """Write the films of all problems, of the sites -reach..reach."""
    write(data, *film.film_pendula(by_name(problems), reach, periods, per_period))


if __name__ == "__main__":
    from job import run

    run(film_pendula, snakemake)  # noqa: F821
