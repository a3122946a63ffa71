"""Draw the proven bound of certified curves with its parts, and the known distance."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.certified import figures


def draw_curves(
    curves: list[str],
    png: str,
    pdf: str,
    data: str,
    description: str,
    differs: list[str] | None = None,
) -> None:
    """Draw the figure, and write what was drawn."""
    drawn = figures.gather_curves([read(path) for path in curves])
    save(figures.draw_curves(drawn), drawn, png, pdf, data, description, differs)


if __name__ == "__main__":
    from job import run

    run(draw_curves, snakemake)  # noqa: F821
