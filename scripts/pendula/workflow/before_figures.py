"""Preparation for jobs that draw, done once in the process that they are forked from."""

import io

from latticode.drawing import style


@style.styled
def draw_and_discard() -> None:
    """Draw a picture and discard it, to load fonts, the grammar of formulas and both backends.

    The figures' own formulas are not drawn: matplotlib would parse them again for each picture.
    """
    figure = style.new_figure(1.0, 1.0)
    figure.add_subplot(yscale="log", xlabel=r"$\tau$")
    for kind in ("png", "pdf"):
        figure.savefig(io.BytesIO(), format=kind)


draw_and_discard()
