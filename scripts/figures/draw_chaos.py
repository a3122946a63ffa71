"""Lyapunov exponents and parting times, and how evenness is lost in every case."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.chaos import figure_lyapunov as exponents
from pendula.studies.chaos import figure_symmetry as odd_part


def draw_chaos(
    lyapunov: str,
    symmetry: str,
    png: str,
    pdf: str,
    data: str,
    symmetry_png: str,
    symmetry_pdf: str,
    symmetry_data: str,
) -> None:
    """Draw the exponents, then the odd parts beside what the exponents predict."""
    growth = read(lyapunov)
    drawn = exponents.gather(growth)
    save(exponents.draw(drawn), drawn, png, pdf, data)
    drawn = odd_part.gather(read(symmetry), growth)
    save(odd_part.draw(drawn), drawn, symmetry_png, symmetry_pdf, symmetry_data)


if __name__ == "__main__":
    from job import run

    run(draw_chaos, snakemake)  # noqa: F821
