"""Find the steady states of the chain, where they are born, and where they are stable."""

from pendula.datasets.netcdf import write
from pendula.studies.breathers.contents import steady_contents


def find_steady(
    data: str,
    epsilon: float,
    gamma: float,
    omegas: list[float],
    half_width: int,
    searched: dict[str, tuple[float, float]],
    distance: float,
) -> None:
    """Write all families at each Omega; rates of growth are also found on half of `half_width`."""
    write(data, *steady_contents(epsilon, gamma, omegas, half_width // 2, searched, distance))


if __name__ == "__main__":
    from job import run

    run(find_steady, snakemake)  # noqa: F821
