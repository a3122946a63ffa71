"""The conjecture where it lives: growth in time on chains without ends.

No run reaches infinity. What these rows decide is the power of tau over the last octaves of a run
in which the front never met an end; a power that falls from one octave to the next, or a front
that stops, would refute the paper.
"""

import numpy as np

from pendula.ledger.readings import CHANGE, CONSTANT
from pendula.ledger.row import claim, unbounded
from pendula.ledger.verdicts import Finding, UndecidableError, judge
from pendula.measures.growth import fit_exponent, fit_rise, local_exponents

from .bulk import end_of_bulk, mean_powers, tail_scale
from .front import speeds

# ASSUME: l2 "grows" as tau^(1/2), the power of a sea of fixed height that spreads steadily, if its
# measured power is within 0.1 of that, and "grows" at all if it is above 0.3; a front is pulled if
# it has the speed of linear spreading to one per cent; l-infinity "remains finite" if its power is
# below 0.1, which no power law of spreading could be; a state is thermal to five per cent.
HALF, NEAR_HALF, GROWING, PULLED, SLOW, NEAR_THERMAL = 0.5, 0.1, 0.3, 0.01, 0.1, 0.05
SHORTEST = 100.0
"""Runs that end before are no test of growth in time."""

OCTAVES = 2


def power_of(run, name: str, variant: int = 0):
    """Return the power of tau that a norm follows over the last OCTAVES of the run."""
    tau = run["tau"].values
    if tau[-1] < SHORTEST:
        raise UndecidableError(f"the runs end at tau = {tau[-1]:g}, before {SHORTEST:g}")
    values = run[name].isel(variant=variant).transpose("member", "tau").values
    return fit_exponent(tau, values, tau[-1] * 0.5**OCTAVES)


def law_at_end(run, thermal) -> float:
    """Return (2 v P tau)^(1/2) at the end: a linear front, and a thermal sea behind it."""
    one = run.isel(variant=0)
    sea = float(thermal["power"].sel(omega=one["omega"], method="nearest"))
    return float(np.sqrt(2.0 * one["predicted_speed"] * sea * run["tau"][-1]))


def sites_in_motion(run) -> float:
    """Return how many sites of the first variant the front had passed at the end."""
    return 2.0 * float(run["front"].isel(variant=0, piece_tau=-1).max()) + 1.0


@claim(
    "unbounded_in_time",
    "Introduction",
    "The l2 norm diverges in the unbounded chain as time goes to infinity.",
    unbounded("fig4_small", "thermal"),
)
def grows(run, thermal) -> Finding:
    """The conjecture at Omega = 0: l2 grows as tau^(1/2), and its power does not fall with time.

    The coefficient, too, is that of a front at the speed of linear spreading and a thermal sea.
    """
    power = power_of(run, "l2")
    values = run["l2"].isel(variant=0).transpose("member", "tau").values
    last = local_exponents(run["tau"].values, values, 1)[1][0]
    measured = {
        "power": power.value,
        "error": power.error,
        "power_of_last_octave": last.value,
        "over_its_law": values[:, -1].mean() / law_at_end(run, thermal),
        "end": run["tau"][-1],
        "sites": sites_in_motion(run),
    }
    holds = max(abs(p.value - HALF) for p in (power, last)) < NEAR_HALF
    caveat = f"up to tau = {measured['end']:.0f}: it would fall with a front that stops"
    return judge(measured, "power of tau within 0.1 of 1/2", holds, caveat)


@claim(
    "unbounded_band",
    "Section 5, before Fig 5",
    "It grows on the unbounded lattice for all Omega in (-2 gamma, 2 gamma + 4 epsilon).",
    unbounded("omegas"),
)
def grows_in_the_band(run) -> Finding:
    """The conjecture over the band in which the chain at rest is unstable."""
    found = [power_of(run, "l2", variant).value for variant in range(run.sizes["variant"])]
    omegas = run["omega"].values
    measured = {"least_power": min(found), "largest_power": max(found), "values": len(found)}
    holds = np.abs(np.array(found) - HALF).max() < NEAR_HALF
    caveat = f"at {len(found)} values of Omega from {omegas.min():g} to {omegas.max():g}"
    return judge(measured, "powers of tau within 0.1 of 1/2", holds, caveat)


@claim(
    "unbounded_front",
    "Introduction",
    "The central pendulum excites its neighbours, and this process continues.",
    unbounded("omegas"),
)
def front_is_pulled(run) -> Finding:
    """Introduction: the excitation spreads on, as fast as the linearised chain lets it."""
    if run["tau"][-1] < SHORTEST:
        raise UndecidableError(f"the runs end before tau = {SHORTEST:g}")
    found, errors = speeds(run, corrected=True)
    ratio = found / run["predicted_speed"].values
    measured = {"least": ratio.min(), "largest": ratio.max(), "error": errors.max()}
    text = "speed over that of linear spreading within 1 % of one"
    return judge(measured, text, np.abs(ratio - 1.0).max() < PULLED)


@claim(
    "unbounded_equilibrium",
    "Introduction",
    "A dynamical equilibrium is reached where each pendulum oscillates at a finite amplitude.",
    unbounded("omegas", "thermal"),
)
def sea_is_thermal(run, thermal) -> Finding:
    """Introduction: the state behind the front is an equilibrium, the thermal one of no energy."""
    if run["tau"][-1] < SHORTEST:
        raise UndecidableError(f"the runs end before tau = {SHORTEST:g}")
    expected = thermal["power"].sel(omega=run["omega"].values, method="nearest").values
    ratio = mean_powers(run).mean(axis=1) / expected
    measured = {"least": ratio.min(), "largest": ratio.max(), "mean": ratio.mean()}
    text = "mean power of the sea over that of exp(-beta H) at H = 0 within 25 % of one"
    off = np.abs(ratio - 1.0)
    apart = ", ".join(f"{omega:g}" for omega in run["omega"].values[off > NEAR_THERMAL])
    caveat = f"off the thermal state of no energy by more than 5 % at Omega = {apart}"
    return judge(measured, text, off.max() < CHANGE, caveat if apart else "")


@claim(
    "unbounded_maximum",
    "Introduction",
    "The l-infinity norm remains finite at the dynamical equilibrium.",
    unbounded("fig4_small"),
)
def maximum_grows_slowly(run) -> Finding:
    """Introduction: l-infinity stays finite; on ever more sites the largest of them grows."""
    power = power_of(run, "linf")
    tau, values = run["tau"].values, run["linf"].isel(variant=0).transpose("member", "tau").values
    rise = fit_rise(tau, values**4, tau[-1] * 0.5 ** (OCTAVES + 2))
    scales = [
        tail_scale(state, end_of_bulk(state)) for state in run["state"].isel(variant=0).values
    ]
    measured = {
        "power": power.value,
        "last": values[:, -1].mean(),
        "rise_of_fourth_power": rise.value,
        "error": rise.error,
        "scale_of_the_tail": np.mean(scales),
    }
    caveat = ""
    if rise.value > 2.0 * rise.error:
        caveat = "it creeps up with log tau, as the largest amplitude of ever more sites must"
    return judge(measured, "power of tau below 0.1", power.value < SLOW, caveat)


@claim(
    "unbounded_large",
    "Section 5, Fig 6 right",
    "For Omega < -2 gamma a large solution can grow in time on the unbounded lattice.",
    unbounded("fig3_large", "amplitudes"),
)
def large_data_grow(run, amplitudes) -> Finding:
    """Fig 6, right: large data grow in time at Omega = -4; not all of them do."""
    power = power_of(run, "l2")
    grown = [power_of(amplitudes, "l2", v).value for v in range(amplitudes.sizes["variant"])]
    sizes = amplitudes["amplitude"].values[np.array(grown) > GROWING]
    measured = {"power": power.value, "error": power.error, "end": run["tau"][-1]}
    measured |= {"spreading": len(sizes), "tried": len(grown)}
    which = ", ".join(f"{size:g}" for size in sizes) or "none"
    caveat = f"it depends on the data: of |A_0| = 5 |B_0| tried, these spread by then: {which}"
    if len(sizes) == len(grown):
        caveat = ""
    holds = power.value - 3.0 * power.error > GROWING
    return judge(measured, "power of tau above 0.3", holds, caveat)


def stays(run) -> Finding:
    """Return the finding that l2 does not grow."""
    power = power_of(run, "l2")
    measured = {"power": power.value, "error": power.error, "end": run["tau"][-1]}
    return judge(measured, "power of tau below 0.02", power.value < CONSTANT)


@claim(
    "unbounded_small",
    "Section 5, Fig 5 left",
    "For Omega < -2 gamma a small solution does not grow on the unbounded lattice.",
    unbounded("fig3_small"),
)
def small_data_stay(run) -> Finding:
    """Fig 5, left: no growth at Omega = -4 for small data (Theorem 2)."""
    return stays(run)


@claim(
    "unbounded_stable",
    "Section 5, Fig 6 left",
    "For Omega > 2 gamma + 4 epsilon a large solution does not grow on the unbounded lattice.",
    unbounded("fig2_large"),
)
def stable_data_stay(run) -> Finding:
    """Fig 6, left: no growth at Omega = 8 for large data (Theorem 1)."""
    return stays(run)


@claim(
    "unbounded_window",
    "Section 5, Fig 5 right",
    "Growth in M on a fixed window shows growth on the unbounded lattice.",
    unbounded("map_fig5_right"),
)
def window_follows_the_front(run) -> Finding:
    """Fig 5, right: on [10, T] the maximum grows with M up to the front's way v T, then no more."""
    widths, ends = run["half_width"].values, run["end"].values
    if ends[-1] < SHORTEST or len(widths) < 6:
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
    holds = measured["beyond"] < CONSTANT and measured["within"] < 1.0 - CONSTANT
    caveat = "only for M below the front's way v T: there it levels off, higher for longer T"
    return judge(measured, "level beyond v T to 2 %, lower below v T / 2", holds, caveat)
