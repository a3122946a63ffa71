"""Lemma 1: the stability chart, and measured growth rates against predicted ones."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.theory import (
    figure_growth_rates as growth_rates,
)
from pendula.studies.theory import (
    figure_stability_chart as stability_chart,
)


def draw_stability(
    chart: str,
    short_chart: str,
    windows: str,
    threshold: str,
    points: list[tuple[float, float]],
    png: str,
    pdf: str,
    data: str,
    growth_png: str,
    growth_pdf: str,
    growth_data: str,
) -> None:
    """Draw the chart with the paper's `points` (Omega, gamma), and the growth rates."""
    charts = read(chart), read(short_chart)
    drawn = stability_chart.gather(*charts, read(windows), points)
    save(stability_chart.draw(drawn), drawn, png, pdf, data)
    drawn = growth_rates.gather(*charts, read(threshold))
    save(growth_rates.draw(drawn), drawn, growth_png, growth_pdf, growth_data)


if __name__ == "__main__":
    from job import run

    run(draw_stability, snakemake)  # noqa: F821
