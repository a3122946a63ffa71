"""Theorems 1 to 3: the largest norms that were seen against their bounds."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.theory import figures


def draw_bounds(
    cases: str, sweeps: str, samples: str, worst: str, png: str, pdf: str, data: str
) -> None:
    """Draw the cases, the sweeps and the data drawn at random, and write what was drawn."""
    drawn = figures.gather_bounds(read(cases), read(sweeps), read(samples), read(worst))
    save(figures.draw_bounds(drawn), drawn, png, pdf, data)


if __name__ == "__main__":
    from job import run

    run(draw_bounds, snakemake)  # noqa: F821
