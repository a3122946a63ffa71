"""The paper's two solvers against one of high order: drift of the energy, and agreement."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.paper import figures


def draw_solvers(
    solvers: str,
    energy: list[str],
    agreement: list[str],
    differs: list[str] | None = None,
) -> None:
    """Draw the drift of the energy and the differences of the norms, as they were measured."""
    measured = read(solvers)
    drawn = figures.gather_drift(measured)
    save(figures.draw_drift(drawn), drawn, *energy, differs)
    drawn = figures.gather_agreement(measured)
    save(figures.draw_agreement(drawn), drawn, *agreement, differs)


if __name__ == "__main__":
    from job import run

    run(draw_solvers, snakemake)  # noqa: F821
