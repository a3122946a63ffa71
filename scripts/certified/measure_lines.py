"""Find until when the printed lines of Figs 2 to 4 contain the true curves."""

from pendula.datasets.netcdf import read, save
from pendula.studies.certified.lines import contain


def measure_lines(
    trajectories: list[str],
    references: list[str],
    proved: list[str],
    cases: list[str],
    certified: list[str],
    data: str,
) -> None:
    """Write the dataset; `trajectories` and `references` run over `cases`.

    `proved` are the curves of the cases `certified`, each with its bound.
    """
    runs = dict(zip(cases, map(read, trajectories), strict=True))
    known = dict(zip(cases, map(read, references), strict=True))
    curves = dict(zip(certified, map(read, proved), strict=True))
    save(data, contain(runs, curves, known))


if __name__ == "__main__":
    from job import run

    run(measure_lines, snakemake)  # noqa: F821
