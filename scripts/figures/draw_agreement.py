"""Until when the solvers draw the same curves in the paper's cases."""

from itertools import product

from pendula.datasets import read
from pendula.plots import agreement
from pendula.plots.style import save


def draw_agreement(
    trajectories: list[str], cases: list[str], solvers: list[str], png: str, pdf: str, data: str
) -> None:
    """Draw how far the solvers differ; `trajectories` run over cases, then solvers."""
    drawn = agreement.gather(
        dict(zip(product(cases, solvers), map(read, trajectories), strict=True))
    )
    save(agreement.draw(drawn), drawn, png, pdf, data)


if __name__ == "__main__":
    from job import run

    run(draw_agreement, snakemake)  # noqa: F821
