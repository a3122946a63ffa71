"""Theorems 1 to 3: the largest norms that were seen against their bounds."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.theory import bounds_figure


def draw_bounds(
    cases: str,
    sweeps: str,
    samples: str,
    worst: str,
    sharpness: str,
    growth: str,
    png: str,
    pdf: str,
    data: str,
    description: str,
    differs: list[str] | None = None,
) -> None:
    """Draw the cases, the sweeps and what data reach, and write what was drawn."""
    found = map(read, (cases, sweeps, samples, worst, sharpness, growth))
    drawn = bounds_figure.gather_bounds(*found)
    save(bounds_figure.draw_bounds(drawn), drawn, png, pdf, data, description, differs)


if __name__ == "__main__":
    from job import run

    run(draw_bounds, snakemake)  # noqa: F821
