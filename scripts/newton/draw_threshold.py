"""Draw the chart of Lemma 1 for the pendula."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.pendula.threshold_figure import draw_threshold, gather_threshold


def draw(
    threshold: str,
    png: str,
    pdf: str,
    data: str,
    description: str,
    differs: list[str] | None = None,
) -> None:
    """Draw the figure, and write what was drawn."""
    drawn = gather_threshold(read(threshold))
    save(draw_threshold(drawn), drawn, png, pdf, data, description, differs)


if __name__ == "__main__":
    from job import run

    run(draw, snakemake)  # noqa: F821
