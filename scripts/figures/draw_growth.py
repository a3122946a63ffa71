"""Lemma 1 in numbers: measured against predicted growth rates, and growth at the threshold."""

from pendula.datasets import read
from pendula.plots import growth_rates
from pendula.plots.style import save


def draw_growth(
    chart: str, short_chart: str, threshold: str, png: str, pdf: str, data: str
) -> None:
    """Draw the growth rates of both charts and the threshold, and write what was drawn."""
    drawn = growth_rates.gather(read(chart), read(short_chart), read(threshold))
    save(growth_rates.draw(drawn), drawn, png, pdf, data)


if __name__ == "__main__":
    from job import run

    run(draw_growth, snakemake)  # noqa: F821
