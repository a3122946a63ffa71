"""How long the central pendulum stays localised, against its initial amplitude."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.chaos.lifetimes_figure import draw_lifetimes, gather_lifetimes


def draw(
    lifetimes: str,
    png: str,
    pdf: str,
    data: str,
    description: str,
    differs: list[str] | None = None,
) -> None:
    """Draw the figure, and write what was drawn."""
    drawn = gather_lifetimes(read(lifetimes))
    save(draw_lifetimes(drawn), drawn, png, pdf, data, description, differs)


if __name__ == "__main__":
    from job import run

    run(draw, snakemake)  # noqa: F821
