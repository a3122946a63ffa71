"""Maxima over [10, T] on chains of half-width M, for the sweeps of Figs 5 and 6."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.unbounded import figures


def draw_window_map(maps: list[str], sweeps: list[str], png: str, pdf: str, data: str) -> None:
    """Draw the maps, one of each of `sweeps`, and write what was drawn."""
    drawn = figures.gather_window_map(dict(zip(sweeps, map(read, maps), strict=True)))
    save(figures.draw_window_map(drawn), drawn, png, pdf, data)


if __name__ == "__main__":
    from job import run

    run(draw_window_map, snakemake)  # noqa: F821
