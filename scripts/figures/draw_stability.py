"""Lemma 1 as a chart: where the chain at rest is unstable, and how fast it leaves."""

from pendula.datasets import read
from pendula.plots import stability_chart
from pendula.plots.style import save


def draw_stability(
    chart: str,
    short_chart: str,
    windows: str,
    points: list[tuple[float, float]],
    png: str,
    pdf: str,
    data: str,
) -> None:
    """Draw the chart with the paper's `points` (Omega, gamma) and write what was drawn."""
    drawn = stability_chart.gather(read(chart), read(short_chart), read(windows), points)
    save(stability_chart.draw(drawn), drawn, png, pdf, data)


if __name__ == "__main__":
    from job import run

    run(draw_stability, snakemake)  # noqa: F821
