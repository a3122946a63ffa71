"""Ensembles of the chaotic cases and sweeps, and the paper's own runs among them."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.chaos import figures


def draw_ensembles(
    ensembles: str,
    comparison: str,
    png: str,
    pdf: str,
    data: str,
    description: str,
    differs: list[str] | None = None,
) -> None:
    """Draw the bands and the swept maxima, and write what was drawn."""
    drawn = figures.gather_ensembles(read(ensembles), read(comparison))
    save(figures.draw_ensembles(drawn), drawn, png, pdf, data, description, differs)


if __name__ == "__main__":
    from job import run

    run(draw_ensembles, snakemake)  # noqa: F821
