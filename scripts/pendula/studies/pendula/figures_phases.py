"""The paper's phases in the real pendula, the chaotic state at Omega = 0, and who leaves it."""

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.colors import PowerNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, MaxNLocator, NullLocator, StrMethodFormatter

from pendula.datasets.registry import NAMES
from pendula.drawing import style

from .claims_phases import thermal_beside

LOOKS = ("0.7", "#5aa7d6", "#16876b", "#e0a100", style.RED, "#000000")
"""Colours by mu: a wide grey line for the amplitudes, and one hue for each mu."""
NORMS = {"l2": r"$\ell^2$", "linf": r"$\ell^\infty$"}
"""A panel for each, so that a line shows mu by its colour alone."""
LARGEST, OVER = 0.999, 2.0
"""The largest modulus below the top that is told from others, and what stands for one beyond it."""
MODULI = colormaps["inferno"].with_extremes(bad="white", over="#35c7b1")
ABOVE, ROW, BELOW = 0.44, 1.0, 0.9
"""Heights in inches: of the legend and the names of mu, of a row, and of what stands below all."""
LOG_FROM = 6.0
"""A norm that varies by more than this factor is drawn on a logarithmic scale."""
APART = 3
"""Columns between the pictures of neighbouring mu; each snapshot takes one column."""

SEA = ("o", "s", "^", "D", "v")
MARKED = {"markersize": 3.2, "markerfacecolor": "none", "linestyle": "none", "mew": 0.8}
THERMAL = {"color": "0.6", "lw": 2.2, "zorder": 1}
COLOURS = colormaps["viridis"]
BESIDE = 0.025
"""Confidence limits at the end stand so far beside each other, as a part of the time."""


def gather_phases(phases: xr.Dataset) -> xr.Dataset:
    """Return norms of the pair, and the larger modulus on each site over time."""
    l2 = np.sqrt((phases["l2"] ** 2).sum("component", skipna=False))
    norms = {"l2": l2, "linf": phases["linf"].max("component")}
    for name, one in norms.items():
        one.attrs = {"long_name": f"{NAMES[name]}, of A and B together", "units": "1"}
    kept = phases[["larger_modulus", "snapshot_tau", "omega", "initial"]]
    return kept.assign(norms)


@style.styled
def draw_phases(data: xr.Dataset) -> Figure:
    """Draw a row for each case: both norms by mu, and a space-time picture for each mu.

    All panels stand at given places: to find these would take a quarter of the time of the drawing.
    """
    cases, mus = data["case"].values, data["mu"].values
    height = ABOVE + ROW * len(cases) + BELOW
    figure = style.new_figure(style.DOUBLE, height)
    figure.set_layout_engine("none")
    grid = figure.subplots(len(cases), 3, squeeze=False, gridspec_kw={
        "top": 1.0 - ABOVE / height, "bottom": BELOW / height, "hspace": 0.32,
        "width_ratios": (1.6, 1.6, 5.0), "left": 0.075, "right": 0.994, "wspace": 0.3})  # fmt: skip
    bar = figure.add_axes((0.45, 0.42 / height, 0.47, 0.1 / height))
    for letter, panels, name in zip("abcdefghijkl", grid, cases, strict=False):
        case = data.sel(case=name)
        for axes, norm in zip(panels, NORMS, strict=False):
            _draw_norm(axes, case, norm)
        panels[0].set_title(f"({letter}) {style.name_case(case)}", loc="left", fontsize=7)
        image = _draw_strip(panels[-1], case)
    for axes in grid[:-1].flat:
        axes.set_xticks([])  # each tick takes time, and those below serve all rows
    for axes in grid[-1]:
        axes.set_xlabel(r"$\tau$")
    _name_strips(grid[0, -1], grid[-1, -1], data)
    bar = figure.colorbar(image, cax=bar, orientation="horizontal")
    bar.set_label(r"modulus over the largest by (4); green: $2 \mu |A| > \pi$, over the top")
    lines = [
        Line2D([], [], color=colour, lw=1.6, label=_name(mu, "eqs (4)"))
        for colour, mu in zip(LOOKS, mus, strict=False)
    ]
    figure.legend(handles=lines, loc="upper center", ncols=len(lines), columnspacing=1.2,
                  fontsize=7.5)  # fmt: skip
    return figure


def _name(mu: float, limit: str = "equations (4)") -> str:
    return rf"$\mu = {mu:g}$" if mu else limit


def _draw_norm(axes: Axes, case: xr.Dataset, norm: str) -> None:
    for colour, mu in zip(LOOKS, case["mu"].values, strict=False):
        # pendula over the top swing the most: they lie behind the others, and (4) behind all
        axes.plot(case["tau"], case[norm].sel(mu=mu), zorder=3.0 - mu if mu else 2.0,
                  color=colour, lw=0.7 if mu else 2.2)  # fmt: skip
    spans = float(case[norm].max()) / float(case[norm].min())
    if spans > LOG_FROM:
        axes.set_yscale("log")
        axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if spans < 30.0 else (1.0,)))
    else:
        axes.yaxis.set_major_locator(MaxNLocator(3))
    axes.yaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.set_xlim(0, float(case["tau"].max()))
    axes.set_ylabel(NORMS[norm])
    axes.yaxis.set_label_coords(-0.27, 0.5)


def _strips(data: xr.Dataset) -> tuple[float, float, np.ndarray]:
    """Return step and width of the picture of one mu, and where each starts on the common axis.

    The step is the time of one column, which stands around the time of its snapshot.
    """
    times = data["snapshot_tau"].values
    step = float(times[1]) if times.size > 1 else 1.0
    width = step * times.size
    return step, width, (width + APART * step) * np.arange(data.sizes["mu"])


def _draw_strip(axes: Axes, case: xr.Dataset):
    """Draw the moduli of all mu beside each other in one picture, which is drawn far sooner."""
    case = case.dropna("site", how="all")  # what a chain shorter than another does not have
    moduli = case["larger_modulus"].transpose("mu", "site", "snapshot").values
    peak = float(moduli[case["mu"].values == 0.0].max()) or 1.0
    turned = 2.0 * case["mu"].values[:, None, None] * moduli > np.pi
    shown = np.where(turned, OVER, np.minimum(moduli / peak, LARGEST))
    apart = np.full((len(shown), case.sizes["site"], APART), np.nan)
    columns = np.concatenate([shown, apart], axis=2).transpose(1, 0, 2).reshape(len(apart[0]), -1)
    sites = case["site"].values[0] - 0.5, case["site"].values[-1] + 0.5
    _, width, starts = _strips(case)
    image = axes.imshow(
        columns[:, :-APART], cmap=MODULI, norm=PowerNorm(0.5, 0, 1), origin="lower", aspect="auto",
        extent=(0, starts[-1] + width, *sites), interpolation="none",
    )  # fmt: skip
    axes.set_ylabel("site $n$", labelpad=-2)
    return image


def _name_strips(highest: Axes, lowest: Axes, data: xr.Dataset) -> None:
    """Put mu above each picture, and numbers at its start and its middle below."""
    step, width, starts = _strips(data)
    shown = [0.0, 0.5 * float(data["snapshot_tau"][-1])]
    lowest.set_xticks([start + 0.5 * step + one for start in starts for one in shown],
                      [f"{one:g}" for _ in starts for one in shown])  # fmt: skip
    for start, mu in zip(starts, data["mu"].values, strict=True):
        place = start + 0.5 * width, highest.get_ylim()[1]
        highest.annotate(_name(mu, "eqs (4)"), place, (0, 3), textcoords="offset points",
                         ha="center", fontsize=7.5)  # fmt: skip


# --- The chaotic state, and pendula that leave it over the top -----------------------------------


TOP_CAPTION = (
    "(a), (b): the chaotic state at Ω = {omega}, of pendula at each μ and of the amplitude "
    "equations (4), beside the thermal state of the infinite chain: spectrum, and distribution of "
    "the moduli. (c): share of the runs in which a pendulum has gone over the top by τ, with "
    "confidence intervals at the end. (d): the largest angle of any pendulum so far, as a mean "
    "over the runs; the top is at half a turn (dashed)."
)


def gather_over_the_top(sea: xr.Dataset, over_the_top: xr.Dataset, thermal: xr.Dataset):
    """Return spectra and distributions beside the thermal ones, and passages by mu."""
    cell = float(sea["modulus"][1] - sea["modulus"][0])
    means = sea[["wave_power", "modulus_share"]].mean("member", keep_attrs=True)
    density = (means["modulus_share"] / cell).assign_attrs(
        long_name="probability density of the modulus", units="1"
    )
    turns = (over_the_top["angle_so_far"] / (2.0 * np.pi)).mean("member", skipna=False)
    shown = {
        "wave_power": means["wave_power"].rename(mu="sea_mu"),
        "sea_density": density.rename(mu="sea_mu", modulus="sea_modulus"),
    }
    for name, one in thermal_beside(sea, thermal, "spectrum", "density").data_vars.items():
        about = f"{one.attrs['long_name']}, thermal state"
        shown[f"thermal_{name}"] = one.assign_attrs(long_name=about)
    shown["wave_number"] = thermal["wave_number"]
    shown["turns"] = turns.assign_attrs(
        long_name="largest angle of any pendulum so far in turns, mean over the members", units="1"
    )
    shown |= {name: over_the_top[name] for name in ("passed", "passed_low", "passed_high")}
    omega = sea.attrs["omega"]
    caption = TOP_CAPTION.format(omega=f"{float(omega):g}")
    return xr.Dataset(shown, attrs={"omega": omega, "caption": caption})


@style.styled
def draw_over_the_top(data: xr.Dataset) -> Figure:
    """Draw spectrum and distribution above; below, the share that has passed, and the angles."""
    figure = style.new_figure(style.DOUBLE, 4.9)
    (spectrum, density), (passed, turns) = figure.subplots(2, 2)
    _draw_sea(spectrum, density, data)
    mus = data["mu"].values
    colours = [COLOURS(0.9 * i / max(1, len(mus) - 1)) for i in range(len(mus))]
    named = _draw_passed(passed, data, colours)
    for mu, colour in zip(mus, colours, strict=True):
        turns.plot(data["tau"], data["turns"].sel(mu=mu), color=colour, lw=1.3)
    turns.axhline(0.5, color="0.6", dashes=(4, 2), zorder=1)
    turns.set(xscale="log", yscale="log", xlabel=r"$\tau$", ylabel="largest angle so far (turns)")
    turns.set_xlim(1.0, float(data["tau"].max()))
    turns.yaxis.set_minor_locator(NullLocator())
    turns.set_title("(d) how far they turn; dashed: the top", loc="left")
    figure.legend(handles=named, loc="outside lower center", ncols=len(named), fontsize=7.5,
                  handlelength=1.2, columnspacing=1.2)  # fmt: skip
    return figure


def _draw_sea(spectrum: Axes, density: Axes, data: xr.Dataset) -> None:
    half = data["wave_number"] <= np.pi
    waves, thermal = data["wave_number"].values[half], data["thermal_spectrum"].values[half]
    if np.isfinite(thermal).any():
        spectrum.plot(waves, thermal, label="thermal, no ends", **THERMAL)
    density.plot(data["modulus"], data["thermal_density"], **THERMAL)
    mus = data["sea_mu"].values
    for i, mu in enumerate(mus):
        one, mark = data.sel(sea_mu=mu), SEA[i % len(SEA)]
        look = {"color": "black" if mu == 0 else COLOURS(0.85 * i / len(mus)), **MARKED}
        spectrum.plot(one["even_wave"], one["wave_power"], mark, label=_name(mu), **look)
        density.plot(one["sea_modulus"], one["sea_density"], mark, **look)
    spectrum.set(xlabel="wave number $k$ (rad)", ylabel="mean $|A(k)|^2$", xlim=(0, np.pi))
    spectrum.set_ylim(0, None)
    spectrum.legend(fontsize=7, handletextpad=0.4)
    title = rf"(a) spectrum of the chaotic state at $\Omega = {data.attrs['omega']:g}$"
    spectrum.set_title(title, loc="left")
    density.set(xlabel="modulus $|A_n|$", ylabel="probability density")
    density.set_xlim(0, float(data["sea_modulus"].max()))
    density.set_ylim(0, None)
    density.set_title("(b) distribution of moduli", loc="left")


def _draw_passed(axes: Axes, data: xr.Dataset, colours: list) -> list:
    """Draw the share that has gone over the top, with limits at the end; return the curves."""
    tau, lines = data["tau"].values, []
    for i, (mu, colour) in enumerate(zip(data["mu"].values, colours, strict=True)):
        one = data.sel(mu=mu)
        look = {"where": "post", "label": _name(mu), "color": colour, "lw": 1.3}
        lines += axes.step(tau, one["passed"], **look)
        last, low, high = (float(one[name][-1]) for name in ("passed", "passed_low", "passed_high"))
        axes.errorbar(tau[-1] * (1.03 + BESIDE * i), last, [[last - low], [high - last]], fmt="o",
                      markersize=2, capsize=1.5, elinewidth=0.9, color=colour)  # fmt: skip
    axes.set(xlabel=r"$\tau$", ylabel="share of members")
    axes.set_xlim(0, tau[-1] * (1.03 + BESIDE * data.sizes["mu"]))
    axes.set_ylim(-0.03, 1.05)
    axes.set_title("(c) gone over the top by then", loc="left")
    return lines
