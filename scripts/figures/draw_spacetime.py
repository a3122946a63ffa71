"""Beside Figs 2 to 4: where the chain moves, for small and for large initial data."""

from pendula.datasets import read
from pendula.plots import spacetime
from pendula.plots.style import save


def draw_spacetime(small: str, large: str, png: str, pdf: str, data: str) -> None:
    """Draw |A_n| and |B_n| of two trajectories over space and time and write what was drawn."""
    drawn = spacetime.gather(read(small), read(large))
    save(spacetime.draw(drawn), drawn, png, pdf, data)


if __name__ == "__main__":
    from job import run

    run(draw_spacetime, snakemake)  # noqa: F821
