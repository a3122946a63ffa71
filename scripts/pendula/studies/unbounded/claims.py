"""The conjecture where it lives: growth in time on infinite chains.

No run reaches infinity. What these rows decide is whether l2 has grown by a factor, and with which
exponent of tau over the last octaves of a run in which the front never met an end. An exponent
that falls from one octave to the next, or a front that stops, would refute the paper. The offset of
l2^2 is fitted too, and all limits are those of Student's t over the members of an ensemble. All
data are even in n: the two halves of a chain are one sample, so that limits are wider by sqrt(2)
than those of data without that symmetry.
"""

from collections.abc import Callable

import numpy as np
from latticode.measures.confidence import Limits, mean_limits
from latticode.measures.spreading import exponent_with_offset, fit_line
from latticode.numerics.elementary import log

from pendula.ledger.chaos import FAR_AS_NEAR, SENSITIVITY, almost_equal
from pendula.ledger.claim import CONSTANT, FACTOR, SETTLED, Control, claim, unbounded
from pendula.ledger.criterion import (
    Above,
    AllOf,
    Below,
    Criterion,
    Finding,
    UndecidableError,
    judge,
)
from pendula.ledger.cutoff import Cutoff, once

SECTION = 5

# ASSUME: l2 "grows" in time if it grows by the paper's factor of 2 after its time windows begin,
# and if its exponent over the last octaves is above that of diffusion. A front that moves steadily
# makes it 1/2.
SURE = Cutoff(0.95, "the customary level of confidence, 95 %", 1.0)
SLOW = Cutoff(0.25, "the exponent of l2 in diffusion; a steady front gives 1/2")
HALF = 0.5
SHORTEST = 100.0
"""Runs that end before are no test of growth in time."""

OCTAVES = 2
OF_A_SHORT_BULK = 3
"""Last octaves of time over which an exponent is fitted: more where the bulk is short, and members
differ. At Omega = -4 the exponents of 20 members scatter by 0.41 over two octaves and by 0.32 over
three. Then all of 500 draws of twelve members distinguish the mean from the exponent of diffusion,
and 9 in 10 draws of seven."""


def sure(tries: int = 1) -> float:
    """Return the confidence of each of so many limits that holds for all together (Bonferroni)."""
    return 1.0 - (1.0 - SURE.value) / tries


def times_of(run) -> np.ndarray:
    """Return the times of a run that is long enough to be a test of growth in time."""
    tau = run["tau"].values
    if tau[-1] < SHORTEST:
        raise UndecidableError(f"the runs end at tau = {tau[-1]:g}, before {SHORTEST:g}")
    return tau


@once
def curves_of(run, name: str, variant: int = 0) -> np.ndarray:
    """Return a norm of one variant of a run, (member, tau)."""
    return run[name].isel(variant=variant).transpose("member", "tau").values


@once
def exponents_of(run, variant: int, octaves: int) -> np.ndarray:
    """Return the exponent of tau in l2 of each member over the last `octaves`, (member,)."""
    tau = times_of(run)
    kept = tau >= tau[-1] * 0.5**octaves
    return exponent_with_offset(tau[kept], curves_of(run, "l2", variant)[:, kept] ** 2)


def exponent_of(run, variant: int = 0, tries: int = 1, octaves: int = OCTAVES) -> Limits:
    """Return the mean of these exponents over the members with its limits, one of `tries`."""
    return mean_limits(exponents_of(run, variant, octaves), sure(tries))


def factors_of(run, variant: int = 0) -> np.ndarray:
    """Return the factors by which l2 of the members grew from tau = SETTLED to the end."""
    l2 = curves_of(run, "l2", variant)
    return l2[:, -1] / l2[:, np.searchsorted(times_of(run), SETTLED)]


def grows(power: str = "exponent_at_least", factor: str = "factor_at_least") -> Criterion:
    """Return what lower limits keep where l2 grows."""
    return AllOf(
        Above(SLOW, power, says="lower confidence limit of the exponent of tau in l2"),
        Above(FACTOR, factor, says=f"least factor by which l2 grew since tau = {SETTLED:g}"),
    )


def growth_of(run, octaves: int = OCTAVES) -> dict[str, float]:
    """Return what is measured of the growth of l2 of the first variant."""
    exponent, factor = exponent_of(run, octaves=octaves), mean_limits(factors_of(run), SURE.value)
    return {
        "exponent": exponent.value,
        "error": exponent.half,
        "exponent_at_least": exponent.low,
        "factor_at_least": factor.low,
        "members": run.sizes["member"],
        "end": times_of(run)[-1],
    }


# --- Wrong cases ----------------------------------------------------------------------------------


def following(law: Callable) -> Callable:
    """Return a change of l2 of a run to law(tau), which keeps the scatter of its members."""
    return lambda run: run.assign(
        l2=run["l2"] / run["l2"].mean("member") * law(run["tau"].clip(min=1.0))
    )


def noise(run):
    """Return the run with noise in place of l2, of a tenth of its mean."""
    drawn = np.random.default_rng(2017).normal(10.0, 1.0, run["l2"].shape)
    return run.assign(l2=(run["l2"].dims, drawn))


def one_stays(run):
    """Return the run with a variant in the middle whose l2 has stopped to grow."""
    index = np.arange(run.sizes["variant"]) == run.sizes["variant"] // 2
    still = run["omega"].copy(data=index)
    level = run["l2"].isel(tau=int(np.searchsorted(run["tau"], SETTLED)))
    return run.assign(l2=run["l2"].where(~still, level).transpose(*run["l2"].dims))


LAWS = {
    "tau^(1/4), as in diffusion": lambda tau: 20.0 * np.sqrt(np.sqrt(tau)),
    "a logarithm of tau": lambda tau: 10.0 + 10.0 * log(tau),
    "a limit that is approached as tau^(-1/2)": lambda tau: 200.0 * (1.0 - 1.2 / np.sqrt(tau)),
}
SLOWER = {f"l2 follows {says}": following(law) for says, law in LAWS.items()}
NOISE = {"noise in place of l2": noise}
DIFFUSING = dict(list(SLOWER.items())[:2])
STILL = {f"the stable run {name}": name for name in ("fig2_large", "fig3_small")}
SPREADING = {f"the spreading run {name}": name for name in ("fig4_small", "fig3_large")}


def in_place_of(name: str, *wrong: dict) -> tuple[Control, ...]:
    """Return the controls that feed each of some wrong cases in place of a run."""
    return tuple(Control(says, {name: one}) for cases in wrong for says, one in cases.items())


@claim(
    "Introduction",
    "The l2 norm diverges in the unbounded chain as time goes to infinity.",
    unbounded("fig4_small"),
    in_place_of("fig4_small", STILL, SLOWER, NOISE),
)
def unbounded_in_time(run) -> Finding:
    measured, tau, one = growth_of(run), times_of(run), run.isel(variant=0)
    measured["sites"] = 2.0 * np.floor(float(one["front"].isel(piece_tau=-1).max())) + 1.0
    caveat = f"shown up to tau = {tau[-1]:.0f}; the growth would end if the front stopped"
    if abs(measured["exponent"] - HALF) > measured["error"]:
        caveat += "; the confidence interval of the exponent excludes 1/2"
    return judge(measured, grows(), caveat)


@claim(
    "Section 5, before Fig 5",
    "Growth of the l2 norm on the unbounded lattice is not ruled out for Omega < 2 gamma + "
    "4 epsilon. (It is found here throughout the unstable band.)",
    unbounded("omegas"),
    (
        Control("at one Omega l2 stops growing", one_stays),
        *in_place_of("omegas", SLOWER),
    ),
)
def unbounded_band(run) -> Finding:
    tries, omegas = run.sizes["variant"], run["omega"].values
    found = [exponent_of(run, variant, tries) for variant in range(tries)]
    measured = {
        "least_exponent": min(limits.value for limits in found),
        "largest_exponent": max(limits.value for limits in found),
        "exponents_at_least": min(limits.low for limits in found),
        "least_factor": min(factors_of(run, variant).min() for variant in range(tries)),
        "values": tries,
    }
    caveat = f"tested at {tries} values of Omega from {omegas.min():g} to {omegas.max():g}"
    off = [f"{at:g}" for at, q in zip(omegas, found, strict=True) if not q.low < HALF < q.high]
    if off:
        caveat += f"; at Omega = {', '.join(off)} the exponent is significantly off 1/2"
    return judge(measured, grows("exponents_at_least", "least_factor"), caveat)


@claim(
    "Section 5, Fig 6 right",
    "For Omega < -2 gamma a large solution can grow in time on the unbounded lattice.",
    (*unbounded("fig3_large"), SENSITIVITY),
    (
        *in_place_of("fig3_large", STILL, SLOWER, NOISE),
        Control("the run that grows at Omega = 0", {"fig3_large": "fig4_small"}),
        FAR_AS_NEAR,
    ),
)
def unbounded_large(run, sensitivity) -> Finding:
    near = almost_equal(sensitivity, run.attrs["perturbation"])
    measured = growth_of(run, OF_A_SHORT_BULK) | {"omega": run["omega"].max()}
    outside = Below(-2.0 * run.attrs["gamma"], "omega", says="Omega of the run")
    return near.judge(measured, grows(), outside)


def stays(run) -> Finding:
    """Return the finding that l2 does not grow, not even within its limits.

    Such runs are regular, so one member suffices. The limits of what a line through l2^2 gains over
    the last octaves come from stretches of time.
    """
    tau = times_of(run)
    start = tau[-1] * 0.5**OCTAVES
    gained = fit_line(tau, curves_of(run, "l2")[:1] ** 2, start, SURE.value).relative
    measured = {"growth": 0.5 * gained.value, "growth_at_most": 0.5 * gained.high, "end": tau[-1]}
    says = f"upper confidence limit of the relative growth of l2 since tau = {start:g}"
    return judge(measured, Below(CONSTANT, "growth_at_most", says=says))


@claim(
    "Section 5, Fig 6 left",
    "For Omega > 2 gamma + 4 epsilon a large solution does not grow on the unbounded lattice.",
    unbounded("fig2_large"),
    in_place_of("fig2_large", SPREADING, DIFFUSING),
)
def unbounded_stable(run) -> Finding:
    return stays(run)
