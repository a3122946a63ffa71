"""A case of one's own: its norms against time, and where the chain moves."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.own_cases import figures


def draw_case(
    run: str,
    checks: str,
    png: str,
    pdf: str,
    data: str,
    description: str,
    spacetime_png: str,
    spacetime_pdf: str,
    spacetime_data: str,
    spacetime_description: str,
) -> None:
    """Draw a trajectory with the second run of its checks, and write what was drawn."""
    trajectory = read(run)
    drawn = figures.gather_norms(trajectory, read(checks))
    save(figures.draw_norms(drawn), drawn, png, pdf, data, description)
    drawn = figures.gather_spacetime(trajectory)
    save(
        figures.draw_spacetime(drawn),
        drawn,
        spacetime_png,
        spacetime_pdf,
        spacetime_data,
        spacetime_description,
    )


if __name__ == "__main__":
    from job import run

    run(draw_case, snakemake)  # noqa: F821
