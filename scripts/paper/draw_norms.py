"""Figs 2 to 4: norms of A and B against time beside the true ones, and where the chain moves."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.paper import figures


def draw_norms(
    small: str,
    large: str,
    references: list[str],
    ensembles: list[str],
    norms: list[str],
    spacetime: list[str],
    differs: list[str] | None = None,
) -> None:
    """Draw small and large data with the true norms of `references`, and write what was drawn.

    `ensembles` names the dataset with the ensemble of either case, if there is one.
    `norms` and `spacetime` are the files of the two figures: PNG, PDF, data, description.
    """
    trajectories = [read(small), read(large)]
    bands = read(ensembles[0]) if ensembles else None
    drawn = figures.gather_norms(trajectories, [read(path) for path in references], bands)
    save(figures.draw_norms(drawn), drawn, *norms, differs)
    drawn = figures.gather_spacetime(trajectories, drawn)
    save(figures.draw_spacetime(drawn), drawn, *spacetime, differs)


if __name__ == "__main__":
    from job import run

    run(draw_norms, snakemake)  # noqa: F821
