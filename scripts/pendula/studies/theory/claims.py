"""Sections 2 and 3: the equations, their symmetries and derivation; Lemmas 1 and 2."""

import numpy as np

from pendula.ledger.claim import LARGE, SMALL, checks, claim, number
from pendula.ledger.criterion import (
    Above,
    AllOf,
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
# ASSUME: an order counts as three if it is nearer to three than to another whole number; a
# symmetry is missing if it is missed by more than one part in a thousand.
ORDER, NEAR, MISSED = 3.0, 0.5, 1e-3
# ASSUME: what the charts resolve: bounded beats change a slope by 6 / tau at most, here tau = 40;
# an unstable cell must grow at half of its predicted rate once that is twice the resolution.
RESOLVED = 0.15
# ASSUME: data in l2 grow linearly if the exponent of tau is above 0.9.
LINEAR = 0.9


@claim(
    "hamiltonian",
    "Section 2, (7) and (8)",
    "The equations are the Hamiltonian system of the energy H.",
    checks("gradient"),
)
def hamiltonian(gradient) -> Finding:
    return within_tolerance(gradient, "error")


@claim(
    "conserved",
    "Section 2, (8)",
    "The energy H is conserved.",
    checks("conservation"),
)
def conserved(conservation) -> Finding:
    return within_tolerance(conservation, "energy_drift")


@claim(
    "no_gauge",
    "Abstract; Section 2",
    "The equations have no gauge symmetry.",
    checks("conservation"),
)
def no_gauge(conservation) -> Finding:
    defect = float(conservation["gauge_defect"].max())
    return judge({"gauge_defect": defect}, Above(MISSED, "gauge_defect"))


@claim(
    "one_integral",
    "Introduction",
    "The energy is the only integral of motion.",
    checks("conservation"),
)
def one_integral(conservation) -> Finding:
    measured = {"l2_change": conservation["l2_change"].max()}
    return undecided(
        measured, "numbers show that the l2 norm is not conserved, not that nothing else is"
    )


@claim(
    "pt_form",
    "Section 2, (9) and (10)",
    "In the variables u, v the equations take the form (10).",
    checks("pt_form"),
)
def pt_form(pt) -> Finding:
    return within_tolerance(pt, "rates", "trajectory")


@claim(
    "pt_energy",
    "Section 2, after (11)",
    "The PT-symmetric form is Hamiltonian with a modified energy.",
    checks("pt_form"),
)
def pt_energy(pt) -> Finding:
    return within_tolerance(pt, "energy_gradient")


@claim(
    "pt_symmetry",
    "Section 2, (11)",
    "The form (10) is invariant under the action of P and T.",
    checks("pt_form"),
)
def pt_symmetry(pt) -> Finding:
    measured = {name: pt[name].max() for name in ("pt", "p_alone", "t_alone")}
    alone = min(measured["p_alone"], measured["t_alone"])
    caveat = ""
    if alone > 1e-6:
        caveat = "P and T together are a symmetry; either alone misses by 2 gamma max(|u|, |v|)"
    return judge(measured, AtMost(pt["pt"].attrs["tolerance"], "pt"), caveat)


@claim(
    "exchange",
    "Section 2, before (7)",
    "The equations are invariant under the exchange of A and B.",
    checks("symmetries"),
)
def exchange(symmetries) -> Finding:
    return within_tolerance(symmetries, "exchange")


@claim(
    "synchronised",
    "Section 2, (5) and (6)",
    "A = B is an invariant reduction on which the drive has no effect.",
    checks("symmetries", "opposite"),
)
def synchronised(symmetries, opposite) -> Finding:
    finding = within_tolerance(symmetries, "synchrony", "norm_drift", "scalar")
    departure = number(opposite, "departure")
    return finding._replace(measured=finding.measured | {"opposite_departure": departure})


@claim(
    "slow_time",
    "Section 2, after (4)",
    "The amplitudes in the expansion move with tau = mu^2 t / 2.",
    checks("expansion"),
)
def slow_time(expansion) -> Finding:
    order = number(expansion, "order", reading="mu^2 t / 2")
    measured = {"order": order, "smallest_error": expansion["error"].values[-1, 0]}
    return judge(measured, Near(ORDER, NEAR, "order", says="order in mu"))


@claim(
    "printed_time",
    "Section 2, (3)",
    "The amplitudes in the expansion are functions of mu^2 t.",
    checks("expansion"),
)
def printed_time(expansion) -> Finding:
    order = number(expansion, "order", reading="mu^2 t")
    measured = {"order": order, "smallest_error": expansion["error"].values[-1, 1]}
    fails = f"read so, the error falls only as mu^{order:.1f}, not as mu^3"
    return judge(measured, Near(ORDER, NEAR, "order", says="order in mu"), fails=fails)


@claim(
    "drive_sign",
    "Section 2, (2) and (4)",
    "The drive D = 2 gamma mu^2 cos 2 omega t gives gamma (conj B - conj A).",
    checks("expansion"),
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


@claim(
    "dispersion",
    "Section 3, (15)",
    "The characteristic equation factorises into the dispersion relation.",
    checks("dispersion"),
)
def dispersion(check) -> Finding:
    return within_tolerance(check, "error", "factorisation")


@claim(
    "stable_below",
    "Lemma 1",
    "Zero is linearly stable for |gamma| < gamma_0.",
    checks("chart"),
)
def stable_below(chart) -> Finding:
    below = np.abs(chart["gamma"]) < chart["infinite_threshold"]
    measured = {
        "fastest": chart["measured"].where(below).max(),
        "cells": below.sum(),
        "misclassified": number(chart, "misclassified"),
    }
    return judge(measured, AtMost(RESOLVED, "fastest", says="fastest growth"))


@claim(
    "unstable_above",
    "Lemma 1",
    "Zero is linearly unstable for |gamma| > gamma_0.",
    checks("chart"),
)
def unstable_above(chart) -> Finding:
    above = (chart["gamma"] > chart["infinite_threshold"]) & (chart["gamma"] > 0)
    finite = chart["gamma"] > chart["finite_threshold"]
    slow = above & finite & (chart["measured"] < 0.5 * chart["finite_rate"])
    resolved = slow & (chart["finite_rate"] > 2.0 * RESOLVED)
    spared = int((above & ~finite).sum())
    measured = {"cells": above.sum(), "contradictions": resolved.sum(), "finite_stable": spared}
    caveat = f"{spared} such cells are stable on the finite chain" if spared else ""
    return judge(measured, AtMost(0, "contradictions"), caveat)


@claim(
    "unstable_band",
    "Lemma 1",
    "Zero is linearly unstable for Omega in [0, 4 epsilon] and any gamma but 0.",
    checks("chart", "windows", "measured_windows"),
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


@claim(
    "threshold_growth",
    "Proof of Lemma 1",
    "At |gamma| = gamma_0 perturbations grow polynomially.",
    checks("threshold"),
)
def threshold_growth(threshold) -> Finding:
    measured = {
        "wave_error": threshold["error"].max(),
        "l2_exponent": threshold["l2_exponent"].mean(),
        "linf_exponent": threshold["linf_exponent"].mean(),
        "finite_gap": threshold["finite_gap"].min(),
    }
    caveat = ""
    if measured["l2_exponent"] < LINEAR:
        caveat = (
            "a single wave grows as tau, data in l2 only as tau^(1/2), and not in l-infinity;"
            " the Dirichlet chain is stable there"
        )
    says = "error of the wave that grows as 4 gamma tau"
    criterion = AtMost(threshold["error"].attrs["tolerance"], "wave_error", says=says)
    return judge(measured, criterion, caveat)


@claim(
    "growth_bound",
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


@claim(
    "balance",
    "Proof of Lemma 2",
    "The l2 norm obeys the balance equation.",
    checks("balance"),
)
def balance(check) -> Finding:
    return within_tolerance(check, "pointwise", "integrated")
