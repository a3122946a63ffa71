"""Fig 4: norms against time at Omega = 0, and what Section 5 says of all its trajectories."""

import numpy as np

from pendula.ledger.readings import CHANGE, MUCH, constants, halves, largest, late, powers
from pendula.ledger.row import LARGE, SMALL, claim, runs
from pendula.ledger.verdicts import Finding, UndecidableError, judge
from pendula.studies.theory.bounds import theorem_3_bound

# ASSUME: "is unstable": grows by e within 3; "many": a quarter; a pendulum is "excited" at a fifth
# of the largest amplitude; curves are apart at 30 % of scale; a rise of 10 % is worth a caveat.
MANY, EXCITED, APART, RISE = 0.25, 0.2, 0.3, 0.1


@claim(
    "fig4_unstable",
    "Section 5, Fig 4",
    "Zero is linearly unstable at Omega = 0.",
    runs("fig4_small", "fig4_large"),
)
def unstable_at_zero(small, large) -> Finding:
    """Fig 4: the zero equilibrium is unstable at Omega = 0."""
    rates = [
        0.5 * np.log(powers(ds.sel(tau=slice(0, 3))).max() / powers(ds)[0]) / 3.0
        for ds in (small, large)
    ]
    measured = {"mean_rate_small": rates[0], "mean_rate_large": rates[1]}
    return judge(measured, "the small data grow by e within 3", rates[0] * 3.0 > 1.0)


@claim(
    "fig4_settles",
    "Section 5, Fig 4",
    "Growth stabilises at a certain level of the l-infinity norm.",
    runs("fig4_small", "fig4_large"),
)
def maximum_settles(small, large) -> Finding:
    """Fig 4: growth stops at a certain l-infinity norm."""
    changes = []
    for ds in (small, large):
        first, second = halves(ds)
        changes.append(abs(largest(second).mean() / largest(first).mean() - 1.0))
    measured = {"change_small": changes[0], "change_large": changes[1]}
    return judge(measured, "change between halves < 25 %", max(changes) < CHANGE)


@claim(
    "fig4_l2_larger",
    "Section 5, Fig 4",
    "The l2 norm is significantly larger than the l-infinity norm.",
    runs("fig4_small", "fig4_large"),
)
def sum_exceeds_maximum(small, large) -> Finding:
    """Fig 4: l2 is significantly larger than l-infinity."""
    ratios = [np.mean(np.sqrt(powers(late(ds))) / largest(late(ds))) for ds in (small, large)]
    measured = {"small": ratios[0], "large": ratios[1]}
    return judge(measured, "l2 over l-infinity > 3", min(ratios) > MUCH)


@claim(
    "fig4_many",
    "Section 5, Fig 4",
    "Many pendula oscillate with amplitudes comparable to the central one's.",
    runs("fig4_small", "fig4_large"),
)
def many_in_motion(small, large) -> Finding:
    """Fig 4: many pendula oscillate with amplitudes comparable to the central one's."""
    shares = []
    for ds in (small, large):
        settled = late(ds)
        pendula = 2.0 * (2 * int(ds.attrs["half_width"]) + 1)
        shares.append(np.mean(powers(settled) / largest(settled) ** 2) / pendula)
    measured = {"share_small": shares[0], "share_large": shares[1]}
    return judge(measured, "P over l-infinity^2 and 2N > 1/4", min(shares) > MANY)


@claim(
    "fig4_alike",
    "Section 5, Fig 4",
    "There are no visible differences between the upper and lower panels.",
    runs("fig4_small", "fig4_large"),
)
def panels_alike(small, large) -> Finding:
    """Fig 4: no visible differences between upper and lower panels."""
    a, b = late(small), late(large)
    l2 = np.sqrt(powers(b).mean() / powers(a).mean()) - 1.0
    linf = largest(b).mean() / largest(a).mean() - 1.0
    early = np.abs(np.sqrt(powers(large)) - np.sqrt(powers(small)))
    scale = np.sqrt(powers(a).mean())
    apart = small["tau"].values[early > APART * scale]
    until = apart[-1] if len(apart) else 0.0
    measured = {"l2": l2, "linf": linf, "curves_apart_until": until, "initially": early[0]}
    caveat = ""
    if early[0] > RISE * largest(a).mean():
        caveat = "in the mean after tau = 10; before, and in detail, the curves differ"
    return judge(measured, "late means within 25 %", max(abs(l2), abs(linf)) < CHANGE, caveat)


@claim(
    "equilibrium",
    "Abstract; Section 6",
    "Excitation spreads until every pendulum oscillates at a finite amplitude.",
    runs("fig4_small"),
)
def equilibrium(small) -> Finding:
    """Abstract: excitation spreads until all pendula oscillate at finite amplitude."""
    if "modulus" not in small:
        raise UndecidableError("the trajectory holds no amplitudes of single pendula")
    modulus = small["modulus"].max("component").values
    level = EXCITED * modulus.max()
    reached = [modulus[edge].max() > level for edge in (0, -1)]
    arrival = np.flatnonzero(np.maximum(modulus[0], modulus[-1]) > level)
    when = float(small["snapshot_tau"][arrival[0]]) if len(arrival) else np.inf
    first, second = halves(small)
    change = abs(powers(second).mean() / powers(first).mean() - 1.0)
    measured = {"arrival_at_the_ends": when, "change_of_P": change}
    caveat = f"the spreading stops at tau = {when:.0f} since the chain ends there"
    holds = all(reached) and change < CHANGE
    return judge(measured, "ends reached, then P changes by < 25 %", holds, caveat)


@claim(
    "finite_bound",
    "Section 5, before Fig 5",
    "By Theorem 3 the solution in the finite chain stays bounded.",
    (*SMALL, *LARGE),
)
def finite_bound(*trajectories) -> Finding:
    """Theorem 3 along the paper's own runs."""
    ratios = []
    for ds in trajectories:
        sites = 2 * int(ds.attrs["half_width"]) + 1
        bound = theorem_3_bound(float(ds["energy"][0]), sites, constants(ds))
        ratios.append(powers(ds).max() / bound)
    return judge({"largest": max(ratios)}, "largest P over C_N <= 1", max(ratios) <= 1.0)
