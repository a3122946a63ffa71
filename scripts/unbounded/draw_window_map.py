"""Maxima over [10, T] on chains of half-width M, for the sweeps of Figs 5 and 6."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.unbounded import figures


def draw_window_map(
    maps: list[str],
    sweeps: list[str],
    paper_ends: list[float],
    png: str,
    pdf: str,
    data: str,
    description: str,
    differs: list[str] | None = None,
) -> None:
    """Draw the maps, one of each of `sweeps`, and write what was drawn.

    `paper_ends` are the ends T of the windows that the paper draws, in the same order.
    """
    drawn = figures.gather_window_map(dict(zip(sweeps, map(read, maps), strict=True)), paper_ends)
    save(figures.draw_window_map(drawn), drawn, png, pdf, data, description, differs)


if __name__ == "__main__":
    from job import run

    run(draw_window_map, snakemake)  # noqa: F821
