"""First passages of the pendula over the top, in a picture."""

import xarray as xr
from latticode.drawing import style
from matplotlib import colormaps
from matplotlib.figure import Figure

MARKS = "osD^vPX*"
WIDER = 0.6
"""Curves are wider than those above them by so many points, so that those of one share are seen."""
BESIDE = 0.025
"""Confidence limits at the end stand so far beside each other, as a part of the time."""
CAPTION = (
    "Pendula at Ω = {omega:g} by μ: share of the runs in which a pendulum has gone over the top by "
    "τ, with confidence intervals at the end beside the curves. Wide curves lie below narrow ones."
)


def gather_over_the_top(over_the_top: xr.Dataset) -> xr.Dataset:
    """Return by mu and tau how many members have gone over the top."""
    omega = over_the_top.attrs["omega"]
    caption = CAPTION.format(omega=float(omega))
    shown = over_the_top[["passed", "passed_low", "passed_high"]].drop_attrs(deep=False)
    return shown.assign_attrs(omega=omega, caption=caption)


@style.styled
def draw_over_the_top(data: xr.Dataset) -> Figure:
    """Draw the share that has gone over the top, with limits at the end."""
    figure = style.new_figure(style.WIDTH, 2.5)
    axes, count, tau = figure.subplots(), data.sizes["mu"], data["tau"].values
    for i, mu in enumerate(data["mu"].values):
        one, colour = data.isel(mu=i), colormaps["viridis"](0.95 * i / max(1, count - 1))
        width = 1.2 + WIDER * (count - 1 - i)
        axes.step(tau, one["passed"], where="post", lw=width, color=colour)
        last, low, high = (float(one[name][-1]) for name in ("passed", "passed_low", "passed_high"))
        axes.errorbar(
            tau[-1] * (1.03 + BESIDE * i),
            last,
            [[last - low], [high - last]],
            capsize=1.5,
            elinewidth=0.9,
            color=colour,
            marker=MARKS[i % len(MARKS)],
            markersize=3,
            label=rf"$\mu = {mu:g}$",
        )
    axes.set(xlabel=r"$\tau$", ylabel="share of runs over the top")
    axes.set_xlim(0, tau[-1] * (1.03 + BESIDE * count))
    axes.axvline(tau[-1], color="0.5", lw=0.6, ls=":")
    axes.set_xticks([one for one in axes.get_xticks() if 0 <= one <= tau[-1]])
    axes.set_ylim(-0.03, 1.05)
    style.name_legend(figure, axes, columns=4)
    return figure
