"""A case of one's own: its norms against time, and where the chain moves."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.own_cases import figures


def draw_case(run: str, checks: str, norms: list[str], spacetime: list[str]) -> None:
    """Draw a trajectory with the second run of its checks, and write what was drawn.

    `norms` and `spacetime` are the files of the two figures: PNG, PDF, data, description.
    """
    trajectory = read(run)
    drawn = figures.gather_norms(trajectory, read(checks))
    save(figures.draw_norms(drawn), drawn, *norms)
    drawn = figures.gather_spacetime(trajectory)
    save(figures.draw_spacetime(drawn), drawn, *spacetime)


if __name__ == "__main__":
    from job import run

    run(draw_case, snakemake)  # noqa: F821
