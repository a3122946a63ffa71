"""Section 3 and Lemma 2: linear stability of the chain at rest, and the growth of l2."""

import numpy as np

from pendula.ledger.readings import growth_margin
from pendula.ledger.row import LARGE, SMALL, checks, claim
from pendula.ledger.verdicts import Finding, judge, number, within_tolerance

# ASSUME: what the charts resolve: bounded beats change a slope by 6 / tau at most, here tau = 40;
# an unstable cell must grow at half of its predicted rate once that is twice the resolution.
RESOLVED = 0.15
# ASSUME: data in l2 grow linearly if the power of tau is above 0.9.
LINEAR = 0.9


@claim(
    "dispersion",
    "Section 3, (15)",
    "The characteristic equation factorises into the dispersion relation.",
    checks("dispersion"),
)
def dispersion(check) -> Finding:
    """(15): the dispersion relation and its factorised form."""
    return within_tolerance(check, "error", "factorisation")


@claim(
    "stable_below",
    "Lemma 1",
    "Zero is linearly stable for |gamma| < gamma_0.",
    checks("chart"),
)
def stable_below(chart) -> Finding:
    """Lemma 1: linearly stable for |gamma| < gamma_0."""
    below = np.abs(chart["gamma"]) < chart["infinite_threshold"]
    measured = {
        "fastest": chart["measured"].where(below).max(),
        "cells": below.sum(),
        "misclassified": number(chart, "misclassified"),
    }
    return judge(measured, "fastest growth <= 0.15", measured["fastest"] <= RESOLVED)


@claim(
    "unstable_above",
    "Lemma 1",
    "Zero is linearly unstable for |gamma| > gamma_0.",
    checks("chart"),
)
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


@claim(
    "unstable_band",
    "Lemma 1",
    "Zero is linearly unstable for Omega in [0, 4 epsilon] and any gamma but 0.",
    checks("chart", "windows", "measured_windows"),
)
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


@claim(
    "threshold_growth",
    "Proof of Lemma 1",
    "At |gamma| = gamma_0 perturbations grow polynomially.",
    checks("threshold"),
)
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


@claim(
    "growth_bound",
    "Lemma 2, (19)",
    "The squared l2 norm grows at most as exp(4 |gamma tau|).",
    (*checks("growth"), *SMALL, *LARGE),
)
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


@claim(
    "balance",
    "Proof of Lemma 2",
    "The l2 norm obeys the balance equation.",
    checks("balance"),
)
def balance(check) -> Finding:
    """The balance equation in the proof of Lemma 2."""
    return within_tolerance(check, "pointwise", "integrated")
