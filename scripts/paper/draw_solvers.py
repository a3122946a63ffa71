"""The paper's two solvers against one of high order: energy, agreement, and both in numbers."""

from itertools import product

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.paper import solver_figures


def draw_solvers(
    trajectories: list[str],
    cases: list[str],
    solvers: list[str],
    energy_png: str,
    energy_pdf: str,
    energy_data: str,
    png: str,
    pdf: str,
    data: str,
) -> None:
    """Draw the drift of the energy and the differences; `trajectories` run over cases, solvers."""
    names = product(cases, solvers)
    runs = dict(zip(names, map(read, trajectories), strict=True))
    drawn = solver_figures.gather_drift(runs)
    save(solver_figures.draw_drift(drawn), drawn, energy_png, energy_pdf, energy_data)
    drawn = solver_figures.gather_agreement(runs)
    save(solver_figures.draw_agreement(drawn), drawn, png, pdf, data)


if __name__ == "__main__":
    from job import run

    run(draw_solvers, snakemake)  # noqa: F821
