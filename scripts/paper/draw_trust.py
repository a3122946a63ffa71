"""Until when each solver's trajectory can be trusted: against the multiprecision references."""

from itertools import product

from pendula.datasets.files import complete_or_absent
from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.measures.divergence import write_table
from pendula.studies.paper import solver_figures


def judge_trajectories(
    trajectories: list[str],
    references: list[str],
    cases: list[str],
    solvers: list[str],
    png: str,
    pdf: str,
    data: str,
    table: str,
) -> None:
    """Measure, draw and table the errors; `trajectories` run over cases, then over solvers."""
    runs = dict(zip(product(cases, solvers), map(read, trajectories), strict=True))
    truths = dict(zip(cases, map(read, references), strict=True))
    drawn = solver_figures.gather_trust(runs, truths)
    save(solver_figures.draw_trust(drawn), drawn, png, pdf, data)
    with complete_or_absent(table) as partial:
        partial.write_text(write_table(drawn), encoding="utf-8")


if __name__ == "__main__":
    from job import run

    run(judge_trajectories, snakemake)  # noqa: F821
