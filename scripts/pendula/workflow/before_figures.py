"""Does once what each job that draws would do at its first picture; see before_jobs.py."""

import io

from latticode.drawing import style


@style.styled
def draw_something() -> None:
    """Draw a picture that nobody sees: it loads fonts, the grammar of formulas and both backends.

    Formulas of the figures would not help: matplotlib reads each anew for each picture.
    """
    figure = style.new_figure(1.0, 1.0)
    figure.add_subplot(yscale="log", xlabel=r"$\tau$")
    for kind in ("png", "pdf"):
        figure.savefig(io.BytesIO(), format=kind)


draw_something()
