"""Draw the maps of fates, with the data of the paper's cases."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.breathers.fate_figures import draw_fates, gather_fates


def draw(
    fates: str,
    png: str,
    pdf: str,
    data: str,
    description: str,
    fine: str | None = None,
    differs: list[str] | None = None,
) -> None:
    """Draw the figure, from the committed maps `fine` if these are of the same runs."""
    drawn = gather_fates(read(fates), None if fine is None else read(fine), not differs)
    save(draw_fates(drawn), drawn, png, pdf, data, description, differs)


if __name__ == "__main__":
    from job import run

    run(draw, snakemake)  # noqa: F821
