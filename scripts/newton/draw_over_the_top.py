"""Draw the sea of the pendula, and who leaves it over the top."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.pendula.over_the_top_figure import draw_over_the_top, gather_over_the_top


def draw(
    sea: str,
    over_the_top: str,
    thermal: str,
    png: str,
    pdf: str,
    data: str,
    description: str,
    differs: list[str] | None = None,
) -> None:
    """Draw the figure, and write what was drawn."""
    drawn = gather_over_the_top(*map(read, (sea, over_the_top, thermal)))
    save(draw_over_the_top(drawn), drawn, png, pdf, data, description, differs)


if __name__ == "__main__":
    from job import run

    run(draw, snakemake)  # noqa: F821
