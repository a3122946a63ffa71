"""Lyapunov exponents and divergence times, and how evenness is lost in every case."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.chaos import figures


def draw_chaos(
    lyapunov: str,
    symmetry: str,
    png: str,
    pdf: str,
    data: str,
    description: str,
    symmetry_png: str,
    symmetry_pdf: str,
    symmetry_data: str,
    symmetry_description: str,
) -> None:
    """Draw the exponents, then the odd parts beside what the exponents predict."""
    growth = read(lyapunov)
    drawn = figures.gather_lyapunov(growth)
    save(figures.draw_lyapunov(drawn), drawn, png, pdf, data, description)
    drawn = figures.gather_symmetry(read(symmetry), growth)
    save(
        figures.draw_symmetry(drawn),
        drawn,
        symmetry_png,
        symmetry_pdf,
        symmetry_data,
        symmetry_description,
    )


if __name__ == "__main__":
    from job import run

    run(draw_chaos, snakemake)  # noqa: F821
