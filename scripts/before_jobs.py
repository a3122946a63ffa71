"""Does once what each job would do at its first use of a library; jobs are forks of what did it.

The process that jobs are forked from imports this: see profiles/default/profile.yaml.
"""

import io

import numba
import xarray
from pendula.drawing import style

POWERS = range(-16, 5)
CASES = [(omega, pair) for omega in (8, -4, 0) for pair in ("1, 0.1", "5, 1")]
"""What stands at axes and above panels of many figures: its formulas are read once for all."""


@style.styled
def draw_something() -> None:
    """Draw a picture that nobody sees, which loads fonts and the tables of both kinds of files."""
    figure = style.new_figure(1.0, 1.0)
    axes = figure.add_subplot(yscale="log", xlabel=r"$\tau$")
    axes.set_yticks([float(f"1e{power}") for power in POWERS])
    for omega, pair in CASES:
        figure.text(0.0, 0.0, rf"$\Omega = {omega}$,  $(A_{{0}}, B_{{0}}) = ({pair})$")
    for kind in ("png", "pdf"):
        figure.savefig(io.BytesIO(), format=kind)


numba.njit("float64(float64)")(lambda x: x)  # numba gathers the functions that it knows
xarray.backends.list_engines()
draw_something()
