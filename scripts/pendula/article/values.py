"""The numbers that the article quotes, by name, each read from a dataset and linked to it."""

import json
import re
from collections import Counter
from typing import Any

import numpy as np
import xarray as xr
from latticode.measures.confidence import CONFIDENCE
from replication.article.numbers import KEPT, MARK, QUOTED, Numbers
from replication.ledger.claim import Kind, Origin
from replication.ledger.criterion import Verdict
from replication.ledger.rows import (
    Ledger,
    load,
    tally,
)
from replication.report.results import Results
from replication.report.words import (
    Quote,
    enclosing_span,
    number,
    percent,
)

from pendula.configuration.schema import PAPER_CASES
from pendula.studies.paper.solvers import ORDER

LONG, FRONTS = f"{QUOTED}unbounded", "unbounded/fronts"
UPWARD = 1.05
"""By so much a bound grows before two of its digits are printed: they are then no smaller."""


def gather(results: Results) -> dict[str, Any]:
    """Return all that the template names: functions of `Numbers`, and numbers made of several."""
    numbers = Numbers(results)
    compared, study = results["checks/solvers"], results[LONG]
    speed = results[f"{KEPT}/speed/work_precision"]
    return {
        **numbers.functions(),
        "counts": counts(load(results)),
        "kept": QUOTED,
        "confidence": percent(CONFIDENCE),
        "percent": percent,
        "cases": results.quote("checks/solvers", compared.sizes["case"]),
        "apart": results.quote(
            "checks/solvers", int(np.isfinite(compared["second_divergence"][:, 0]).sum())
        ),
        "allowed": number(ORDER.number),
        "errors": {name: regular_error(results, name) for name in ("ode45", "taylor")},
        "cells": results["checks/chart"]["measured"].size,
        "mark": MARK,
        "omegas": results.quote(LONG, study.sizes["omega"]),
        "levels": [results.quote(LONG, level, 2) for level in study["level"].values],
        "noises": [results.quote(LONG, float(size), 2) for size in study["noise"].values[:-1]],
        "left_out": results.say(LONG, str(study.attrs["edge"])),
        "largest_bound": largest_bound(results),
        "radius": upward(results["certified/breathers"]["radius"].max()),
        "peer": lambda name: times_as_long(speed, name),
        "by_hand": times_as_long(speed, *(peer for peer in speed["peer"].values if "cpp" in peer)),
        "fastest_in": wins_of_taylor(speed),
        "spread_from": results.quote(LONG, spread_from(study)),
        "grown": grown(numbers.ledger),
        "least_between": results.say(FRONTS, percent(least_between(results[FRONTS]))),
        "full_run": full_run(results),
    }


def times_as_long(speed: xr.Dataset, *peers: str) -> str:
    """Return the range over the cases of the fastest of such peers' times over our solver's."""
    ratios = speed["ratio"].sel(peer=list(peers)).min("peer")
    return f"{enclosing_span(float(ratios.min()), float(ratios.max()), 2)}{MARK}"


def wins_of_taylor(speed: xr.Dataset) -> str:
    """Return in how many cases the Taylor method takes the least time at equal error."""
    best = speed["best_seconds"].dropna("solver", how="all").dropna("case", how="all")
    wins = int((best.idxmin("solver") == "taylor").sum())
    return f"{'all' if wins == best.sizes['case'] else f'{wins} of'} {best.sizes['case']} cases"


def spread_from(study: xr.Dataset) -> float:
    """Return the time from which the speeds at which A + B spreads are measured."""
    left_out = re.search(r"left_out_part = ([\d.]+)", study["level_speed"].attrs["choices"])[1]
    return float(left_out) * float(study.attrs["end_time"])


def least_between(fronts: xr.Dataset) -> float:
    """Return the least power between the fronts over that of the thermal state with A = -B."""
    return float((fronts["power_between"] / fronts["thermal_antisymmetric_power"]).min())


def grown(ledger: Ledger) -> Quote:
    """Return of how many runs from other initial conditions the norm grows."""
    share, runs = (ledger.value("unbounded_starts", key) for key in ("share", "runs"))
    return ledger.quote("unbounded_starts", "share")._replace(text=f"{share * runs:.0f}")


def counts(rows: list[dict]) -> dict[str, str]:
    """Return how many claims of the paper are of each kind and have each verdict, and controls."""
    of_paper = Counter(tally(rows).get(Origin.PAPER, {}))
    kinds = Counter(row["kind"] for row in rows if row["origin"] == Origin.PAPER)
    controls = [one["passes"] for row in rows for one in row["controls"]]
    of_all = "" if all(controls) else f"{controls.count(True)} of the"
    found = {
        **{str(kind): kinds[kind] for kind in Kind},
        "papers": of_paper.total(),
        "confirmed": of_paper[Verdict.CONFIRMED],
        "held": of_paper[Verdict.CONFIRMED] + of_paper[Verdict.CAVEAT],
        "caveat": of_paper[Verdict.CAVEAT],
        "missed": of_paper[Verdict.NOT_REPRODUCED],
        "unfounded": of_paper[Verdict.NOT_FOLLOWING],
        "open": of_paper[Verdict.UNDECIDED],
        "resting": sum(bool(row["rests_on"]) for row in rows),
        "as_required": f"{of_all or 'All'} {len(controls)}",
    }
    return {name: str(count) for name, count in found.items()}


def regular_error(results: Results, solver: str) -> Quote:
    """Return the largest error of a solver's norms in the cases that are not chaotic."""
    regular = results["checks/lyapunov"]["chaotic"] == 0
    errors = results["checks/trust"]["difference"].sel(solver=solver).where(regular)
    return results.quote("checks/trust", float(errors.max()), 2)


def largest_bound(results: Results) -> str:
    """Return the largest proven distance of a computed curve from the true one, rounded upward."""
    proofs = (results[f"{KEPT}/proofs/{case}"] for case in PAPER_CASES)
    return upward(max(one["bound"].max() for one in proofs))


def upward(bound: float) -> str:
    """Return two digits of a bound that are no smaller than it."""
    return number(UPWARD * float(bound), 2)


def full_run(results: Results) -> dict[str, str]:
    """Return the wall times of whole runs in seconds, as measured once, and on how many cores."""
    kept = json.loads(results.path(f"{QUOTED}reproduction.json").read_text(encoding="utf-8"))
    times = {name: f"{one['wall']:.0f}" for name, one in kept["runs"].items()}
    return times | {"cores": str(kept["machine"]["cores"])}
