"""Lyapunov exponents and divergence times, and how evenness is lost in every case."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.chaos import figures


def draw_chaos(
    lyapunov: str,
    symmetry: str,
    exponents: list[str],
    odd_parts: list[str],
    differs: list[str] | None = None,
) -> None:
    """Draw the exponents, then the odd parts beside what the exponents predict."""
    growth = read(lyapunov)
    drawn = figures.gather_lyapunov(growth)
    save(figures.draw_lyapunov(drawn), drawn, *exponents, differs)
    drawn = figures.gather_symmetry(read(symmetry), growth)
    save(figures.draw_symmetry(drawn), drawn, *odd_parts, differs)


if __name__ == "__main__":
    from job import run

    run(draw_chaos, snakemake)  # noqa: F821
