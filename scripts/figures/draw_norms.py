"""Figs 2 to 4: norms of A and B against time, for small and for large initial data."""

from pendula.datasets import read
from pendula.plots import norms
from pendula.plots.style import save


def draw_norms(small: str, large: str, png: str, pdf: str, data: str) -> None:
    """Draw the norms of two trajectories and write what was drawn."""
    drawn = norms.gather(read(small), read(large))
    save(norms.draw(drawn), drawn, png, pdf, data)


if __name__ == "__main__":
    from job import run

    run(draw_norms, snakemake)  # noqa: F821
