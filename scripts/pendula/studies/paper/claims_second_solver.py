"""Section 5: claims on the figures by the paper's second solver.

Single runs of a chaotic case cannot agree for long. In a chaotic case we therefore compare a run of
the second solver with an ensemble, as one more member. For Figs 2 to 4 we compare the mean norm
over a long time, which is normally distributed to good approximation. The maxima of Fig 6, right,
are not normally distributed, because some runs spread late. We compare them with the range of many
runs.
"""

import numpy as np
import xarray as xr
from latticode.measures.confidence import student
from latticode.measures.difference import VISIBLE
from replication.ledger import missing
from replication.ledger.chances import RARE
from replication.ledger.changes import put, repeat
from replication.ledger.claim import ClaimControl, claim
from replication.ledger.criterion import (
    Above,
    AllOf,
    Below,
    Distance,
    Finding,
    UndecidableError,
    judge,
    undecided,
)
from replication.ledger.cutoff import Cutoff

from pendula.claims import FEWEST, MAJORITY, checks, sweeps

SECTION = 5
SEEN = Cutoff(VISIBLE, "a reader sees a difference of 1 % of full scale, wider than a line")
ZERO = ["fig4_small", "fig4_large"]
"""The cases at Omega = 0."""
LATE, WINDOW = (30.0, 50.0), "[30, 50]"
"""The time window in which a run is compared with its ensemble."""

FIRST = sweeps("fig5_left", "fig6_left")
SECOND = tuple(f"{name}.crank_nicolson" for name in FIRST)
"""The regular sweeps by the first solver, and by the second."""
(RIGHT,) = checks("second_solver")
"""A chaotic sweep by the first solver, and by the second with two different steps."""


# --- Figs 2 to 4 ----------------------------------------------------------------------------------


def late_distance(solvers: xr.Dataset, members: xr.Dataset, case: str) -> tuple[float, int]:
    """Return the distance of the second solver from the ensemble's mean, and the number of members.

    The distance is between mean l2 norms in the window LATE, after the solvers diverge. Its unit is
    the standard deviation of one more member from the ensemble's mean.
    """
    run, since = solvers.sel(case=case), LATE[0]
    known = WINDOW in members["window"].values and run["second_divergence"][0] < since
    if not known or members.sizes["member"] < missing.FEWEST or run["tau"][-1] < LATE[1]:
        raise UndecidableError(
            f"{case} has too few members, or no data over {WINDOW} after the solvers diverge"
        )
    drawn = members["l2_level"].sel(case=case, quantity="pair", window=WINDOW).values
    value = run["second_l2"].sel(tau=slice(*LATE)).values.mean()
    deviation = drawn.std(ddof=1) * np.sqrt(1.0 + 1.0 / len(drawn))
    return float(abs(value - drawn.mean()) / deviation), len(drawn)


@claim(
    "Section 5, end",
    "With the second solver Figs 2 to 4 show no significant differences.",
    checks("solvers", "lyapunov", "members"),
    controls=(
        ClaimControl(
            "the second solver's run at Omega = -4 in place of its runs at Omega = 0",
            {"solvers": repeat("case", "fig3_large", at=ZERO, names="second_l2")},
        ),
        ClaimControl(
            "chaotic cases required to agree as single runs", {"lyapunov": put("chaotic", 0)}
        ),
    ),
)
def second_solver(solvers: xr.Dataset, lyapunov: xr.Dataset, members: xr.Dataset) -> Finding:
    chaos, cases = lyapunov["chaotic"], list(map(str, solvers["case"].values))
    if unknown := [case for case in cases if case not in chaos["case"].values]:
        raise UndecidableError(f"it is not known whether {', '.join(unknown)} is chaotic")
    drawn = [case for case in cases if chaos.sel(case=case)]
    steady = solvers["second_difference"].sel(case=[case for case in cases if case not in drawn])
    since = {case: float(solvers["second_divergence"].sel(case=case)[0]) for case in cases}
    distances = [late_distance(solvers, members, case) for case in drawn]
    freedom = min((count for _, count in distances), default=missing.FEWEST) - 1
    likely = student(freedom, 1.0 - RARE.value / max(1, len(drawn)))  # Bonferroni's bound
    measured = {
        "largest_regular": steady[:, 0].max() if steady.size else 0.0,
        "at_half_step": steady[:, 1].max() if steady.size else 0.0,
        **{f"divergence_{case}": time for case, time in since.items()},
        "late_distance": max((distance for distance, _ in distances), default=0.0),
    }
    criterion = AllOf(
        Below(SEEN, "at_half_step", label="difference of regular runs at half of the assumed step"),
        Distance(
            likely,
            "late_distance",
            label="distance of a chaotic run from the mean late l2 norm of its ensemble, in"
            " standard deviations",
        ),
    )
    caveats = [
        f"{case} differs visibly from tau = {since[case]:.3g} on, by up to {full_step:.2g} with the"
        f" assumed step and {half_step:.2g} with half of it"
        for case, (full_step, half_step) in zip(
            map(str, steady["case"].values), steady.values, strict=True
        )
        if full_step > SEEN.value
    ]
    if drawn:
        divergences = ", ".join(f"{case} from tau = {since[case]:.3g} on" for case in drawn)
        caveats.append(f"chaotic cases diverge as members of an ensemble do: {divergences}")
    return judge(measured, criterion, "; ".join(caveats))


# --- Figs 5 and 6 ---------------------------------------------------------------------------------


def largest_difference(first: xr.Dataset, second: xr.Dataset) -> float:
    """Return the largest relative difference between the norms of the pair in two sweeps."""
    if first.sizes["half_width"] < FEWEST:
        raise UndecidableError(f"the sweeps have fewer than {FEWEST} half-widths")
    return max(
        float(abs(second[norm] / first[norm] - 1.0).sel(quantity="pair").max())
        for norm in ("l2", "linf")
    )


def shares_inside(right: xr.Dataset) -> np.ndarray:
    """Return the share of the second solver's runs within the range of the first's.

    It is (solver_step,), and the smallest share over all half-widths.
    """
    if right.sizes["half_width"] < missing.FEWEST or right.sizes["first_member"] < missing.FEWEST:
        raise UndecidableError("the ensembles of the second solver are too small")
    low, high = right["first_l2"].min("first_member"), right["first_l2"].max("first_member")
    inside = (right["l2"] >= low) & (right["l2"] <= high)
    return inside.mean("member").min("half_width").values


def first_as_second(right: xr.Dataset) -> xr.Dataset:
    """Return, as a control, ensembles with runs of the first solver in place of the second's."""
    drawn = right["first_l2"].isel(first_member=slice(right.sizes["member"]))
    drawn = drawn.rename(first_member="member").broadcast_like(right["l2"])
    remaining = right["first_l2"].isel(first_member=slice(right.sizes["member"], None))
    return right.drop_vars("first_l2").assign(
        l2=drawn.transpose(*right["l2"].dims), first_l2=remaining
    )


def coarse_alone(right: xr.Dataset) -> xr.Dataset:
    """Return, as a control, ensembles with the second solver's coarse runs for both steps."""
    largest = right["solver_step"].max()
    return repeat("solver_step", float(largest), at=slice(None), names="l2")(right)


@claim(
    "Section 5, end",
    "With the second solver Figs 5 and 6 show no significant differences.",
    (*FIRST, *SECOND, RIGHT),
    controls=(
        ClaimControl(
            "runs of the first solver, as those of the second",
            {**dict(zip(SECOND, FIRST, strict=True)), RIGHT: first_as_second},
            confirms=True,
        ),
        ClaimControl(
            "the sweep at Omega = -4 in place of the second solver's at Omega = 8",
            {SECOND[1]: "fig6_right"},
        ),
        ClaimControl("a coarse step in place of both", {RIGHT: coarse_alone}),
    ),
    on=("fig5_left", "fig6_left", "fig6_right"),
)
def second_solver_sweeps(
    left_5: xr.Dataset,
    left_6: xr.Dataset,
    second_5: xr.Dataset,
    second_6: xr.Dataset,
    right: xr.Dataset,
) -> Finding:
    """Compare regular sweeps point by point, and a chaotic sweep by ensembles at two steps.

    The paper gives no step: if the outcome depends on it, the claim is undecided.
    """
    shares = shares_inside(right)
    measured = {
        "fig5_left": largest_difference(left_5, second_5),
        "fig6_left": largest_difference(left_6, second_6),
        "share_inside": shares[0],
        "coarse_share_inside": shares[-1],
    }
    regular = Below(SEEN, "fig5_left", "fig6_left", label="largest difference of a regular sweep")
    label = "share of runs within the range of the first solver in Fig 6, right, at every M"
    same_range = Above(MAJORITY, "share_inside", "coarse_share_inside", label=label)
    if regular.holds(measured) and len(same_range.failing(measured)) == 1:
        fine, coarse = right["solver_step"].values[[0, -1]]
        because = (
            "the paper gives no step. In Fig 6, right, we compare the second solver's runs with the"
            f" range of {right.sizes['first_member']} runs of the first: with a step of {fine:g} at"
            f" least {measured['share_inside']:.0%} are within it at each M, with {coarse:g} only"
            f" {measured['coarse_share_inside']:.0%} at some M"
        )
        return undecided(measured, because, AllOf(regular, same_range))
    return judge(measured, AllOf(regular, same_range), "Fig 5, right, is not compared")
