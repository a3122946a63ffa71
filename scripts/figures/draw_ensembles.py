"""Ensembles of the chaotic cases and sweeps, and the paper's own runs among them."""

from pendula.datasets import read
from pendula.plots import ensembles as plot
from pendula.plots.style import save


def draw_ensembles(
    ensembles: str,
    runs: list[str],
    cases: list[str],
    sweeps: list[str],
    windows: dict[str, str],
    png: str,
    pdf: str,
    data: str,
) -> None:
    """Draw the runs of `cases` and the sweeps named in `windows`, both in the order of paths."""
    trajectories = dict(zip(cases, map(read, runs), strict=True))
    swept = dict(zip(windows, map(read, sweeps), strict=True))
    drawn = plot.gather(read(ensembles), trajectories, swept, windows)
    save(plot.draw(drawn), drawn, png, pdf, data)


if __name__ == "__main__":
    from job import run

    run(draw_ensembles, snakemake)  # noqa: F821
