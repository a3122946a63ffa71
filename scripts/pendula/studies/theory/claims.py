"""Sections 2 to 4: the equations, their symmetries and derivation; Lemmas 1 and 2; Theorems 1 to 3.

Last stands the sentence of Section 6 on how sharp the bounds are.
"""

from collections.abc import Callable

import numpy as np

from pendula.ledger.claim import LARGE, SMALL, checks, claim, number
from pendula.ledger.criterion import (
    Above,
    AllOf,
    AtLeast,
    AtMost,
    Below,
    Finding,
    Near,
    judge,
    undecided,
    within_tolerance,
)
from pendula.measures.norms import growth_margin

SECTION = 2

# ASSUME: a bound that rounding may reach is exceeded by more than 1e-6.
ROUNDING = 1e-6
# ASSUME: bounds that are reached exactly may be exceeded by rounding: of P, and of H - bound.
ROUNDING_OF_P, ROUNDING_OF_H = 1e-7, 1e-12
# ASSUME: an order counts as three if it is nearer to three than to another whole number; a
# symmetry is missing if it is missed by more than one part in a thousand.
ORDER, NEAR, MISSED = 3.0, 0.5, 1e-3
# ASSUME: what the charts resolve: bounded beats change a slope by 6 / tau at most, here tau = 40;
# an unstable cell must grow at half of its predicted rate once that is twice the resolution.
RESOLVED = 0.15
# ASSUME: data in l2 grow linearly if the exponent of tau is above 0.9.
LINEAR = 0.9
# ASSUME: a bound is "sharp" if it is reached to 90 %; where it is attained, to 99.9 %.
SHARP, ATTAINED = 0.9, 0.999


def decides(place: str, says: str, *names: str) -> Callable:
    """Return a decorator: the function, which takes these checks, decides the claim."""
    return claim(place, says, checks(*names))


@decides(
    "Section 2, (7) and (8)",
    "The equations are the Hamiltonian system of the energy H.",
    "gradient",
)
def hamiltonian(check) -> Finding:
    return within_tolerance(check, "gradient_error")


@decides("Section 2, (8)", "The energy H is conserved.", "conservation")
def conserved(check) -> Finding:
    return within_tolerance(check, "energy_drift")


@decides("Abstract; Section 2", "The equations have no gauge symmetry.", "conservation")
def no_gauge(conservation) -> Finding:
    defect = float(conservation["gauge_defect"].max())
    return judge({"gauge_defect": defect}, Above(MISSED, "gauge_defect"))


@decides("Introduction", "The energy is the only integral of motion.", "conservation")
def one_integral(conservation) -> Finding:
    measured = {"l2_change": conservation["l2_change"].max()}
    return undecided(
        measured, "numbers show that the l2 norm is not conserved, not that nothing else is"
    )


@decides(
    "Section 2, (9) and (10)", "In the variables u, v the equations take the form (10).", "pt_form"
)
def pt_form(check) -> Finding:
    return within_tolerance(check, "rates", "trajectory")


@decides(
    "Section 2, after (11)",
    "The PT-symmetric form is Hamiltonian with a modified energy.",
    "pt_form",
)
def pt_energy(check) -> Finding:
    return within_tolerance(check, "energy_gradient")


@decides("Section 2, (11)", "The form (10) is invariant under the action of P and T.", "pt_form")
def pt_symmetry(pt) -> Finding:
    measured = {name: pt[name].max() for name in ("pt", "p_alone", "t_alone")}
    alone = min(measured["p_alone"], measured["t_alone"])
    caveat = ""
    if alone > 1e-6:
        caveat = "P and T together are a symmetry; either alone misses by 2 gamma max(|u|, |v|)"
    return judge(measured, AtMost(pt["pt"].attrs["tolerance"], "pt"), caveat)


@decides(
    "Section 2, before (7)",
    "The equations are invariant under the exchange of A and B.",
    "symmetries",
)
def exchange(check) -> Finding:
    return within_tolerance(check, "exchange")


@decides(
    "Section 2, (5) and (6)",
    "A = B is an invariant reduction on which the drive has no effect.",
    "symmetries",
    "opposite",
)
def synchronised(symmetries, opposite) -> Finding:
    finding = within_tolerance(symmetries, "synchrony", "norm_drift", "scalar")
    departure = number(opposite, "departure")
    return finding._replace(measured=finding.measured | {"opposite_departure": departure})


@decides(
    "Section 2, after (4)",
    "The amplitudes in the expansion move with tau = mu^2 t / 2.",
    "expansion",
)
def slow_time(expansion) -> Finding:
    order = number(expansion, "order", reading="mu^2 t / 2")
    measured = {"order": order, "smallest_error": expansion["angle_error"].values[-1, 0]}
    return judge(measured, Near(ORDER, NEAR, "order", says="order in mu"))


@decides("Section 2, (3)", "The amplitudes in the expansion are functions of mu^2 t.", "expansion")
def printed_time(expansion) -> Finding:
    order = number(expansion, "order", reading="mu^2 t")
    measured = {"order": order, "smallest_error": expansion["angle_error"].values[-1, 1]}
    fails = f"read so, the error falls only as mu^{order:.1f}, not as mu^3"
    return judge(measured, Near(ORDER, NEAR, "order", says="order in mu"), fails=fails)


@decides(
    "Section 2, (2) and (4)",
    "The drive D = 2 gamma mu^2 cos 2 omega t gives gamma (conj B - conj A).",
    "expansion",
)
def drive_sign(expansion) -> Finding:
    right = number(expansion, "order", reading="mu^2 t / 2")
    wrong = number(expansion, "order", reading="mu^2 t / 2, opposite drive")
    measured = {"order": right, "order_opposite": wrong}
    here, there = (f"order in mu with the {sign} sign" for sign in ("printed", "opposite"))
    criterion = AllOf(
        Above(ORDER - NEAR, "order", says=here), Below(ORDER - NEAR, "order_opposite", says=there)
    )
    return judge(measured, criterion)


@decides(
    "Section 3, (15)",
    "The characteristic equation factorises into the dispersion relation.",
    "dispersion",
)
def dispersion(check) -> Finding:
    return within_tolerance(check, "eigenvalue_error", "factorisation")


@decides("Lemma 1", "Zero is linearly stable for |gamma| < gamma_0.", "chart")
def stable_below(chart) -> Finding:
    below = np.abs(chart["gamma"]) < chart["infinite_threshold"]
    measured = {
        "fastest": chart["measured"].where(below).max(),
        "cells": below.sum(),
        "misclassified": number(chart, "misclassified"),
    }
    return judge(measured, AtMost(RESOLVED, "fastest", says="fastest growth"))


@decides("Lemma 1", "Zero is linearly unstable for |gamma| > gamma_0.", "chart")
def unstable_above(chart) -> Finding:
    above = (chart["gamma"] > chart["infinite_threshold"]) & (chart["gamma"] > 0)
    finite = chart["gamma"] > chart["finite_threshold"]
    slow = above & finite & (chart["measured"] < 0.5 * chart["finite_rate"])
    resolved = slow & (chart["finite_rate"] > 2.0 * RESOLVED)
    spared = int((above & ~finite).sum())
    measured = {"cells": above.sum(), "contradictions": resolved.sum(), "finite_stable": spared}
    caveat = f"{spared} such cells are stable on the finite chain" if spared else ""
    return judge(measured, AtMost(0, "contradictions"), caveat)


@decides(
    "Lemma 1",
    "Zero is linearly unstable for Omega in [0, 4 epsilon] and any gamma but 0.",
    "chart",
    "windows",
    "measured_windows",
)
def unstable_band(chart, windows, measured_windows) -> Finding:
    inside = chart["omega"].where((chart["omega"] >= 0) & (chart["infinite_threshold"] == 0))
    rates = chart["infinite_rate"].where(np.isfinite(inside) & (chart["gamma"] > 0))
    largest = windows["largest_gamma"]
    measured = {
        "slowest_infinite_rate": rates.min(),
        "largest_gamma_with_a_window": largest.values[-1],
        "misclassified": number(measured_windows, "misclassified"),
    }
    caveat = ""
    if float(windows["count"].max()) > 0:
        caveat = "on the infinite chain; a finite one keeps windows of stability for small gamma"
    criterion = AllOf(Above(0.0, "slowest_infinite_rate"), AtMost(0, "misclassified"))
    return judge(measured, criterion, caveat)


@decides("Proof of Lemma 1", "At |gamma| = gamma_0 perturbations grow polynomially.", "threshold")
def threshold_growth(threshold) -> Finding:
    exponents = threshold["spreading_exponent"]
    measured = {
        "wave_error": threshold["wave_error"].max(),
        "l2_exponent": exponents.sel(norm="l2").mean(),
        "linf_exponent": exponents.sel(norm="linf").mean(),
        "finite_gap": threshold["finite_gap"].min(),
    }
    caveat = ""
    if measured["l2_exponent"] < LINEAR:
        caveat = (
            "a single wave grows as tau, data in l2 only as tau^(1/2), and not in l-infinity;"
            " the Dirichlet chain is stable there"
        )
    says = "error of the wave that grows as 4 gamma tau"
    criterion = AtMost(threshold["wave_error"].attrs["tolerance"], "wave_error", says=says)
    return judge(measured, criterion, caveat)


@claim(
    "Lemma 2, (19)",
    "The squared l2 norm grows at most as exp(4 |gamma tau|).",
    (*checks("growth"), *SMALL, *LARGE),
)
def growth_bound(check, *trajectories) -> Finding:
    steepest = [
        growth_margin(ds["tau"].values, ds["l2"].values, ds.attrs["gamma"])["steepest"]
        for ds in trajectories
    ]
    measured = {"steepest": max(steepest), "random_data": check["steepest"].max()}
    measured["sharp_case"] = number(check, "sharpest")
    says = "slope of log P over 4 gamma"
    return judge(measured, AtMost(1.0 + ROUNDING, "steepest", "random_data", says=says))


@decides("Proof of Lemma 2", "The l2 norm obeys the balance equation.", "balance")
def balance(check) -> Finding:
    return within_tolerance(check, "pointwise", "integrated")


# --- Section 4 ------------------------------------------------------------------------------------


@decides(
    "Section 4, (17), (18), (21), (22), (25), (27)",
    "The inequalities behind the theorems hold.",
    "inequalities",
)
def inequalities(check) -> Finding:
    return within_tolerance(check, "left_over_right", "bound_excess")


def theorem(name: str, says: str, *families: str) -> Callable:
    """Return the function that decides a theorem: no random or searched data break its bounds."""

    def decide(samples, worst) -> Finding:
        sampled = samples["worst_sample"].sel(family=list(families))
        searched = worst["worst"].values[np.isin(worst["searched_family"].values, families)]
        measured = {"worst_sample": sampled.max(), "worst_searched": searched.max()}
        says = "largest P over its bound"
        return judge(measured, AtMost(1.0 + ROUNDING_OF_P, *measured, says=says))

    decide.__name__ = name
    return claim(name.replace("_", " ").capitalize(), says, checks("samples", "worst"))(decide)


theorem_1 = theorem(
    "theorem_1", "For Omega > 2 gamma + 4 epsilon the l2 norm is bounded for all data.", "theorem_1"
)

theorem_2 = theorem(
    "theorem_2",
    "For Omega < -2 gamma the l2 norm is bounded for small data.",
    *("theorem_2_ball", "theorem_2_energy", "theorem_2_widened"),
)


@decides("Proof of Theorem 2", "-H > 0 is constant in time.", "negative_depth")
def positive_depth(depth) -> Finding:
    first = number(depth, "first_negative")
    measured = {"first_negative": first, "assured": number(depth, "assured")}
    caveat = f"only for small data: the pair (x, 0) has -H <= 0 from x = {first:.3g}"
    criterion = Below(0.0, "assured", says="largest H of data with P below 4 a")
    return judge(measured, criterion, caveat if first < np.inf else "")


theorem_3 = theorem(
    "theorem_3", "On N sites the l2 norm is bounded for all parameters and data.", "theorem_3"
)


@decides(
    "Proof of Theorem 3",
    "The quadratic part of H is at least -(|Omega| + gamma + 4 epsilon) P.",
    "theorem_3_constant",
)
def theorem_3_proof(constant) -> Finding:
    measured = {"printed": constant["printed"].min(), "corrected": constant["corrected"].min()}
    measured["smallest_chain"] = smallest = number(constant, "smallest")
    fails = f"A = -B = x (-1)^n breaks it from {smallest:.0f} sites on; it needs 2 gamma"
    return judge(measured, AtLeast(-ROUNDING_OF_H, "printed", says="H - bound"), fails=fails)


@decides("Section 6", "The bounds on the l2 norms are sharp.", "worst")
def sharp_bounds(worst) -> Finding:
    measured = {str(q): worst["worst"].sel(question=q) for q in worst["question"].values}
    measured["attained_theorem_3"] = number(worst, "attained")
    families = worst["searched_family"].values
    ball = float(worst["worst"].values[families == "theorem_2_ball"].max())
    reached = (worst["worst"] / worst["small_data"]).values[families != "theorem_3"]
    caveat = f"the constant C_0 of Theorem 2 is reached to {ball:.2f} only" if ball < SHARP else ""
    measured["least_over_tiny_data"] = reached.min()
    sharp = Above(SHARP, "least_over_tiny_data", says="least of them over its value for tiny data")
    return judge(measured, AllOf(sharp, Above(ATTAINED, "attained_theorem_3")), caveat)
