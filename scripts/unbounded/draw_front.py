"""The speed of the front over Omega, and the state behind it."""

from pendula.datasets.netcdf import read
from pendula.drawing.style import save
from pendula.studies.unbounded import front_figure


def draw_front(
    omegas: str, sea: str, large: str, thermal: str, png: str, pdf: str, data: str
) -> None:
    """Draw runs over Omega, and two with a sea: in an unstable and in a stable chain at rest.

    `thermal` are the states that the sea is compared with.
    """
    drawn = front_figure.gather_front(read(omegas), read(sea), read(large), read(thermal))
    save(front_figure.draw_front(drawn), drawn, png, pdf, data)


if __name__ == "__main__":
    from job import run

    run(draw_front, snakemake)  # noqa: F821
