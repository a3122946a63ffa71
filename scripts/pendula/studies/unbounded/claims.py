"""The conjecture where it lives: growth in time on chains without ends.

No run reaches infinity. What these rows decide is the exponent of tau over the last octaves of a
run in which the front never met an end; an exponent that falls from one octave to the next, or a
front that stops, would refute the paper.
"""

import numpy as np

from pendula.ledger.claim import CONSTANT, FEWEST, claim, unbounded
from pendula.ledger.criterion import (
    AboveByErrors,
    AllOf,
    Below,
    Finding,
    Near,
    UndecidableError,
    judge,
)
from pendula.measures.growth import fit_exponent, fit_rise, local_exponents

from .bulk import end_of_bulk, tail_scale
from .front import speeds

SECTION = 5

# ASSUME: l2 "grows" as tau^(1/2), as a bulk of fixed height that spreads steadily does, if its
# exponent is within 0.1 of that, and "grows" at all if it is above 0.3; a front is pulled if it has
# the speed of linear spreading to one per cent; l-infinity "remains finite" if its exponent is
# below 0.1, which no power law of spreading could be;
# A growth is told from its limit by three standard errors.
HALF, NEAR_HALF, GROWING, PULLED, SLOW = 0.5, 0.1, 0.3, 0.01, 0.1
ERRORS = 3.0
SHORTEST = 100.0
"""Runs that end before are no test of growth in time."""

OCTAVES = 2


def times_of(run) -> np.ndarray:
    """Return the times of a run that is long enough to be a test of growth in time."""
    tau = run["tau"].values
    if tau[-1] < SHORTEST:
        raise UndecidableError(f"the runs end at tau = {tau[-1]:g}, before {SHORTEST:g}")
    return tau


def exponent_of(run, name: str, variant: int = 0):
    """Return the exponent of tau that a norm follows over the last OCTAVES of the run."""
    tau = times_of(run)
    values = run[name].isel(variant=variant).transpose("member", "tau").values
    return fit_exponent(tau, values, tau[-1] * 0.5**OCTAVES)


def law_at_end(run, thermal) -> float:
    """Return (2 v P tau)^(1/2) at the end: a linear front, and a thermal bulk behind it."""
    one = run.isel(variant=0)
    power = float(thermal["power"].sel(omega=one["omega"], method="nearest"))
    return float(np.sqrt(2.0 * one["predicted_speed"] * power * run["tau"][-1]))


def sites_in_motion(run) -> float:
    """Return how many sites of the first variant the front had passed at the end."""
    return 2.0 * float(run["front"].isel(variant=0, piece_tau=-1).max()) + 1.0


@claim(
    "Introduction",
    "The l2 norm diverges in the unbounded chain as time goes to infinity.",
    unbounded("fig4_small", "thermal"),
)
def unbounded_in_time(run, thermal) -> Finding:
    exponent = exponent_of(run, "l2")
    values = run["l2"].isel(variant=0).transpose("member", "tau").values
    last = local_exponents(run["tau"].values, values, 1)[1][0]
    measured = {
        "exponent": exponent.value,
        "error": exponent.error,
        "exponent_of_last_octave": last.value,
        "over_its_law": values[:, -1].mean() / law_at_end(run, thermal),
        "end": run["tau"][-1],
        "sites": sites_in_motion(run),
    }
    caveat = f"up to tau = {measured['end']:.0f}: it would fall with a front that stops"
    says = "exponents of tau"
    criterion = Near(HALF, NEAR_HALF, "exponent", "exponent_of_last_octave", says=says)
    return judge(measured, criterion, caveat)


@claim(
    "Section 5, before Fig 5",
    "It grows on the unbounded lattice for all Omega in (-2 gamma, 2 gamma + 4 epsilon).",
    unbounded("omegas"),
)
def unbounded_band(run) -> Finding:
    found = [exponent_of(run, "l2", variant).value for variant in range(run.sizes["variant"])]
    omegas = run["omega"].values
    measured = {"least_exponent": min(found), "largest_exponent": max(found), "values": len(found)}
    caveat = f"at {len(found)} values of Omega from {omegas.min():g} to {omegas.max():g}"
    says = "exponents of tau"
    criterion = Near(HALF, NEAR_HALF, "least_exponent", "largest_exponent", says=says)
    return judge(measured, criterion, caveat)


@claim(
    "Introduction",
    "The central pendulum excites its neighbours, and this process continues.",
    unbounded("omegas"),
)
def unbounded_front(run) -> Finding:
    times_of(run)
    found, errors = speeds(run, corrected=True)
    ratio = found / run["predicted_speed"].values
    measured = {"least": ratio.min(), "largest": ratio.max(), "error": errors.max()}
    says = "speeds over those of linear spreading"
    return judge(measured, Near(1.0, PULLED, "least", "largest", says=says))


@claim(
    "Introduction",
    "The l-infinity norm remains finite at the dynamical equilibrium.",
    unbounded("fig4_small"),
)
def unbounded_maximum(run) -> Finding:
    exponent = exponent_of(run, "linf")
    tau, values = run["tau"].values, run["linf"].isel(variant=0).transpose("member", "tau").values
    rise = fit_rise(tau, values**4, tau[-1] * 0.5 ** (OCTAVES + 2))
    scales = [
        tail_scale(state, end_of_bulk(state)) for state in run["state"].isel(variant=0).values
    ]
    measured = {
        "exponent": exponent.value,
        "last": values[:, -1].mean(),
        "rise_of_fourth_power": rise.value,
        "error": rise.error,
        "scale_of_the_tail": np.mean(scales),
    }
    caveat = ""
    if rise.value > 2.0 * rise.error:
        caveat = "it creeps up with log tau, as the largest amplitude of ever more sites must"
    return judge(measured, Below(SLOW, "exponent", says="exponent of tau"), caveat)


@claim(
    "Section 5, Fig 6 right",
    "For Omega < -2 gamma a large solution can grow in time on the unbounded lattice.",
    unbounded("fig3_large", "amplitudes"),
)
def unbounded_large(run, amplitudes) -> Finding:
    exponent = exponent_of(run, "l2")
    grown = [exponent_of(amplitudes, "l2", v).value for v in range(amplitudes.sizes["variant"])]
    sizes = amplitudes["central_modulus"].values[np.array(grown) > GROWING]
    measured = {"exponent": exponent.value, "error": exponent.error, "end": run["tau"][-1]}
    measured |= {"spreading": len(sizes), "tried": len(grown)}
    which = ", ".join(f"{size:g}" for size in sizes) or "none"
    caveat = f"it depends on the data: of |A_0| = 5 |B_0| tried, these spread by then: {which}"
    if len(sizes) == len(grown):
        caveat = ""
    return judge(measured, AboveByErrors(GROWING, "exponent", "error", ERRORS), caveat)


def stays(run) -> Finding:
    """Return the finding that l2 does not grow."""
    exponent = exponent_of(run, "l2")
    measured = {"exponent": exponent.value, "error": exponent.error, "end": run["tau"][-1]}
    return judge(measured, Below(CONSTANT, "exponent", says="exponent of tau"))


@claim(
    "Section 5, Fig 5 left",
    "For Omega < -2 gamma a small solution does not grow on the unbounded lattice.",
    unbounded("fig3_small"),
)
def unbounded_small(run) -> Finding:
    return stays(run)


@claim(
    "Section 5, Fig 6 left",
    "For Omega > 2 gamma + 4 epsilon a large solution does not grow on the unbounded lattice.",
    unbounded("fig2_large"),
)
def unbounded_stable(run) -> Finding:
    return stays(run)


@claim(
    "Section 5, Fig 5 right",
    "Growth in M on a fixed window shows growth on the unbounded lattice.",
    unbounded("map_fig5_right"),
)
def unbounded_window(run) -> Finding:
    widths, ends = run["half_width"].values, run["end"].values
    if ends[-1] < SHORTEST or len(widths) < FEWEST:
        raise UndecidableError("the map over half-widths and windows is too small")
    l2 = run["l2"].mean("member").transpose("half_width", "end").values
    reach = float(run["predicted_speed"]) * ends
    late = ends >= 0.5 * ends[-1]
    far = [l2[widths > 1.1 * reach[j], j] / l2[-1, j] for j in np.flatnonzero(late)]
    near = [l2[widths < 0.5 * reach[j], j] / l2[-1, j] for j in np.flatnonzero(late)]
    far, near = np.concatenate(far), np.concatenate(near)
    if not far.size * near.size:
        raise UndecidableError("the half-widths lie all on one side of the front's way")
    measured = {"beyond": np.abs(far - 1.0).max(), "within": near.max()}
    caveat = "only for M below the front's way v T: there it levels off, higher for longer T"
    level = Below(CONSTANT, "beyond", says="relative change of the maxima beyond v T")
    lower = Below(1.0 - CONSTANT.value, "within", says="maxima below v T / 2 over the level")
    return judge(measured, AllOf(level, lower), caveat)
