"""Draw the families of periodic breathers, and how the drive feeds a localised motion."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.breathers.figures import draw_breathers, gather_breathers


def draw(
    periodic: str,
    growth: str,
    png: str,
    pdf: str,
    data: str,
    description: str,
    differs: list[str] | None = None,
) -> None:
    """Draw the figure, and write what was drawn."""
    drawn = gather_breathers(read(periodic), read(growth))
    save(draw_breathers(drawn), drawn, png, pdf, data, description, differs)


if __name__ == "__main__":
    from job import run

    run(draw, snakemake)  # noqa: F821
