"""Section 3: the linear stability of the chain at rest, Lemma 1 and its proof."""

import numpy as np

from pendula.ledger.changes import exchange, roll, shift, take
from pendula.ledger.claim import Control, Kind, checks, claim
from pendula.ledger.criterion import (
    Above,
    AllOf,
    AtMost,
    Below,
    Finding,
    judge,
    tolerance,
    within_tolerance,
)
from pendula.ledger.cutoff import Cutoff

from .claims_model import IDENTITIES, proved, twin

SECTION = 3

RESOLVED = Cutoff(
    0.15,
    "bounded oscillations change a slope by up to 6 / tau in the second half of a run",
)
HALF = Cutoff(0.5, "instability means growth at half of the predicted rate or faster")
TOLD = Cutoff(0.05, "exponents are measured to one decimal")


def misclassified(cells) -> int:
    """Count cells that grow though stable, or do not though unstable, beyond what time resolves."""
    resolution, finite = cells["resolution"], cells["finite_rate"]
    grows = (finite == 0.0) & (cells["measured"] > resolution)
    stays = (finite > 2.0 * resolution) & (cells["measured"] < HALF.value * finite)
    return int((grows | stays).sum())


@claim(
    "Section 3, (15)",
    "The characteristic equation factorises into the dispersion relation, whose first pair of "
    "roots is always real, and whose second pair is real if |kappa| > 2 |gamma| and imaginary "
    "otherwise.",
    IDENTITIES,
    controls=(
        twin("(14)", "the kappa 2 epsilon sin^2(theta / 2) - Omega"),
        twin("(15)", "the roots for half of the drive"),
        twin("first roots of (15)", "the second pair in place of the first"),
        twin("second roots of (15)", "the second pair for half of the drive"),
    ),
    kind=Kind.IDENTITY,
)
def dispersion(identities) -> Finding:
    """On any chain the linear equations square to -K^2 on A = B, to 4 gamma^2 - K^2 on A = -B.

    K is symmetric, so that its eigenvalues kappa are real: these are the squares of the roots.
    """
    return proved(identities, "(14)", "(15)", "first roots of (15)", "second roots of (15)")


@claim(
    "Lemma 1",
    "Zero is linearly stable for |gamma| < gamma_0, and linearly unstable for |gamma| > gamma_0.",
    checks("chart"),
    controls=(Control("gamma_0 of another Omega", roll("infinite_threshold", {"omega": 4})),),
    kind=Kind.THEOREM,
)
def stable_below(chart) -> Finding:
    below = np.abs(chart["gamma"]) < chart["infinite_threshold"]
    above = (chart["gamma"] > chart["infinite_threshold"]) & (chart["gamma"] > 0)
    finite = chart["gamma"] > chart["finite_threshold"]
    slow = above & finite & (chart["measured"] < HALF.value * chart["finite_rate"])
    spared = int((above & ~finite).sum())
    measured = {
        "fastest": chart["measured"].where(below).max(),
        "cells_below": below.sum(),
        "cells_above": above.sum(),
        "misclassified": misclassified(chart),
        "contradictions": (slow & (chart["finite_rate"] > 2.0 * RESOLVED.value)).sum(),
        "finite_stable": spared,
    }
    caveat = f"{spared} drives above gamma_0 leave the finite chain stable" if spared else ""
    criterion = AllOf(
        AtMost(RESOLVED, "fastest", says="fastest growth below gamma_0"),
        AtMost(
            0,
            "contradictions",
            says="drives above it with growth at less than half of the predicted rate",
        ),
    )
    return judge(measured, criterion, caveat)


@claim(
    "Lemma 1",
    "Zero is linearly unstable for Omega in [0, 4 epsilon] and any nonzero gamma.",
    checks("chart", "windows", "measured_windows"),
    controls=(
        Control(
            "windows of another Omega", {"measured_windows": roll("finite_rate", {"omega": 1})}
        ),
    ),
    kind=Kind.THEOREM,
)
def unstable_band(chart, windows, measured_windows) -> Finding:
    inside = chart["omega"].where((chart["omega"] >= 0) & (chart["infinite_threshold"] == 0))
    rates = chart["infinite_rate"].where(np.isfinite(inside) & (chart["gamma"] > 0))
    measured = {
        "slowest_infinite_rate": rates.min(),
        "largest_gamma_with_a_window": windows["largest_gamma"].values[-1],
        "misclassified": misclassified(measured_windows),
    }
    caveat = ""
    if float(windows["count"].max()) > 0:
        caveat = "on the infinite chain; finite ones have windows of stability at small gamma"
    criterion = AllOf(
        Above(0.0, "slowest_infinite_rate", says="least growth rate on the infinite chain"),
        AtMost(0, "misclassified", says="wrong predictions for finite chains"),
    )
    return judge(measured, criterion, caveat)


@claim(
    "Section 3, before Lemma 1",
    "The bound gamma_0 on the drive is sharp.",
    checks("sharp_threshold"),
    controls=(
        Control("gamma_0 of an Omega that is 0.1 farther off", shift("threshold_error", 0.05)),
    ),
    kind=Kind.THEOREM,
)
def sharp_threshold(check) -> Finding:
    gap = abs(check["threshold_found"].isel(sites=-1) - check["threshold_limit"])
    measured = {"distance": check["threshold_error"].max(), "distance_of_the_longest": gap.max()}
    caveat = "on the infinite chain; on N sites the threshold is higher by O(1 / (N + 1)^2)"
    says = "distance from gamma_0 to the threshold, extrapolated to the infinite chain"
    criterion = AtMost(tolerance(check, "threshold_error"), "distance", says=says)
    return judge(measured, criterion, caveat)


@claim(
    "Proof of Lemma 1",
    "Above gamma_0 waves grow near theta = pi if Omega > 4 epsilon, near 0 if Omega < 0.",
    checks("unstable_waves"),
    controls=(Control("the waves of an Omega on the other side of the band", exchange("omega")),),
    kind=Kind.THEOREM,
)
def unstable_waves(check) -> Finding:
    """Ask that no wave of the chain is nearer to the edge, and for the side of the leading one."""
    finding, above = within_tolerance(check, "waves_nearer"), check["omega"] > 0.0
    edge = abs(check["leading_wave"] - np.pi * above)
    criterion = AllOf(
        finding.criterion,
        Below(0.5 * np.pi, "from_its_edge", says="distance of the leading wave from its edge"),
    )
    return judge(finding.measured | {"from_its_edge": edge.max(skipna=False)}, criterion)


@claim(
    "Proof of Lemma 1",
    "At |gamma| = gamma_0 perturbations grow polynomially.",
    checks("threshold"),
    controls=(Control("a drive that exceeds gamma_0", take(wave_error="wave_error_above")),),
    kind=Kind.THEOREM,
)
def threshold_growth(threshold) -> Finding:
    exponents, one_site = threshold["spreading_exponent"], np.inf
    in_l2, in_linf = (exponents.sel(norm=norm) for norm in ("l2", "linf"))
    measured = {
        "wave_error": threshold["wave_error"].max(),
        "least_l2_exponent": in_l2.min(),
        "largest_l2_exponent": in_l2.max(),
        "largest_linf_exponent": in_linf.max(),
        "l2_exponent_of_one_site": in_l2.sel(decay=one_site).mean(),
        "linf_exponent_of_one_site": in_linf.sel(decay=one_site).mean(),
        "law_error": threshold["spreading_error"].max(),
        "finite_gap": threshold["finite_gap"].min(),
    }
    caveat = (
        "the power depends on the perturbation: a wave grows as tau, one that decays as |n|^-s "
        "with s < 1 as tau^(3/2 - s) in l2 and tau^(1 - s) in l-infinity, and a summable one, such "
        "as one site, as tau^(1/2) in l2 and not in l-infinity; on the Dirichlet chain none grows"
    )
    error = tolerance(threshold, "wave_error")
    criterion = AllOf(
        AtMost(error, "wave_error", says="error of the predicted growth 4 gamma tau of a wave"),
        Above(0.0, "least_l2_exponent", says="least exponent of tau in l2"),
        AtMost(1.0, "largest_l2_exponent", says="largest exponent of tau in l2"),
        AtMost(TOLD, "law_error", says="distance of the exponents from the predicted ones"),
    )
    return judge(measured, criterion, caveat)
