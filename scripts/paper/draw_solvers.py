"""The paper's two solvers against one of high order: drift of the energy, and agreement."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.paper import figures


def draw_solvers(
    solvers: str,
    energy_png: str,
    energy_pdf: str,
    energy_data: str,
    energy_description: str,
    png: str,
    pdf: str,
    data: str,
    description: str,
) -> None:
    """Draw the drift of the energy and the differences of the norms, as they were measured."""
    measured = read(solvers)
    drawn = figures.gather_drift(measured)
    save(figures.draw_drift(drawn), drawn, energy_png, energy_pdf, energy_data, energy_description)
    drawn = figures.gather_agreement(measured)
    save(figures.draw_agreement(drawn), drawn, png, pdf, data, description)


if __name__ == "__main__":
    from job import run

    run(draw_solvers, snakemake)  # noqa: F821
