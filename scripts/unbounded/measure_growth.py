"""Measure the chains without ends: growth laws of the norms, the front, the bulk behind it."""

from pendula.datasets.netcdf import read, save
from pendula.studies.unbounded.front import measure_front
from pendula.studies.unbounded.long_runs import measure_growth


def measure(
    runs: list[str],
    cases: list[str],
    omegas: str,
    bulk: str,
    large: str,
    thermal: str,
    growth: str,
    front: str,
) -> None:
    """Write `growth` of the runs, one of each of `cases`, and `front`.

    `omegas` are runs over Omega; `bulk` and `large` are the two whose bulk is looked at, in an
    unstable and in a stable chain at rest; `thermal` are the states that it is compared with.
    """
    states = read(thermal)
    save(growth, measure_growth(dict(zip(cases, map(read, runs), strict=True)), states))
    save(front, measure_front(read(omegas), read(bulk), read(large), states))


if __name__ == "__main__":
    from job import run

    run(measure, snakemake)  # noqa: F821
