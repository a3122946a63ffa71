"""Until when each solver's trajectory can be trusted: against the multiprecision references."""

from itertools import product

from pendula.datasets import read
from pendula.plots import trust
from pendula.plots.style import save


def judge_trajectories(
    trajectories: list[str],
    references: list[str],
    cases: list[str],
    solvers: list[str],
    png: str,
    pdf: str,
    data: str,
) -> None:
    """Measure and draw the errors; `trajectories` run over cases and solvers, in this order."""
    runs = dict(zip(product(cases, solvers), map(read, trajectories), strict=True))
    truths = dict(zip(cases, map(read, references), strict=True))
    drawn = trust.gather(runs, truths)
    save(trust.draw(drawn), drawn, png, pdf, data)


if __name__ == "__main__":
    from job import run

    run(judge_trajectories, snakemake)  # noqa: F821
