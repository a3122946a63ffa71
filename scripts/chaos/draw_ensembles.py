"""Ensembles of the chaotic cases and sweeps, and the paper's own runs among them."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.chaos import figures


def draw_ensembles(
    ensembles: str,
    runs: list[str],
    references: list[str],
    cases: list[str],
    sweeps: list[str],
    windows: dict[str, str],
    png: str,
    pdf: str,
    data: str,
) -> None:
    """Draw the runs of `cases` and the sweeps named in `windows`, both in the order of paths."""
    trajectories = dict(zip(cases, map(read, runs), strict=True))
    truths = dict(zip(cases, map(read, references), strict=True))
    swept = dict(zip(windows, map(read, sweeps), strict=True))
    drawn = figures.gather_ensembles(read(ensembles), trajectories, truths, swept, windows)
    save(figures.draw_ensembles(drawn), drawn, png, pdf, data)


if __name__ == "__main__":
    from job import run

    run(draw_ensembles, snakemake)  # noqa: F821
