"""Draw which of almost equal data spread."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.breathers.figures import draw_sensitivity, gather_sensitivity


def draw(
    sensitivity: str,
    png: str,
    pdf: str,
    data: str,
    description: str,
    differs: list[str] | None = None,
) -> None:
    """Draw the figure, and write what was drawn."""
    drawn = gather_sensitivity(read(sensitivity))
    save(draw_sensitivity(drawn), drawn, png, pdf, data, description, differs)


if __name__ == "__main__":
    from job import run

    run(draw, snakemake)  # noqa: F821
