"""Preparation for jobs that draw, done once in the process that they are forked from."""

import io

from latticode.drawing import style


@style.styled
def draw_something() -> None:
    """Draw a picture that is discarded, to load fonts, the grammar of formulas and both backends.

    The figures' own formulas would not help: matplotlib parses them again for each picture.
    """
    figure = style.new_figure(1.0, 1.0)
    figure.add_subplot(yscale="log", xlabel=r"$\tau$")
    for kind in ("png", "pdf"):
        figure.savefig(io.BytesIO(), format=kind)


draw_something()
