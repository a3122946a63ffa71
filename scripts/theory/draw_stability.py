"""Lemma 1: the stability chart, and measured growth rates against predicted ones."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.theory import figures


def draw_stability(
    chart: str,
    short_chart: str,
    windows: str,
    threshold: str,
    points: list[tuple[float, float]],
    of_paper: bool,
    stability: list[str],
    growth: list[str],
    differs: list[str] | None = None,
) -> None:
    """Draw the chart with the cases' `points` (Omega, gamma), and the growth rates.

    `of_paper` says whether these are the paper's cases.
    """
    charts = read(chart), read(short_chart)
    drawn = figures.gather_chart(*charts, read(windows), points, of_paper)
    save(figures.draw_chart(drawn), drawn, *stability, differs)
    drawn = figures.gather_rates(*charts, read(threshold))
    save(figures.draw_rates(drawn), drawn, *growth, differs)


if __name__ == "__main__":
    from job import run

    run(draw_stability, snakemake)  # noqa: F821
