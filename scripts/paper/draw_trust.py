"""Until when each solver's trajectories are those of the multiprecision references."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.paper import figures


def draw_trust(
    trust: str, png: str, pdf: str, data: str, description: str, differs: list[str] | None = None
) -> None:
    """Draw the errors of the solvers' norms, as they were measured."""
    drawn = figures.gather_trust(read(trust))
    save(figures.draw_trust(drawn), drawn, png, pdf, data, description, differs)


if __name__ == "__main__":
    from job import run

    run(draw_trust, snakemake)  # noqa: F821
