"""Facts on the claims of the paper, on the solvers and on how they were checked."""

from collections import Counter

import numpy as np
import xarray as xr
from pendula.configuration.messages import load
from pendula.ledger.claim import Origin
from pendula.ledger.criterion import REFUTED, Verdict
from pendula.ledger.tables import tally
from pendula.report.words import case_of, number, percent, symbols

from .baseline import Baseline
from .words import time_of_output


def configured(configuration: dict, chaos_study: dict) -> dict:
    """Return parameters of solvers and of ensembles in the configuration."""
    given, drawn = load(configuration).solvers, chaos_study["chaos"]["ensembles"]
    return {
        "own_rtol": number(given.taylor.rtol),
        "members": number(drawn["members"]),
        "swept_members": number(drawn["sweeps"]["fig6_right"]["members"]),
        "size": number(drawn["size"]),
        "settled": number(chaos_study["chaos"]["lifetimes"]["settled"]),
    }


def ledger(baseline: Baseline) -> dict:
    """Return how many claims there are of each origin and verdict, and those that do not hold."""
    rows = baseline.claims()
    counts = {origin: Counter(tally(rows).get(origin, {})) for origin in Origin}
    told = [
        {
            "place": row["place"],
            "says": symbols(row["says"]).replace("|", r"\|"),
            "verdict": row["verdict"],
            "because": symbols(row["because"]).replace("|", r"\|"),
        }
        for row in rows
        if row["verdict"] in (*REFUTED, Verdict.UNDECIDED)
    ]
    of_paper = counts[Origin.PAPER]
    return {
        "claims": str(len(rows)),
        "papers": str(of_paper.total()),
        "confirmed": str(of_paper[Verdict.CONFIRMED]),
        "caveat": str(of_paper[Verdict.CAVEAT]),
        "missed": str(of_paper[Verdict.NOT_REPRODUCED]),
        "open": str(of_paper[Verdict.UNDECIDED]),
        "questions": str(counts[Origin.OPEN].total()),
        "own": str(counts[Origin.OWN].total()),
        "on_questions": _in_words(counts[Origin.OPEN]),
        "on_own": _in_words(counts[Origin.OWN]),
        "told": told,
        "ensemble": str(sum(row["name"].startswith("ensemble") for row in rows)),
        "resting": str(sum(bool(row["rests_on"]) for row in rows)),
        "controls": str(sum(len(row["controls"]) for row in rows)),
        "failing": str(sum(not one["passes"] for row in rows for one in row["controls"])),
    }


def _in_words(counts: Counter) -> str:
    """Return how many claims have each verdict, such as "5 do not carry over"."""
    verbs = {Verdict.NOT_CARRIED: "do not carry over", Verdict.UNDECIDED: "cannot be decided"}
    return ", ".join(f"{n} {verbs.get(one, f'are {one}')}" for one, n in counts.items())


def solvers(baseline: Baseline) -> dict:
    """Return how far the energy drifts by ode45, and when solvers leave each other or the truth."""
    found, trust = baseline["checks/solvers"], baseline["checks/trust"]
    cases = [found.sel(case=case) for case in found["case"].values]
    paper, high = "ode45 - crank_nicolson", "ode45 - dop853"
    conserving = "ode45 - delfour_fortin_payre"
    times = trust["horizon"].sel(level="visible")
    left = trust["case"].values[np.isfinite(times).any("solver").values]
    shared = np.intersect1d(trust["solver"], found["solver"])
    keeping = found["kept"].sel(span="whole", solver=shared) == 1
    return {
        "cases": str(len(cases)),
        "visible": percent(found["visible"]),
        "early": number(found["until"].sel(span="early").max()),
        "whole": number(found["until"].sel(span="whole").max()),
        "allowed": number(found["allowed_drift"][0] / found["stated_drift"][0]),
        "kept": str(int(found["kept"].sel(solver="ode45", span="whole").sum())),
        "keeping": str(int(keeping.sum())),
        "keeping_off": str(int((keeping & np.isfinite(times.sel(solver=shared))).sum())),
        "kept_early": str(int(found["kept"].sel(solver="ode45", span="early").sum())),
        "drift": [_drift(case) for case in cases],
        "diverged": str(int(np.isfinite(found["divergence_time"].sel(pair=paper)).sum())),
        "divergence": [
            {
                "case": case_of(case),
                "paper": time_of_output(case["divergence_time"].sel(pair=paper)),
                "conserving": time_of_output(case["divergence_time"].sel(pair=conserving)),
                "ode45": time_of_output(case["divergence_time"].sel(pair=high)),
            }
            for case in cases
        ],
        "horizons": [
            {
                "case": case_of(trust.sel(case=case)),
                **{
                    str(s): time_of_output(times.sel(case=case, solver=s))
                    for s in trust["solver"].values
                },
            }
            for case in left
        ],
    }


def second_solver(baseline: Baseline) -> dict:
    """Return what the scheme and the step of the second solver decide, in the regular cases."""
    found, chaotic = baseline["checks/second_solver"], baseline["checks/lyapunov"]["chaotic"]
    step = float(found["step"][1])  # the steps are twice the configured one, itself, and half
    regular = found.sel(case=chaotic["case"].values[chaotic.values == 0])
    largest = regular["scheme_difference"].max("case")
    drifts = found["scheme_drift"].sel(step=step)
    (swept,) = (one for one in baseline.claims() if one["name"] == "second_solver_sweeps")
    return {
        "step": number(step),
        "least_drift": number(drifts.sel(scheme="crank_nicolson").min(), 2),
        "most_drift": number(drifts.sel(scheme="crank_nicolson").max(), 2),
        "conserving_drift": number(drifts.sel(scheme="delfour_fortin_payre").max(), 2),
        "regular": percent(largest.sel(scheme="crank_nicolson", step=step)),
        "halved": percent(largest.sel(scheme="crank_nicolson")[2]),
        "midpoint": percent(largest.sel(scheme="implicit_midpoint", step=step)),
        "conserving": percent(largest.sel(scheme="delfour_fortin_payre", step=step)),
        "off": percent(swept["measured"]["off_fig6_right"]),
    }


def _drift(case: xr.Dataset) -> dict[str, str]:
    drift = case["largest_drift"].sel(solver="ode45")
    return {
        "case": case_of(case),
        "stated": number(case["stated_drift"]),
        "early": number(drift.sel(span="early"), 2),
        "whole": number(drift.sel(span="whole"), 2),
    }


def references(baseline: Baseline) -> dict:
    """Return how well the references are known, and when the double next to a tenth shows."""
    trust = baseline["checks/trust"]
    known = [
        float(baseline[f"reference/{case}"].attrs["largest_discrepancy"])
        for case in trust["case"].values
    ]
    return {
        "discrepancy": number(max(known), 2),
        "decimals": number(trust["decimal_size"][0]),
        "first": time_of_output(trust["decimal_horizon"][0]),
        "visible": percent(trust["decimal_size"][1]),
        "seen": time_of_output(trust["decimal_horizon"][1]),
    }


def hard_cases(baseline: Baseline) -> dict:
    """Return how many hard cases there are, and the energy over a long time on a short chain."""
    cases = baseline["quoted/hard_cases"]
    long = cases.where(cases["reference"] == "the energy at the start", drop=True)
    return {
        "runs": str(cases.sizes["row"]),
        "refused": str(int((cases["refusal"] != "").sum())),
        "unexpected": str(int((cases["sound"] == 0).sum()) or "none"),
        "energy": [
            {"solver": solver, "drift": number(drift, 2)}
            for solver, drift in zip(long["solver"].values, long["error"].values, strict=True)
        ],
    }


def mutation(baseline: Baseline) -> dict:
    """Return which part of the mutants of decisive modules the tests noticed, and when."""
    kept = baseline.mutation()
    return {
        "date": kept["date"],
        "modules": str(kept["modules"]),
        "mutants": f"{kept['mutants']:,}",
        "sample": str(kept["sample"]),
        "score": percent(kept["score"], 3),
        "low": percent(kept["low"], 3),
        "high": percent(kept["high"], 3),
        "confidence": percent(kept["confidence"]),
    }
