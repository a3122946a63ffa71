"""Norms on chains without ends against time, and the exponents of time that they follow."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.unbounded import figures


def draw_growth_law(
    growth: str, png: str, pdf: str, data: str, description: str, differs: list[str] | None = None
) -> None:
    """Draw the measured growth, and write what was drawn."""
    drawn = read(growth)
    save(figures.draw_growth_law(drawn), drawn, png, pdf, data, description, differs)


if __name__ == "__main__":
    from job import run

    run(draw_growth_law, snakemake)  # noqa: F821
