"""Does once what each job would do at its first use of a library; jobs are forks of what did it.

The process that jobs are forked from imports this: see profiles/default/profile.yaml.
"""

import io

import numba
import xarray
from pendula.drawing import style


@style.styled
def draw_something() -> None:
    """Draw a picture that nobody sees: it loads fonts, the grammar of formulas and both backends.

    Formulas of the figures would not help: matplotlib reads each anew for each picture.
    """
    figure = style.new_figure(1.0, 1.0)
    figure.add_subplot(yscale="log", xlabel=r"$\tau$")
    for kind in ("png", "pdf"):
        figure.savefig(io.BytesIO(), format=kind)


numba.njit("float64(float64)")(lambda x: x)  # numba gathers the functions that it knows
xarray.backends.list_engines()
draw_something()
