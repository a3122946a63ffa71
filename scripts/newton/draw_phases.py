"""Draw the paper's phases in the real pendula."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.pendula.phases_figure import draw_phases, gather_phases


def draw(
    phases: str, png: str, pdf: str, data: str, description: str, differs: list[str] | None = None
) -> None:
    """Draw the figure, and write what was drawn."""
    drawn = gather_phases(read(phases))
    save(draw_phases(drawn), drawn, png, pdf, data, description, differs)


if __name__ == "__main__":
    from job import run

    run(draw, snakemake)  # noqa: F821
