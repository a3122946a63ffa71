"""The speed of the front over Omega, and the bulk behind it."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.unbounded import front_figure


def draw_front(
    front: str, png: str, pdf: str, data: str, description: str, differs: list[str] | None = None
) -> None:
    """Draw the measured front, and write what was drawn."""
    drawn = front_figure.gather_front(read(front))
    save(front_figure.draw_front(drawn), drawn, png, pdf, data, description, differs)


if __name__ == "__main__":
    from job import run

    run(draw_front, snakemake)  # noqa: F821
