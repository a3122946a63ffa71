"""Claims that carry the expansion, Lemma 1 and the chaotic state over to the pendula."""

import numpy as np
import xarray as xr
from latticode.measures.confidence import difference_limits, order_limits
from latticode.numerics.elementary import log
from replication.ledger.chances import RARE
from replication.ledger.changes import exchange, keep, repeat, scale
from replication.ledger.claim import ClaimControl, Origin, claim
from replication.ledger.criterion import (
    Above,
    AtLeast,
    AtMost,
    Below,
    Distance,
    Finding,
    Near,
    UndecidableError,
    Verdict,
    judge,
)
from replication.ledger.cutoff import Cutoff

from pendula.claims import FACTOR

SECTION = 7
LEMMA_1 = "Section 3, Lemma 1, for the pendula (1)"
REMAINDER, THRESHOLD, TOP = (
    f"pendula/{name}" for name in ("remainder", "threshold", "over_the_top")
)
CASES = ("fig2_small", "fig2_large", "fig3_small", "fig3_large", "fig4_small", "fig4_large")
SLOW = "mu^2 t / 2"
"""The slow time of the expansion (3)."""
SMALL_ANGLES = 0.15
"""Up to this mu the angles of the chaotic state stay below a quarter of a turn."""
SMALL_MU_ALONE = keep(mu=slice(None, SMALL_ANGLES))

ORDER = Cutoff(0.25, "an order counts as a whole number if it differs from one by up to a quarter")
SAME = Cutoff(0.1, "half of the change of thermal P from Omega = 0 to 1")


def sort_by_falling_mu(data: xr.Dataset, fewest: int = 2) -> xr.Dataset:
    """Return the dataset sorted by falling mu. Raises UndecidableError if it has too few mu."""
    if data.sizes["mu"] < fewest:
        raise UndecidableError(f"an order requires {fewest} values of mu")
    return data.isel(mu=np.argsort(-data["mu"].values))


def order_of(values: xr.DataArray) -> np.ndarray:
    """Return the order in mu of `values` (..., mu), computed from the last two, the smallest mu."""
    coarse, fine = values.isel(mu=-2), values.isel(mu=-1)
    ratio = float(coarse["mu"] / fine["mu"])
    return log(coarse.values / fine.values) / log(ratio)


# --- The expansion (3) ----------------------------------------------------------------------------

FAST_SLOW_TIME = ClaimControl("amplitudes with the slow time mu^2 t", exchange("slow_time"))


@claim(
    "Section 2, after (3)",
    "The expansion is justified on times of the order mu^-2: up to a tau of order 1 the angles of "
    "(3) and (4) differ from those of the pendula by the order mu^3.",
    (REMAINDER,),
    (FAST_SLOW_TIME,),
    on=CASES,
)
def expansion_order(remainder: xr.Dataset) -> Finding:
    order = order_of(sort_by_falling_mu(remainder)["error"].sel(slow_time=SLOW))
    measured = {
        "least_order": order.min(),
        "largest_order": order.max(),
        "up_to_tau": remainder.attrs["end_time"],
    }
    label = "order in mu of the error of the angles"
    return judge(measured, Near(3.0, ORDER, "least_order", "largest_order", label=label))


@claim(
    "Section 2, before (4)",
    "The remainder of the expansion stays bounded as the system evolves.",
    (REMAINDER,),
    (FAST_SLOW_TIME,),
    on=CASES,
)
def remainder_bounded(remainder: xr.Dataset) -> Finding:
    """Compare the remainder at two mu and one slow time.

    Halving mu makes t = 2 tau / mu^2 four times as large, so the comparison shows terms that grow
    in proportion to t. Equations (4) are the condition that no such term exists.
    """
    errors = sort_by_falling_mu(remainder)["error"].sel(slow_time=SLOW).isel(mu=[-2, -1])
    mu = errors["mu"]
    coarse, fine = (errors / (mu * mu * mu)).transpose("mu", "case")
    times = float(mu[0] * mu[0] / (mu[1] * mu[1]))
    end = float(remainder.attrs["end_time"])
    label = f"growth of the remainder over mu^3 at tau = {end:g} as t grows {times:g} times"
    caveat = f"as mu goes to 0 at a fixed slow time, here up to tau = {end:g}"
    growth = (fine.values / coarse.values).max()
    return judge({"largest_growth": growth}, Below(FACTOR, "largest_growth", label=label), caveat)


# --- Lemma 1 --------------------------------------------------------------------------------------


def outside_band(data: xr.Dataset) -> xr.Dataset:
    """Return the data at detunings outside the band. Raises UndecidableError if there are none."""
    is_outside = data["gamma_0_lemma"] > 0
    if not is_outside.any():
        raise UndecidableError("no detuning lies outside the band")
    return data.isel(omega=is_outside.values)


@claim(
    LEMMA_1,
    "In the limit of small mu the pendula become unstable at the gamma_0 of Lemma 1, up to the "
    "order mu^2.",
    (THRESHOLD,),
    (ClaimControl("thresholds for half of the drive", scale("gamma_0_lemma", 2.0)),),
    origin=Origin.OPEN,
    rejected=Verdict.NOT_CARRIED,
)
def lemma_1_is_the_limit(threshold: xr.Dataset) -> Finding:
    thresholds = outside_band(sort_by_falling_mu(threshold))
    order = order_of(abs(thresholds["gamma_0"] - thresholds["gamma_0_lemma"]))
    measured = {"least_order": order.min(), "largest_order": order.max()}
    label = "order in mu of the difference"
    return judge(measured, Near(2.0, ORDER, *measured, label=label))


@claim(
    LEMMA_1,
    "The pendula at rest are linearly stable if gamma is below the gamma_0 of Lemma 1.",
    (THRESHOLD,),
    (ClaimControl("only detunings below the band", keep(omega=slice(None, -1e-6)), confirms=True),),
    origin=Origin.OPEN,
    rejected=Verdict.NOT_CARRIED,
)
def lemma_1_for_the_pendula(threshold: xr.Dataset) -> Finding:
    """Compare the exact thresholds with Lemma 1's at each mu, outside the band."""
    thresholds = outside_band(threshold)
    fails = "above the band a drive weaker than gamma_0 makes the pendula unstable"
    label = "least threshold of the pendula over that of Lemma 1"
    criterion = AtLeast(1.0, "least_share", label=label)
    share = (thresholds["gamma_0"] / thresholds["gamma_0_lemma"]).min()
    return judge({"least_share": share}, criterion, fails=fails)


# --- The chaotic state ----------------------------------------------------------------------------


@claim(
    "Section 5, Fig 4, for the pendula (1)",
    "At Omega = 0 and small mu the pendula reach a chaotic state with the power of the amplitudes.",
    (TOP,),
    (
        ClaimControl("angles in place of their envelope", scale("site_power", 0.5)),
        ClaimControl("mu in reverse order", exchange("mu")),
    ),
    origin=Origin.OPEN,
    rejected=Verdict.NOT_CARRIED,
)
def same_sea(over_the_top: xr.Dataset) -> Finding:
    """Compare P per site at the smallest mu with P of the amplitudes on the same chain.

    At larger mu pendula go over the top, and P cannot be computed from their angles.
    """
    if over_the_top.sizes["member"] < 2:
        raise UndecidableError("a difference of means requires two members")
    slowest, amplitudes = over_the_top.sortby("mu").isel(mu=0), over_the_top["amplitude_power"]
    excess, power = difference_limits(slowest["site_power"], amplitudes), float(amplitudes.mean())
    measured = {"difference": abs(excess.value) / power, "its_limits": excess.half / power}
    label = "relative difference of P per site, and half of its confidence interval"
    smallest = float(over_the_top["mu"].min())
    caveat = f"at mu = {smallest:g}, where they differ by {measured['difference']:.1%}"
    return judge(measured, Distance(SAME, *measured, label=label), caveat)


@claim(
    "Abstract and Section 6, for the pendula (1)",
    "The l-infinity norm of the pendula at Omega = 0 remains finite: each oscillates.",
    (TOP,),
    (ClaimControl(f"only mu up to {SMALL_ANGLES:g}", SMALL_MU_ALONE, confirms=True),),
    origin=Origin.OPEN,
    rejected=Verdict.NOT_CARRIED,
)
def pendula_stay_below_the_top(over_the_top: xr.Dataset) -> Finding:
    shares = over_the_top["passed"].isel(tau=-1)
    label = "largest share of runs in which a pendulum goes over the top"
    fails = "at larger mu some pendula go over the top after a while and keep rotating"
    criterion = AtMost(0.0, "largest_share", label=label)
    return judge({"largest_share": shares.max()}, criterion, fails=fails)


@claim(
    "Section 6, for the pendula (1)",
    "At a smaller mu it takes longer until a pendulum goes over the top.",
    (TOP,),
    (
        ClaimControl("mu in reverse order", exchange("mu")),
        ClaimControl(
            "the same times of passage at all mu", repeat("mu", SMALL_ANGLES, slice(None))
        ),
    ),
    origin=Origin.OPEN,
    rejected=Verdict.NOT_CARRIED,
)
def waiting_grows(over_the_top: xr.Dataset) -> Finding:
    """Compare the first passages of all pairs of runs at two mu, by Jonckheere's test.

    If mu did not matter, the run at the smaller mu would take longer in half of the pairs.
    """
    times = over_the_top.sortby("mu")["passage_time"].transpose("mu", "member").values
    if len(times) < 2:
        raise UndecidableError("passages are known at fewer than two mu")
    share = order_limits(times, 1.0 - RARE.value)
    label = "lower limit of the share of pairs in which the run at the smaller mu takes longer"
    measured = {"share": share.value, "share_low": share.low}
    return judge(measured, Above(0.5, "share_low", label=label))
