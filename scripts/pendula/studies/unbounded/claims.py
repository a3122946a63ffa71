"""Claims on the paper's conjecture: growth in time on infinite chains.

No run reaches infinite time. The claims decide whether l2 has grown by a factor, and with which
exponent of tau it grows over the last octaves of a run. The chains have no ends that a front could
reach. The fit of the exponent includes an offset of l2^2. All limits are by Student's t over the
members of an ensemble.
"""

from collections.abc import Callable

import numpy as np
import xarray as xr
from latticode.measures.confidence import ConfidenceInterval, mean_limits, share_limits
from latticode.measures.spreading import exponent_with_offset
from replication.ledger.changes import take
from replication.ledger.claim import ClaimControl, Origin, claim
from replication.ledger.criterion import Above, AllOf, Below, Finding, UndecidableError, judge
from replication.ledger.cutoff import Cutoff, once

from pendula.claims import (
    CHANGE,
    CONSTANT,
    FACTOR,
    FAR_AS_NEAR,
    MAJORITY,
    SENSITIVITY,
    SETTLED,
    almost_equal,
    unbounded,
)

SECTION = 5

# ASSUME: l2 "grows" in time if it grows by the paper's factor of 2 after its time windows begin,
# and if its exponent over the last octaves is above that of diffusion. A steady front gives 1/2.
SURE = Cutoff(0.95, "the customary level of confidence, 95 %", 1.0)
SLOW = Cutoff(0.25, "the exponent of l2 in diffusion; a steady front gives 1/2")
HALF = 0.5
SHORTEST = 100.0
"""Runs that end before this tau do not test growth in time."""

OCTAVES = 3
"""Octaves of time at the end of a run over which an exponent is fitted: at Omega = -4, where the
bulk is short and members differ, the exponents of 20 members scatter by 0.41 over two octaves
and by 0.32 over three."""


def sure(tries: int = 1) -> float:
    """Return the level of each of `tries` limits that makes all hold at SURE (Bonferroni)."""
    return 1.0 - (1.0 - SURE.value) / tries


def times_of(run: xr.Dataset) -> np.ndarray:
    """Return the times of a run. Raises UndecidableError if it is too short."""
    tau = run["tau"].values
    if tau[-1] < SHORTEST:
        raise UndecidableError(f"the runs end at tau = {tau[-1]:g}, before {SHORTEST:g}")
    return tau


def curves_of(run: xr.Dataset, name: str, variant: int = 0) -> np.ndarray:
    """Return a norm of one variant of a run, (member, tau)."""
    return run[name].isel(variant=variant).transpose("member", "tau").values


@once
def exponents_of(run: xr.Dataset, variant: int) -> np.ndarray:
    """Return the exponent of tau in l2 of each member over the last OCTAVES, (member,)."""
    tau = times_of(run)
    is_late = tau >= tau[-1] * 0.5**OCTAVES
    return exponent_with_offset(tau[is_late], curves_of(run, "l2", variant)[:, is_late] ** 2)


def growths_of(run: xr.Dataset) -> tuple[list[ConfidenceInterval], list[float]]:
    """Return the exponent, and the lower limit of the growth since tau = SETTLED, by variant.

    The limits are of the mean over members, and hold for all variants together.
    """
    variants = range(run.sizes["variant"])
    confidence = sure(len(variants))
    start, factors = np.searchsorted(times_of(run), SETTLED), []
    for variant in variants:
        l2 = curves_of(run, "l2", variant)
        factors.append(mean_limits(l2[:, -1] / l2[:, start], confidence).low)
    return [mean_limits(exponents_of(run, variant), confidence) for variant in variants], factors


GROWS = AllOf(
    Above(SLOW, "exponent_at_least", label="lower confidence limit of the exponent of tau in l2"),
    Above(
        FACTOR, "factor_at_least", label=f"least factor by which l2 grew since tau = {SETTLED:g}"
    ),
)
"""The criterion for growth of l2, on lower confidence limits."""


def growth_of(run: xr.Dataset) -> dict[str, float]:
    """Return the measured numbers of the growth of l2 in a run with one variant."""
    (exponent,), (factor,) = growths_of(run)
    return {
        "exponent": exponent.value,
        "error": exponent.half,
        "exponent_at_least": exponent.low,
        "factor_at_least": factor,
        "end": times_of(run)[-1],
    }


def late_growths(run: xr.Dataset, name: str) -> np.ndarray:
    """Return the relative growth of a norm's mean from (T/8, T/4] to (T/2, T], (member,).

    T is the end of the run.
    """
    tau, curves = times_of(run), curves_of(run, name)
    before = curves[:, (tau > tau[-1] / 8.0) & (tau <= tau[-1] / 4.0)].mean(axis=1)
    return curves[:, tau > tau[-1] / 2.0].mean(axis=1) / before - 1.0


# --- Wrong cases ----------------------------------------------------------------------------------


def following(law: Callable) -> Callable:
    """Return a change of a run: the means of both norms become law(tau), the scatter stays."""

    def changed(run: xr.Dataset) -> xr.Dataset:
        curve = law(run["tau"].clip(min=1.0))
        return run.assign(
            {name: run[name] / run[name].mean("member") * curve for name in ("l2", "linf")}
        )

    return changed


SLOWER = ClaimControl(
    "the norm follows tau^(1/4), as in diffusion",
    following(lambda tau: 20.0 * np.sqrt(np.sqrt(tau))),
)
SLOWEST = ClaimControl(
    "the norm follows tau^(1/8), slower than in diffusion",
    following(lambda tau: 20.0 * np.sqrt(np.sqrt(np.sqrt(tau)))),
)
"""SLOWEST is for claims on the exponent. SLOWER has the limiting one, so chance would decide."""


@claim(
    "Introduction",
    "The l2 norm diverges in the unbounded chain as time goes to infinity.",
    unbounded("fig4_small"),
    (ClaimControl("the stable run fig2_large", "fig2_large"), SLOWEST),
)
def unbounded_in_time(run: xr.Dataset) -> Finding:
    measured = growth_of(run)
    caveat = f"shown up to tau = {measured['end']:.0f}; the growth would end if the front stopped"
    if abs(measured["exponent"] - HALF) > measured["error"]:
        caveat += "; the confidence interval of the exponent excludes 1/2"
    return judge(measured, GROWS, caveat)


@claim(
    "Section 5, before Fig 5",
    "Growth of the l2 norm on the unbounded lattice is not ruled out for Omega < 2 gamma + "
    "4 epsilon. (It is found here throughout the unstable band.)",
    unbounded("omegas"),
    (SLOWEST,),
)
def unbounded_band(run: xr.Dataset) -> Finding:
    omegas, (growths, factors) = run["omega"].values, growths_of(run)
    measured = {
        "least_exponent": min(limits.value for limits in growths),
        "largest_exponent": max(limits.value for limits in growths),
        "exponent_at_least": min(limits.low for limits in growths),
        "factor_at_least": min(factors),
    }
    caveat = f"tested at {len(omegas)} values of Omega from {omegas.min():g} to {omegas.max():g}"
    off = [f"{at:g}" for at, q in zip(omegas, growths, strict=True) if not q.low < HALF < q.high]
    if off:
        caveat += f"; at Omega = {', '.join(off)} the exponent differs significantly from 1/2"
    return judge(measured, GROWS, caveat)


@claim(
    "Section 5, Fig 6 right",
    "For Omega < -2 gamma a large solution can grow in time on the unbounded lattice.",
    (*unbounded("fig3_large"), SENSITIVITY),
    (
        ClaimControl("the stable run fig3_small", {"fig3_large": "fig3_small"}),
        ClaimControl("the run that grows at Omega = 0", {"fig3_large": "fig4_small"}),
        FAR_AS_NEAR,
    ),
)
def unbounded_large(run: xr.Dataset, sensitivity: xr.Dataset) -> Finding:
    """Require that the median member grows, and still grows over the last octaves.

    The initial data of members differ by 1e-6, and some members do not spread. These few would
    decide a mean and its limits, although most members grow.
    """
    near = almost_equal(sensitivity, run.attrs["perturbation"])
    tau, l2 = times_of(run), curves_of(run, "l2")
    measured = {
        "median_factor": np.median(l2[:, -1] / l2[:, np.searchsorted(tau, SETTLED)]),
        "median_late_growth": np.median(late_growths(run, "l2")),
        "exponent": mean_limits(exponents_of(run, 0), SURE.value).value,
        "omega": run["omega"].max(),
    }
    criteria = (
        Above(FACTOR, "median_factor", label=f"median growth of l2 since tau = {SETTLED:g}"),
        Above(
            CHANGE,
            "median_late_growth",
            label="median relative growth of the octave mean of l2 within two octaves of tau",
        ),
        Below(-2.0 * run.attrs["gamma"], "omega", label="Omega of the run"),
    )
    return near.judge(measured, *criteria)


@claim(
    "Beyond the paper, Fig 6 right",
    "On the unbounded lattice at the detuning of Fig 6, right, the norm also grows from other "
    "initial conditions of the central pair.",
    unbounded("starts"),
    (ClaimControl("the stable run fig3_small", "fig3_small"), SLOWER),
    origin=Origin.OWN,
)
def unbounded_starts(run: xr.Dataset) -> Finding:
    """Require that most runs grow; not all, because some perturbed runs do not spread."""
    tau, norms = times_of(run), run["l2"].transpose("tau", "variant", "member").values
    factors = norms[-1] / norms[np.searchsorted(tau, SETTLED)]
    share = share_limits(int((factors > FACTOR.value).sum()), factors.size)
    measured = {
        "starts": factors.shape[0],
        "runs": factors.size,
        "share": share.value,
        "share_at_least": share.low,
        "omega": run["omega"].max(),
    }
    label = (
        f"lower confidence limit of the share of runs whose l2 grew twofold since tau = {SETTLED:g}"
    )
    outside = Below(-2.0 * run.attrs["gamma"], "omega", label="Omega of the runs")
    caveat = f"{share.value:.0%} of the runs, up to tau = {tau[-1]:.0f}"
    return judge(measured, AllOf(Above(MAJORITY, "share_at_least", label=label), outside), caveat)


@claim(
    "Section 5, Fig 6 left",
    "For Omega > 2 gamma + 4 epsilon a large solution does not grow on the unbounded lattice.",
    unbounded("fig2_large"),
    (ClaimControl("the spreading run fig4_small", "fig4_small"), SLOWER),
)
def unbounded_stable(run: xr.Dataset) -> Finding:
    measured = {"growth": late_growths(run, "l2").max()}
    label = "largest relative growth of the octave mean of l2 within two octaves of tau"
    return judge(measured, Below(CONSTANT, "growth", label=label))


@claim(
    "Introduction",
    "The l-infinity norm remains finite at the dynamical equilibrium.",
    unbounded("fig4_small"),
    (
        ClaimControl("l2, which grows as the square root of tau, in its place", take(linf="l2")),
        SLOWER,
    ),
)
def unbounded_maximum(run: xr.Dataset) -> Finding:
    """Require that the norm hardly changes while the front moves on.

    The largest amplitude of N sites in thermal equilibrium has no bound: an amplitude m has the
    weight exp(-beta m^4 / 4), so the largest of N amplitudes grows as the fourth root of ln N.
    """
    growth = mean_limits(late_growths(run, "linf"), SURE.value)
    measured = {"growth": growth.value, "growth_at_most": growth.high}
    label = "upper confidence limit of the relative growth of the octave mean within two octaves"
    caveat = (
        f"shown up to tau = {times_of(run)[-1]:.0f}; this does not exclude a growth as the fourth "
        "root of ln tau, which the largest of many amplitudes has in thermal equilibrium"
    )
    return judge(measured, Below(CHANGE, "growth_at_most", label=label), caveat)
