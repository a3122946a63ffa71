"""Draw the families of periodic breathers, and how the drive feeds a localised motion."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.problem import Constants
from pendula.studies.breathers.figures import draw_breathers, gather_breathers
from pendula.studies.breathers.waves import bands


def draw(periodic: str, growth: str, png: str, pdf: str, data: str, description: str) -> None:
    """Draw the figure, and write what was drawn."""
    families = read(periodic)
    about = {name: float(families.attrs[name]) for name in ("epsilon", "gamma")}
    edges = [
        max(end for _, end in bands(Constants(omega=float(omega), **about)))
        for omega in families["omega"].values
    ]
    drawn = gather_breathers(families, read(growth), edges)
    save(draw_breathers(drawn), drawn, png, pdf, data, description)


if __name__ == "__main__":
    from job import run

    run(draw, snakemake)  # noqa: F821
