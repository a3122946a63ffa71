"""Figs 5 and 6: norms over a window of time against the half-width of the chain."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.paper import figures


def draw_sweeps(
    left: str,
    right: str,
    text_window: str,
    caption_window: str,
    norms: list[str],
    ensembles: list[str],
    png: str,
    pdf: str,
    data: str,
    description: str,
    differs: list[str] | None = None,
) -> None:
    """Draw two sweeps, read as the text and as the caption say, and write what was drawn.

    `ensembles` names the dataset with the ensemble of either sweep, if there is one.
    """
    bars = read(ensembles[0]) if ensembles else None
    drawn = figures.gather_sweeps(read(left), read(right), text_window, caption_window, norms, bars)
    save(figures.draw_sweeps(drawn), drawn, png, pdf, data, description, differs)


if __name__ == "__main__":
    from job import run

    run(draw_sweeps, snakemake)  # noqa: F821
