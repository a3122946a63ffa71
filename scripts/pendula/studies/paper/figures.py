"""Figures 2 to 6, space-time plots of the chain, and comparisons of the solvers."""

import numpy as np
import xarray as xr
from latticode.datasets.registry import SOLVER_NAMES
from latticode.drawing import panels, strips, style
from latticode.drawing.strips import NORMS, Strip
from latticode.measures.difference import (
    VISIBLE,
    at_times,
    difference,
    divergence_time,
    is_of_same_case,
)
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from replication.variables import REGULAR, mark

from pendula.drawing import CASE_ATTRIBUTES, draw_cases, name_case

SIZES = ["small", "large"]
MEMBERS = {"long_name": "number of runs in the ensemble", "units": "1"}
DIVERGED = "from here on the run is off by 1 %"
NORMS_CAPTION = (
    "Norms of A (red) and of B (blue) against τ: ℓ∞ on the left and ℓ² on the right, small initial "
    "amplitudes above and large ones below. A wide pale line under a curve is the multiprecision "
    "reference."
)
PARTS_CAPTION = (
    " A dashed line marks the time from which a run differs from its reference by "
    f"{100 * VISIBLE:g} % of full scale."
)
BAND_CAPTION = (
    " The row below such a run shows the median and the band with {} of the runs of a perturbed "
    "ensemble."
)
SPACETIME_CAPTION = (
    "Moduli |Aₙ| (left) and |Bₙ| (right) over time and sites, small initial amplitudes above and "
    "large ones below. After a dashed line the run differs from its multiprecision reference by "
    f"{100 * VISIBLE:g} % of full scale."
)
SWEEPS_CAPTION = (
    "Norms of the pair (A, B) against the half-width M of the chain. Filled marks are maxima over "
    "the time window in the text of the paper, hollow marks are averages over the window in its "
    "caption. Bars are the mean and the standard deviation of a perturbed ensemble of a chaotic "
    "case. On chains whose ends the front does not reach, the motion is the same, so their marks "
    "are not independent."
)
DRIFT_CAPTION = (
    "Largest change of the energy H up to each time, by solver, for each case. The dashed line is "
    "the order of magnitude that the paper states. ode45 integrates complex unknowns, or real ones "
    "where marked (real). The scheme of Crank and Nicolson does not conserve a quartic energy; "
    "the scheme of Delfour, Fortin and Payre does."
)
TRUST_CAPTION = (
    "Largest error of the norms up to each time, relative to full scale, by solver. An error above "
    f"the dashed line, {100 * VISIBLE:g} %, is visible. Marks on this line show when a solver "
    "diverges from the multiprecision reference; solvers with smaller errors have their marks "
    "near the end. A case without a reference has an empty panel."
)


def gather_norms(
    runs: list[xr.Dataset], references: list[xr.Dataset], ensembles: xr.Dataset | None = None
) -> xr.Dataset:
    """Return the norms of two runs, from small and from large data, and of their references.

    If a run and its reference have different parameters, the reference norms are NaN. With
    `ensembles` the bands of the cases are added.
    """
    cases = [_with_reference(run, true) for run, true in zip(runs, references, strict=True)]
    divergence_text, band = PARTS_CAPTION, ""
    if ensembles is not None:
        cases = [case.assign(_bands(case, ensembles)) for case in cases]
        band = BAND_CAPTION.format(_share(ensembles))
    caption = NORMS_CAPTION + (divergence_text + band) * any(map(strips.diverges, cases))
    data = mark(style.join(cases, SIZES, "initial_size", CASE_ATTRIBUTES), REGULAR, "omega")
    return data.assign_attrs(caption=caption)


def _with_reference(run: xr.Dataset, reference: xr.Dataset) -> xr.Dataset:
    drawn, true = run[["linf", "l2"]], at_times(reference, run["tau"])
    known = is_of_same_case(run, reference)
    for name in NORMS:
        long_name = f"true {reference[name].attrs['long_name']}, in multiprecision"
        drawn[f"true_{name}"] = true[name].where(known).assign_attrs(long_name=long_name, **REGULAR)
    error = difference(run, reference) if known else xr.full_like(run["tau"], np.nan)
    drawn["divergence_time"] = divergence_time(error)
    drawn["solver"] = (), run.attrs["solver"]
    return drawn


def _bands(run: xr.Dataset, ensembles: xr.Dataset) -> xr.Dataset:
    """Return the bands of the ensemble of a case, and the number of its runs."""
    drawn = xr.Dataset({"members": xr.Variable((), ensembles.attrs["members"], MEMBERS)})
    every = ensembles[list(NORMS)].sel(case=run.attrs["case"], drop=True)
    every = every.reindex(tau=run["tau"], method="nearest", tolerance=1e-9)
    return drawn.assign({f"band_{name}": every[name] for name in NORMS})


def _share(banded: xr.Dataset) -> str:
    """Return the share of runs within the band between the quantiles, such as "90 %"."""
    ends = banded["quantile"].values
    return f"{100 * (ends[-1] - ends[0]):g} %"


@style.styled
def draw_norms(data: xr.Dataset) -> Figure:
    """Draw l-infinity left and l2 right, small data above and large below, A red and B blue.

    The reference is drawn under the run. A dashed line marks their divergence time if there is one,
    and a strip below shows the ensemble.
    """
    cases = [data.sel(initial_size=size) for size in data["initial_size"].values]
    figure, drawn = strips.draw_cases(cases, [_strips(case) for case in cases])
    for case, grid in zip(cases, drawn, strict=True):
        for axes in grid[0]:
            axes.set_title(name_case(case), loc="left", fontsize=style.WITH_INDICES)
    any_diverges = any(strips.diverges(case) for case in cases)
    under = any(strip.under for case in cases for strip in _strips(case))
    strips.name_legend(figure, data["component"].values, DIVERGED if any_diverges else "", under)
    return figure


def _strips(case: xr.Dataset) -> list[Strip]:
    run = f"by {SOLVER_NAMES[case['solver'].item()]}"
    strips_of_case = [Strip("", run, under="true_" if case["true_l2"].notnull().any() else "")]
    if strips.diverges(case) and "band_l2" in case:
        strips_of_case.append(
            Strip("band_", f"{int(case['members'])} perturbed runs: median and {_share(case)} band")
        )
    return strips_of_case


def gather_spacetime(runs: list[xr.Dataset], norms: xr.Dataset) -> xr.Dataset:
    """Return the moduli |A_n| and |B_n| of two trajectories over sites and snapshots.

    The divergence times of the runs are taken from the dataset of `gather_norms`.
    """
    cases = [panels.over_time(case) for case in runs]
    data = mark(style.join(cases, SIZES, "initial_size", CASE_ATTRIBUTES), REGULAR, "omega")
    data = data.assign(divergence_time=norms["divergence_time"])
    return data.assign_attrs(caption=SPACETIME_CAPTION)


@style.styled
def draw_spacetime(data: xr.Dataset) -> Figure:
    """Draw |A_n| left and |B_n| right, small data above and large below, one scale per row.

    A dashed line marks the divergence time.
    """
    figure = style.new_figure(style.WIDTH, 4.2)
    grid = figure.subplots(2, 2, sharex=True, sharey=True)
    for row, size in zip(grid, data["initial_size"].values, strict=True):
        case = data.sel(initial_size=size)
        panels.draw_moduli(figure, row, case, 2 * [name_case(case)])
        for axes in row:
            title = axes.get_title(loc="left")
            axes.set_title(title, loc="left", fontsize=style.WITH_INDICES)
        for axes in row if strips.diverges(case) else ():
            axes.axvline(float(case["divergence_time"]), label=DIVERGED, **style.ON_COLOURS)
    for axes in grid[-1]:
        axes.set_xlabel(r"$\tau$")
    for axes in grid[:, 0]:
        axes.set_ylabel("site $n$")
    style.name_legend(figure, *grid.flat)
    return figure


def gather_sweeps(
    left: xr.Dataset,
    right: xr.Dataset,
    text_window: str,
    caption_window: str,
    norms: tuple[str, ...] = ("l2", "linf"),
    ensembles: xr.Dataset | None = None,
) -> xr.Dataset:
    """Return the norms of the pair in two sweeps: the maximum over a window, the mean over another.

    The paper's text uses maxima and its captions use averages, over different windows. Windows are
    named as in the sweeps, such as "[10, 50]"; `norms` are the norms to draw. If a sweep has an
    ensemble, its mean and standard deviation are added.
    """
    sweeps = {"left": left, "right": right}
    readings = {"text": ("max", text_window), "caption": ("mean", caption_window)}
    joined = panels.join_sweeps(sweeps, readings, list(norms), CASE_ATTRIBUTES)
    data = mark(joined, REGULAR, "omega")
    if ensembles is not None:
        names = [sweep.attrs["case"] for sweep in sweeps.values()]
        every = ensembles.reindex(sweep=names, half_width=data["half_width"])
        data["members"] = every["swept_members"].max().assign_attrs(MEMBERS)
        for name in (f"{norm}_{moment}" for norm in norms for moment in ("mean", "deviation")):
            values = every[name].transpose("sweep", "reading", "half_width").values
            data[name] = ("panel", "reading", "half_width"), values, every[name].attrs
    return data.assign_attrs(caption=SWEEPS_CAPTION)


@style.styled
def draw_sweeps(data: xr.Dataset) -> Figure:
    """Draw both panels: red dots for l2, blue squares for l-infinity, hollow for averages.

    Each mark of a chaotic sweep is one random sample. The bars next to it show its ensemble.
    """
    figure = style.new_figure(style.WIDTH, 2.6)
    row = figure.subplots(1, 2)
    for axes, name in zip(row, data["panel"].values, strict=True):
        panels.draw_sweep(axes, data.sel(panel=name), "$(A, B)$")
        name_above = name_case(data.sel(panel=name))
        axes.set_title(name_above, loc="left", fontsize=style.WITH_INDICES)
    style.name_legend(figure, *row, columns=3)
    return figure


# --- The solvers side by side ---------------------------------------------------------------------

LABELS = ["omega", "initial"]
DIFFERENCE = "largest difference of the norms up to this time"
UNKNOWN = "no reference for this case"
DRAWN = ["ode45", "ode45_real", "taylor", "delfour_fortin_payre", "crank_nicolson"]
"""Solvers in drawing order: noisy curves are drawn below smooth ones."""


def _so_far(values: xr.DataArray, long_name: str) -> xr.DataArray:
    """Return the running maximum of values over time.

    The difference of two oscillating curves returns to zero many times and would fill the panel.
    Its running maximum never falls, and exceeds the visible fraction at the divergence time.
    """
    values = values.transpose(..., "tau")
    largest = values.copy(data=np.maximum.accumulate(values.values, axis=-1))
    return largest.assign_attrs(long_name=long_name, units="1")


def gather_drift(solvers: xr.Dataset) -> xr.Dataset:
    """Return the running maximum of the energy drift, and the drift that the paper states."""
    drift = _so_far(
        solvers["drift"].sel(solver=DRAWN), "largest drift of the energy up to this time"
    )
    drawn = solvers[["stated_drift", *LABELS]].assign(drift_so_far=drift)
    return drawn.assign_attrs(caption=DRIFT_CAPTION)


@style.styled
def draw_drift(data: xr.Dataset) -> Figure:
    """Draw one panel per case, one line per solver, and the paper's drift as a dashed line."""
    return draw_cases(data, _draw_drift, r"largest $|H(\tau) - H(0)|$ so far")


def _draw_drift(axes: Axes, case: xr.Dataset) -> None:
    for i, solver in enumerate(DRAWN):
        curve = panels.positive(case["drift_so_far"].sel(solver=solver))
        look = _look(solver) | {"markeredgecolor": "white", "markeredgewidth": 0.5}
        every = max(curve.size // 4, 1)
        marked = every * (i + 1) // 6, every  # the marks of different solvers must not overlap
        label = SOLVER_NAMES[solver]
        axes.plot(curve["tau"], curve, label=label, markevery=marked, **look)
    stated = float(case["stated_drift"])
    if np.isfinite(stated):
        axes.axhline(stated, color="0.45", dashes=(4, 2), lw=1, label="stated in the paper")


def _look(solver: str) -> dict:
    return {"color": style.COLOURS[solver], "marker": style.MARKERS[solver], "markersize": 5}


def gather_trust(trust: xr.Dataset) -> xr.Dataset:
    """Return each solver's error against the reference and its divergence time, by case."""
    largest = _so_far(trust["difference"], DIFFERENCE)
    drawn = trust[["horizon", "visible", *LABELS]].assign(largest_so_far=largest)
    return drawn.assign_attrs(caption=TRUST_CAPTION)


@style.styled
def draw_trust(data: xr.Dataset) -> Figure:
    """Draw one panel per case, one line per solver, and a mark where its error becomes visible.

    If an error never becomes visible, the mark is near the end of the curve to identify it.
    """
    return draw_cases(data, _draw_trust, "largest error so far")


def _draw_trust(axes: Axes, case: xr.Dataset) -> None:
    visible = float(case["visible"])
    if case["horizon"].isnull().all():
        axes.text(0.5, 0.5, UNKNOWN, ha="center", transform=axes.transAxes)
    for solver in case["solver"].values:
        errors = case.sel(solver=solver)
        curve, look = panels.positive(errors["largest_so_far"]), _look(solver)
        axes.plot(curve["tau"], curve, markevery=[], label=SOLVER_NAMES[solver], **look)
        point = float(errors["horizon"]), visible
        if at_end := not np.isfinite(point[0]) and curve.size > 0:
            last = round(0.95 * curve.size) - 1
            point = float(curve["tau"][last]), float(curve[last])
        axes.plot(*point, **look, markeredgecolor="white", zorder=3, clip_on=not at_end)
    axes.axhline(visible, color="0.45", dashes=(4, 2), lw=1, label=f"{100 * visible:g} % (visible)")
    axes.set_ylim(1e-17, 3.0)
    # an automatic choice depends on the last bit of a logarithm, and so on the processor
    axes.set_yticks([1e-16, 1e-8, 1.0])
