"""Draw how far the expansion is from the pendula."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.pendula.remainder_figure import draw_remainder, gather_remainder


def draw(
    remainder: str,
    png: str,
    pdf: str,
    data: str,
    description: str,
    differs: list[str] | None = None,
) -> None:
    """Draw the figure, and write what was drawn."""
    drawn = gather_remainder(read(remainder))
    save(draw_remainder(drawn), drawn, png, pdf, data, description, differs)


if __name__ == "__main__":
    from job import run

    run(draw, snakemake)  # noqa: F821
