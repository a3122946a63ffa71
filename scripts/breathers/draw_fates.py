"""Draw the map of fates, with the data of the paper's cases."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.breathers.figures import draw_fates, gather_fates


def draw(
    fates: str, png: str, pdf: str, data: str, description: str,
    marked: dict[float, list[tuple[float, float]]],
) -> None:  # fmt: skip
    """Draw the figure, and write what was drawn; `marked` has (A_0, B_0) for each Omega."""
    drawn = gather_fates(read(fates))
    save(draw_fates(drawn, marked), drawn, png, pdf, data, description)


if __name__ == "__main__":
    from job import run

    run(draw, snakemake)  # noqa: F821
