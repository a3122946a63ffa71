"""How well each solver conserves the energy in the paper's cases."""

from itertools import product

from pendula.datasets import read
from pendula.plots import energy
from pendula.plots.style import save


def draw_energy(
    trajectories: list[str], cases: list[str], solvers: list[str], png: str, pdf: str, data: str
) -> None:
    """Draw the drift of the energy; `trajectories` run over cases, then solvers."""
    drawn = energy.gather(dict(zip(product(cases, solvers), map(read, trajectories), strict=True)))
    save(energy.draw(drawn), drawn, png, pdf, data)


if __name__ == "__main__":
    from job import run

    run(draw_energy, snakemake)  # noqa: F821
