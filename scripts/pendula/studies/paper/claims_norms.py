"""Section 5, Figs 2 to 4: claims on the norms against time. P is |A|^2 + |B|^2 in l2."""

from functools import partial

import numpy as np
import xarray as xr
from latticode.measures.levels import correlation
from latticode.measures.norms import largest, total_power
from latticode.numerics.elementary import log
from replication.ledger.changes import take_from
from replication.ledger.claim import ClaimControl, claim
from replication.ledger.criterion import (
    Above,
    AllOf,
    AtLeast,
    AtMost,
    Below,
    Finding,
    UndecidableError,
    WithinFactor,
    judge,
)
from replication.ledger.cutoff import Cutoff

from pendula.claims import CHANGE, FACTOR, MUCH, at_one_omega, late, runs, sweeps
from pendula.models.bounds import proven_region, theorem_1_bound
from pendula.problem import Constants

SECTION = 5

# ASSUME: a number for each of the paper's words, which its origin quotes.
HALF = Cutoff(0.5, '"decreases": to less than half')
MOST = Cutoff(0.5, '"excites others": most of P is on other sites')
ANTICORRELATED = Cutoff(-0.8, '"oscillates between": |A|^2 falls where |B|^2 rises', -1.0)
RETAINED_MAXIMUM = Cutoff(
    0.75, '"effectively separated": A keeps three quarters of its maximum', 1.0
)
FOLDED = Cutoff(1.0 / 3.0, '"is unstable": amplitudes grow by e within tau = 3')
NORMS = ("l2", "linf")
AT_STABLE_REST = ("fig2_small", "fig2_large", "fig3_small", "fig3_large")
"""The cases in which the chain at rest is linearly stable by Lemma 1."""
UNSTABLE = 3.0
"""Growth is measured up to this tau, before small amplitudes become large."""


@claim(
    "Section 5, Figs 2 and 6 left",
    "The simulations at Omega = 8 agree with the global bound of Theorem 1.",
    (*runs("fig2_small", "fig2_large"), *sweeps("fig6_left")),
    controls=(
        ClaimControl(
            "the norms of the unstable case",
            {"fig2_small": ("fig4_small", take_from("l2", "linf"))},
        ),
    ),
)
def fig2_bounded(small: xr.Dataset, large: xr.Dataset, sweep: xr.Dataset) -> Finding:
    """Compare P of each run with the bound for its energy; the sweep has the large case's bound."""
    bounds = [
        theorem_1_bound(float(ds["energy"][0]), Constants.of(ds.attrs)) for ds in (small, large)
    ]
    if not np.all(np.isfinite(bounds)):
        raise UndecidableError("Theorem 1 does not apply to these constants")
    measured = {
        "small": total_power(small).max() / bounds[0],
        "large": total_power(large).max() / bounds[1],
        "sweep": np.square(sweep["l2"].sel(quantity="pair").values).max() / bounds[1],
    }
    return judge(measured, AtMost(1.0, *measured, label="largest P over the bound of Theorem 1"))


fig2_upper = partial(claim, "Section 5, Fig 2 upper", needs=runs("fig2_small"))


@fig2_upper(
    "The central pendulum excites other pendula in the chain, so that its oscillation decreases.",
    controls=(ClaimControl("the large case, which stays at the centre", "fig2_large"),),
)
def fig2_excites(small: xr.Dataset) -> Finding:
    a = late(small)["linf"].sel(component="A").max() / small["linf"].sel(component="A")[0]
    measured = {
        "least_share_elsewhere": (1.0 - share_at_maxima(late(small))).min(),
        "largest_late_amplitude": a,
    }
    criterion = AllOf(
        Above(
            MOST,
            "least_share_elsewhere",
            label="least share of P outside the largest |A_n| and |B_n|",
        ),
        Below(HALF, "largest_late_amplitude", label="largest late |A_n| over the initial one"),
    )
    return judge(measured, criterion)


def share_at_maxima(trajectory: xr.Dataset) -> np.ndarray:
    """Return the share of P on the largest |A_n| and the largest |B_n|, (time,)."""
    return (trajectory["linf"] ** 2).sum("component").values / total_power(trajectory)


@fig2_upper(
    "The l2 norm oscillates between A and B.",
    controls=(ClaimControl("the large case, where A and B are separate", "fig2_large"),),
)
def fig2_exchange(small: xr.Dataset) -> Finding:
    a, b = late(small)["l2"].values ** 2
    against = Below(ANTICORRELATED, "correlation", label="correlation of |A|^2 and |B|^2")
    return judge({"correlation": correlation(a, b)}, against)


@fig2_upper(
    "While the central oscillation decreases, the l-infinity norms of A and B become comparable "
    "and stay so.",
    controls=(
        ClaimControl("the large case, where B stays small", "fig2_large"),
        ClaimControl("the large case at Omega = 0, whose norms do not fall", "fig4_large"),
    ),
)
def fig2_maxima(small: xr.Dataset) -> Finding:
    settled = late(small)["linf"]
    means = settled.mean("tau")
    measured = {
        "ratio": float(means[0] / means[1]),
        "deviation": (settled.std("tau") / means).max(),
        "level": means.max() / largest(small)[0],
    }
    little = Below(CHANGE, "deviation", label="standard deviation over time, relative to the mean")
    fallen = Below(HALF, "level", label="late mean over the initial value")
    return judge(
        measured,
        AllOf(WithinFactor(FACTOR, "ratio", label="mean norm of A over that of B"), little, fallen),
    )


@claim(
    "Section 5, Fig 2 lower",
    "The motion of A is effectively separated from that of B, and the central pendulum does not"
    " excite large oscillations of others.",
    runs("fig2_large"),
    controls=(ClaimControl("the small case, where A and B exchange P and spread", "fig2_small"),),
)
def fig2_separate(large: xr.Dataset) -> Finding:
    settled, start = late(large), float(large["linf"].sel(component="A")[0])
    a = large.sel(component="A")
    measured = {
        "smallest_A_kept": settled["linf"].sel(component="A").min() / start,
        "B_over_A": settled["l2"].sel(component="B").max() / settled["l2"].sel(component="A").min(),
        "all_other_A": np.sqrt(np.maximum(0.0, a["l2"] ** 2 - a["linf"] ** 2)).max() / start,
    }
    small = 1.0 / MUCH.value
    criterion = AllOf(
        Above(
            RETAINED_MAXIMUM,
            "smallest_A_kept",
            label="least l-infinity norm of A over its initial value",
        ),
        Below(small, "B_over_A", label="l2 norm of B over that of A"),
        Below(small, "all_other_A", label="l2 of all other A_n over A_0"),
    )
    return judge(measured, criterion)


def with_growth_of(run: xr.Dataset, growing: xr.Dataset) -> xr.Dataset:
    """Return `run` with the norms of `growing`, scaled to start at the initial norm of `run`."""
    to_start = np.sqrt(total_power(run)[0] / total_power(growing)[0])
    return take_from("l2", "linf")(run, growing.assign({n: to_start * growing[n] for n in NORMS}))


@claim(
    "Introduction",
    "In the stability region the chain performs stable oscillations that the initial deviations"
    " determine.",
    runs(*AT_STABLE_REST),
    controls=(
        ClaimControl(
            "the norms of the unstable case at Omega = 0",
            {"fig3_small": ("fig4_small", take_from("l2", "linf"))},
        ),
        ClaimControl(
            "norms of the small case at Omega = -4 that grow as those of the large one",
            {"fig3_small": ("fig3_large", with_growth_of)},
        ),
    ),
)
def stable_oscillations(*trajectories: xr.Dataset) -> Finding:
    """Require bounded norms in the cases that Theorem 1 or 2 covers.

    Rest is stable in all four cases, but below the band the paper claims stable oscillations only
    for small initial conditions.
    """
    runs_by_case = dict(zip(AT_STABLE_REST, trajectories, strict=True))
    grown = {
        case: np.sqrt(total_power(run) / total_power(run)[0]) for case, run in runs_by_case.items()
    }
    covered = [case for case, run in runs_by_case.items() if region_of(run) != "none"]
    if not covered:
        raise UndecidableError("no theorem covers any of these cases")
    measured = {
        "least": min(grown[case].min() for case in covered),
        "largest": max(grown[case].max() for case in covered),
    }
    criterion = WithinFactor(
        FACTOR,
        "least",
        "largest",
        label="l2 over its initial value where a theorem covers the case",
    )
    uncovered = {case: ratio.max() for case, ratio in grown.items() if case not in covered}
    measured |= {f"largest_{case}": ratio for case, ratio in uncovered.items()}
    caveats = (
        f"no theorem covers {case}: its l2 norm grows to {ratio:.2g} times its initial value,"
        " although rest is stable"
        for case, ratio in uncovered.items()
        if ratio >= FACTOR.value
    )
    return judge(measured, criterion, "; ".join(caveats))


@claim(
    "Section 5, Fig 3 upper",
    "For small initial conditions Omega = -4 shows no drastic difference from Omega = 8.",
    runs("fig2_small", "fig3_small"),
    controls=(ClaimControl("the unstable case at Omega = 0", {"fig3_small": "fig4_small"}),),
)
def fig3_alike(eight: xr.Dataset, four: xr.Dataset) -> Finding:
    if eight.attrs["omega"] == four.attrs["omega"]:
        raise UndecidableError("both runs have the same Omega")
    l2 = np.sqrt(total_power(late(four)).mean() / total_power(late(eight)).mean())
    linf = largest(late(four)).mean() / largest(late(eight)).mean()
    measured = {"l2_ratio": l2, "linf_ratio": linf}
    return judge(
        measured, WithinFactor(FACTOR, "l2_ratio", "linf_ratio", label="ratio of the mean norms")
    )


@claim(
    "Section 5, before Fig 3",
    "At Omega = -4 the bound of Theorem 2 applies only to the smaller initial condition.",
    runs("fig3_small", "fig3_large"),
    controls=(
        ClaimControl("the small case in place of the large one", {"fig3_large": "fig3_small"}),
        ClaimControl("the large case in place of the small one", {"fig3_small": "fig3_large"}),
    ),
)
def fig3_only_small(small: xr.Dataset, large: xr.Dataset) -> Finding:
    at_one_omega(small, large)
    regions = [region_of(small), region_of(large)]
    covered = [region.startswith("theorem 2") for region in regions]
    measured = dict(zip(("small_is_covered", "large_is_covered"), covered, strict=True))
    criterion = AllOf(
        AtLeast(1, "small_is_covered", label="small case covered by Theorem 2"),
        AtMost(0, "large_is_covered", label="large case covered by Theorem 2"),
    )
    widened = "the small case is covered only if the proof keeps the coupling energy"
    return judge(measured, criterion, widened if regions[0] == "theorem 2 widened" else "")


def region_of(run: xr.Dataset) -> str:
    """Return the name of the theorem that covers the initial data of a run, or "none"."""
    start, energy = float(total_power(run)[0]), float(run["energy"][0])
    return proven_region(energy, start, Constants.of(run.attrs), str(run.attrs["boundary"]))


@claim(
    "Section 5, Fig 4",
    "Zero is linearly unstable at Omega = 0.",
    runs("fig4_small"),
    controls=(ClaimControl("a stable run at Omega = -4", "fig3_small"),),
)
def fig4_unstable(small: xr.Dataset) -> Finding:
    """Require that small data grow. Large data can grow by cubic terms although zero is stable."""
    if not largest(small)[0] ** 2 <= Constants.of(small.attrs).gamma:
        raise UndecidableError("not a small initial condition: its cubic terms exceed the drive")
    growth = total_power(small.sel(tau=slice(0, UNSTABLE))).max() / total_power(small)[0]
    measured = {"mean_rate": 0.5 * log(growth) / UNSTABLE}
    label = f"mean growth rate up to tau = {UNSTABLE:g}"
    return judge(measured, Above(FOLDED, "mean_rate", label=label))
