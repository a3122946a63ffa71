"""Section 3: claims on the linear stability of the chain at rest, Lemma 1 and its proof."""

import numpy as np
import xarray as xr
from latticode.numerics.elementary import log
from replication.ledger.changes import exchange, roll, shift, take
from replication.ledger.claim import ClaimControl, Kind, claim
from replication.ledger.criterion import Above, AllOf, AtLeast, AtMost, Below, Finding, Near, judge
from replication.ledger.cutoff import Cutoff

from pendula.claims import checks

from .claims_model import by_algebra

SECTION = 3

RESOLVED = Cutoff(
    0.15, "bounded oscillations change a slope by up to 6 / tau in the second half of a run"
)
HALF = Cutoff(0.5, "instability means growth at half of the predicted rate or faster")
RESOLVED_EXPONENT = Cutoff(0.05, "exponents are measured to one decimal")


@by_algebra(
    "Section 3, (15)",
    "The characteristic equation factorises into the dispersion relation, whose first pair of "
    "roots is always real, and whose second pair is real if |kappa| > 2 |gamma| and imaginary "
    "otherwise.",
    {
        "(14)": "kappa = 2 epsilon sin^2(theta / 2) - Omega",
        "(15)": "the roots for half of the drive",
    },
)
def dispersion() -> None:
    """By (14) and (15) the squared roots are kappa^2 and kappa^2 - 4 gamma^2."""


@claim(
    "Lemma 1",
    "Zero is linearly stable for |gamma| < gamma_0, and linearly unstable for |gamma| > gamma_0.",
    checks("chart"),
    controls=(ClaimControl("gamma_0 of another Omega", roll("gamma_0", {"omega": 4})),),
    kind=Kind.THEOREM,
)
def stable_below(chart: xr.Dataset) -> Finding:
    """Require no growth below gamma_0, and growth at half of the predicted rate above it.

    The prediction is for N sites. Rates that are too low to be measured are left out.
    """
    below, above = (chart["gamma"] < chart["gamma_0"]), (chart["gamma"] > chart["gamma_0"])
    is_resolved = above & (chart["finite_rate"] > 2.0 * RESOLVED.value)
    measured = {
        "fastest": chart["measured"].where(below).max(),
        "slowest": (chart["measured"] / chart["finite_rate"].where(is_resolved)).min(),
        "cells_below": below.sum(),
        "cells_above": above.sum(),
    }
    spared = int((above & (chart["finite_rate"] == 0.0)).sum())
    caveat = f"{spared} drives above gamma_0 leave the finite chain stable" if spared else ""
    criterion = AllOf(
        AtMost(RESOLVED, "fastest", label="fastest growth below gamma_0"),
        AtLeast(HALF, "slowest", label="slowest growth above gamma_0 over the predicted rate"),
    )
    return judge(measured, criterion, caveat)


@claim(
    "Lemma 1",
    "Zero is linearly unstable for Omega in [0, 4 epsilon] and any nonzero gamma.",
    checks("chart"),
    controls=(ClaimControl("growth at another Omega", roll("measured", {"omega": 4})),),
    kind=Kind.THEOREM,
)
def unstable_band(chart: xr.Dataset) -> Finding:
    slowest = chart["measured"].where((chart["gamma_0"] == 0.0) & (chart["gamma"] > 0.0)).min()
    largest = float(chart["finite_curve"].where(chart["infinite_curve"] == 0.0).max())
    caveat = (
        f"on the infinite chain; on {int(chart['sites'])} sites drives below {largest:.2g} leave "
        "some Omega of the band stable"
    )
    label = "slowest growth within the band"
    return judge({"slowest": slowest}, Above(RESOLVED, "slowest", label=label), caveat)


@claim(
    "Section 3, before Lemma 1",
    "The bound gamma_0 on the drive is sharp.",
    checks("threshold"),
    controls=(ClaimControl("a gamma_0 that is too low by 0.05", shift("excess", 0.05)),),
    kind=Kind.THEOREM,
)
def sharp_threshold(check: xr.Dataset) -> Finding:
    """Require that the threshold of a finite chain tends to gamma_0 with its length."""
    excess, sites = check["excess"], check["sites"].values + 1.0
    steps = log(excess.isel(sites=0) / excess.isel(sites=-1)) / log(sites[-1] / sites[0])
    measured = {"order": steps.min(), "excess_of_the_longest": excess.isel(sites=-1).max()}
    caveat = "on the infinite chain; on N sites the threshold is higher by O(1 / (N + 1)^2)"
    label = "order in 1 / (N + 1) of the threshold of N sites minus gamma_0"
    return judge(measured, AtLeast(1.0, "order", label=label), caveat)


@claim(
    "Proof of Lemma 1",
    "Above gamma_0 waves grow near theta = pi if Omega > 4 epsilon, near 0 if Omega < 0.",
    checks("threshold"),
    controls=(
        ClaimControl("the waves of an Omega on the other side of the band", exchange("omega")),
    ),
    kind=Kind.THEOREM,
)
def unstable_waves(check: xr.Dataset) -> Finding:
    edge = abs(check["leading_wave"] - np.pi * (check["omega"] > 0.0)).max(skipna=False)
    label = "distance of the leading wave from its edge, 0 or pi"
    return judge({"from_its_edge": edge}, Below(0.5 * np.pi, "from_its_edge", label=label))


@claim(
    "Proof of Lemma 1",
    "At |gamma| = gamma_0 perturbations grow polynomially.",
    checks("threshold"),
    controls=(ClaimControl("a drive that exceeds gamma_0", take(wave_exponent="exponent_above")),),
    kind=Kind.THEOREM,
)
def threshold_growth(threshold: xr.Dataset) -> Finding:
    measured = {"wave_exponent": threshold["wave_exponent"].max(skipna=False)}
    caveat = "on N sites at their own threshold; at gamma_0, which is lower, no wave grows"
    criterion = Near(1.0, RESOLVED_EXPONENT, "wave_exponent", label="exponent of tau of a wave")
    return judge(measured, criterion, caveat)
