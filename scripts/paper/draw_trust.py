"""Until when each solver's trajectory can be trusted: against the multiprecision references."""

import math
from itertools import product

from pendula.datasets.files import complete_or_absent
from pendula.datasets.netcdf import read
from pendula.drawing.style import save
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


def write_table(data) -> str:
    """Return a Markdown table of `solvers.trust` by case: a row a solver, a column a level."""
    levels = [f"off by {float(size):.2%}" for size in data["size"]]
    lines = [
        "# Until when the solvers can be trusted",
        "",
        "The first tau at which a norm is off by a part of its full scale (0.67 % is the width of "
        "a line in Figs 2 to 4), against the multiprecision references.",
        "",
        f"| case | solver | {' | '.join(levels)} |",
        f"| --- | --- |{' --- |' * len(levels)}",
    ]
    for case in data["case"].values:
        for solver in data["solver"].values:
            lost = data["horizon"].sel(case=case, solver=solver).values
            times = [f"{tau:.4g}" if tau < math.inf else "never" for tau in lost]
            lines.append(f"| {case} | {solver} | {' | '.join(times)} |")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    from job import run

    run(judge_trajectories, snakemake)  # noqa: F821
