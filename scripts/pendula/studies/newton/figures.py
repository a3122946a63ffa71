"""The figure of first passages of the pendula over the top."""

import xarray as xr
from latticode.drawing import style
from matplotlib import colormaps
from matplotlib.figure import Figure
from replication.variables import CHAOTIC

MARKS = "osD^vPX*"
COLOURS, LIGHTEST = colormaps["inferno"], 0.67
"""From dark to light, up to LIGHTEST: lighter curves are too pale on white paper."""
WIDTH_STEP = 0.6
"""Difference in width between a curve and the next one, which may cover it, in points."""
LIMIT_SPACING = 0.025
"""Distance of neighbouring confidence intervals at the end, as a fraction of the end time."""
CAPTION = (
    "Pendula at Ω = {omega:g} by μ: share of the runs in which a pendulum has gone over the top by "
    "τ, with confidence intervals at the end beside the curves. Wide curves lie below narrow ones."
)


def gather_over_the_top(over_the_top: xr.Dataset) -> xr.Dataset:
    """Return the share of members over the top and its confidence limits, each (mu, tau)."""
    omega = over_the_top.attrs["omega"]
    caption = CAPTION.format(omega=float(omega))
    shares = over_the_top[["passed", "passed_low", "passed_high"]].drop_attrs(deep=False)
    return shares.assign_attrs(omega=omega, caption=caption, **CHAOTIC)


@style.styled
def draw_over_the_top(data: xr.Dataset) -> Figure:
    """Draw the share over the top against tau, one curve for each mu, with limits at the end."""
    figure = style.new_figure(style.WIDTH, 2.5)
    axes, count, tau = figure.subplots(), data.sizes["mu"], data["tau"].values
    for i, mu in enumerate(data["mu"].values):
        at_mu, colour = data.isel(mu=i), COLOURS(LIGHTEST * i / max(1, count - 1))
        width = 1.2 + WIDTH_STEP * (count - 1 - i)
        axes.step(tau, at_mu["passed"], where="post", lw=width, color=colour)
        last, low, high = (
            float(at_mu[name][-1]) for name in ("passed", "passed_low", "passed_high")
        )
        axes.errorbar(
            tau[-1] * (1.03 + LIMIT_SPACING * i),
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
    axes.set_xlim(0, tau[-1] * (1.03 + LIMIT_SPACING * count))
    axes.axvline(tau[-1], color="0.5", lw=0.6, ls=":")
    axes.set_xticks([tick for tick in axes.get_xticks() if 0 <= tick <= tau[-1]])
    axes.set_ylim(-0.03, 1.05)
    style.name_legend(figure, axes, columns=4)
    return figure
