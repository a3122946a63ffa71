"""Deciding functions for Sections 3 and 4: the lemmas and theorems."""

import numpy as np

from .readings import growth_margin
from .verdicts import Finding, judge, number, within_tolerance

# ASSUME: what the charts resolve: bounded beats change a slope by 6 / tau at most, here tau = 40;
# an unstable cell must grow at half of its predicted rate once that is twice the resolution.
RESOLVED = 0.15
# ASSUME: a bound is "sharp" if it is reached to 90 %; where it is attained, to 99.9 %.
SHARP, ATTAINED = 0.9, 0.999
# ASSUME: data in l2 grow linearly if the power of tau is above 0.9.
LINEAR = 0.9


def dispersion(check) -> Finding:
    """(15): the dispersion relation and its factorised form."""
    return within_tolerance(check, "error", "factorisation")


def stable_below(chart) -> Finding:
    """Lemma 1: linearly stable for |gamma| < gamma_0."""
    below = np.abs(chart["gamma"]) < chart["infinite_threshold"]
    measured = {
        "fastest": chart["measured"].where(below).max(),
        "cells": below.sum(),
        "misclassified": number(chart, "misclassified"),
    }
    return judge(measured, "fastest growth <= 0.15", measured["fastest"] <= RESOLVED)


def unstable_above(chart) -> Finding:
    """Lemma 1: linearly unstable for |gamma| > gamma_0."""
    above = (chart["gamma"] > chart["infinite_threshold"]) & (chart["gamma"] > 0)
    finite = chart["gamma"] > chart["finite_threshold"]
    slow = above & finite & (chart["measured"] < 0.5 * chart["finite_rate"])
    resolved = slow & (chart["finite_rate"] > 2.0 * RESOLVED)
    spared = int((above & ~finite).sum())
    measured = {"cells": above.sum(), "contradictions": resolved.sum(), "finite_stable": spared}
    caveat = f"{spared} such cells are stable on the finite chain" if spared else ""
    return judge(measured, "no contradictions", measured["contradictions"] == 0, caveat)


def unstable_band(chart, windows, measured_windows) -> Finding:
    """Lemma 1: unstable for Omega in [0, 4 epsilon] and any gamma not zero."""
    inside = chart["omega"].where((chart["omega"] >= 0) & (chart["infinite_threshold"] == 0))
    rates = chart["infinite_rate"].where(np.isfinite(inside) & (chart["gamma"] > 0))
    largest = windows["largest_gamma"]
    measured = {
        "slowest_infinite_rate": rates.min(),
        "largest_gamma_with_a_window": largest.values[-1],
        "misclassified": number(measured_windows, "misclassified"),
    }
    holds = measured["slowest_infinite_rate"] > 0 and measured["misclassified"] == 0
    caveat = ""
    if float(windows["count"].max()) > 0:
        caveat = "on the infinite chain; a finite one keeps windows of stability for small gamma"
    return judge(measured, "all rates > 0", holds, caveat)


def threshold_growth(threshold) -> Finding:
    """Lemma 1: polynomial growth at |gamma| = gamma_0."""
    measured = {
        "wave_error": threshold["error"].max(),
        "l2_exponent": threshold["l2_exponent"].mean(),
        "linf_exponent": threshold["linf_exponent"].mean(),
        "finite_gap": threshold["finite_gap"].min(),
    }
    linear = measured["wave_error"] <= threshold["error"].attrs["tolerance"]
    caveat = ""
    if measured["l2_exponent"] < LINEAR:
        caveat = (
            "a single wave grows as tau, data in l2 only as tau^(1/2), and not in l-infinity;"
            " the Dirichlet chain is stable there"
        )
    return judge(measured, "growth of the wave = 4 gamma tau", linear, caveat)


def growth_bound(check, *trajectories) -> Finding:
    """(19): P(tau) <= P(0) e^{4 |gamma| tau}, here along all trajectories and both ways."""
    steepest = [
        growth_margin(ds["tau"].values, ds["l2"].values, ds.attrs["gamma"])["steepest"]
        for ds in trajectories
    ]
    measured = {"steepest": max(steepest), "random_data": check["steepest"].max()}
    measured["sharp_case"] = number(check, "sharpest")
    holds = max(measured["steepest"], measured["random_data"]) <= 1.0 + 1e-6
    return judge(measured, "slope of log P over 4 gamma <= 1", holds)


def balance(check) -> Finding:
    """The balance equation in the proof of Lemma 2."""
    return within_tolerance(check, "pointwise", "integrated")


def theorem(samples, worst, families: list[str], caveat: str = "") -> Finding:
    """Return the finding of a theorem: no random or optimised data break its bound."""
    sampled = samples["worst"].sel(family=families)
    searched = worst["worst"].sel(question=families)
    measured = {"worst_sample": sampled.max(), "worst_searched": searched.max()}
    holds = max(float(value) for value in measured.values()) <= 1.0 + 1e-7
    return judge(measured, "largest P over its bound <= 1", holds, caveat)


def theorem_1(samples, worst) -> Finding:
    """Theorem 1 with C = H / (Omega - 2 gamma - 4 epsilon)."""
    return theorem(samples, worst, ["theorem_1"])


def theorem_2(samples, worst) -> Finding:
    """Theorem 2 with delta_0 = a^2 / c and C_0 = 2 c / a."""
    return theorem(samples, worst, ["theorem_2_ball", "theorem_2_energy", "theorem_2_widened"])


def theorem_3(samples, worst) -> Finding:
    """Theorem 3 with C_N from the corrected constant."""
    return theorem(samples, worst, ["theorem_3"])


def theorem_3_proof(constant) -> Finding:
    """The lower bound of H in the proof of Theorem 3, with |Omega| + gamma + 4 epsilon."""
    measured = {"printed": constant["printed"].min(), "corrected": constant["corrected"].min()}
    measured["smallest_chain"] = smallest = number(constant, "smallest")
    fails = f"A = -B = x (-1)^n breaks it from {smallest:.0f} sites on; it needs 2 gamma"
    return judge(measured, "H - bound >= 0", measured["printed"] >= -1e-12, fails=fails)


def positive_depth(depth) -> Finding:
    """The proof of Theorem 2: -H > 0."""
    first = number(depth, "first_negative")
    measured = {"first_negative": first, "assured": number(depth, "assured")}
    caveat = f"only for small data: the pair (x, 0) has -H <= 0 from x = {first:.3g}"
    return judge(
        measured, "-H > 0 for P < 4 a", measured["assured"] < 0, caveat if first < np.inf else ""
    )


def inequalities(check) -> Finding:
    """(17), (18), (21), (22), (25), (27)."""
    return within_tolerance(check, "ratio", "excess")


def sharp_bounds(worst) -> Finding:
    """Section 6: the bounds on l2 are sharp."""
    measured = {str(q): worst["worst"].sel(question=q) for q in worst["question"].values}
    measured["attained_theorem_3"] = number(worst, "attained")
    ball = float(measured["theorem_2_ball"])
    reached = [measured[q] / worst["small_data"].sel(question=q) for q in measured if q[-1] != "3"]
    caveat = f"the constant C_0 of Theorem 2 is reached to {ball:.2f} only" if ball < SHARP else ""
    holds = min(float(r) for r in reached) > SHARP and measured["attained_theorem_3"] > ATTAINED
    return judge(measured, "within 10 % of the value for tiny data", holds, caveat)
