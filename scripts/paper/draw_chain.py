"""Fig 1: the chain of coupled pendula pairs, as a drawing."""

from pendula.drawing.style import save
from pendula.studies.paper import chain_figure


def draw_chain(png: str, pdf: str, data: str, description: str) -> None:
    """Draw the chain and write the coordinates that were drawn."""
    drawn = chain_figure.gather()
    save(chain_figure.draw(drawn), drawn, png, pdf, data, description)


if __name__ == "__main__":
    from job import run

    run(draw_chain, snakemake)  # noqa: F821
