"""The numbers that the article prints, by name, each with the source that its card describes."""

import json
import re
from collections import Counter
from typing import Any

import numpy as np
import xarray as xr
from latticode.measures.confidence import CONFIDENCE
from replication.article.cards import COUNTS
from replication.article.numbers import MARK, Numbers
from replication.article.quoted import FOLDER, LongStudies, LongStudy
from replication.article.sources import Printed, Source, printed
from replication.ledger.claim import Kind, Origin
from replication.ledger.criterion import Verdict
from replication.ledger.rows import tally
from replication.results import Results
from replication.words import enclosing_span, number, percent

from pendula.configuration.schema import PAPER_CASES
from pendula.studies.paper.solvers import ORDER

UNBOUNDED, PROOFS = f"{FOLDER}/unbounded", f"{FOLDER}/proofs"
SPEED, TIMES = f"{FOLDER}/speed/work_precision", f"{FOLDER}/reproduction.json"
LONG_STUDIES: LongStudies = {
    UNBOUNDED: LongStudy("snakemake unbounded"),
    f"{FOLDER}/chaos": LongStudy(
        "snakemake transition", "pendula.studies.chaos.lifetimes.vary_lifetimes"
    ),
    f"{FOLDER}/breathers": LongStudy(
        "snakemake fates sensitivity", "pendula.studies.breathers.other_choices.vary_areas"
    ),
    f"{FOLDER}/pendula": LongStudy(
        "snakemake over_the_top", "pendula.studies.newton.over_the_top.vary_over_the_top"
    ),
    PROOFS: LongStudy("snakemake certified", "pendula.studies.certified.contents.certify_curve"),
    SPEED: LongStudy("snakemake speed"),
    TIMES: LongStudy("snakemake reproduction", "benchmarks.reproduction.measure_reproduction"),
}
"""The long studies, by the file or folder of the copies that the article quotes."""

FRONTS = "unbounded/fronts"
UPWARD = 1.05
"""Relative increase of a bound before it is rounded to two digits, so that it stays a bound."""


def gather(results: Results) -> dict[str, Any]:
    """Return the template's names: functions of `Numbers`, and numbers derived from several."""
    numbers = Numbers(results)
    compared, study = results["checks/solvers"], results[UNBOUNDED]
    diverging = int(np.isfinite(compared["second_divergence"][:, 0]).sum())
    speed = results[SPEED]
    cpp_programs = [peer for peer in speed["peer"].values if "cpp" in peer]
    return {
        **numbers.functions(),
        "counts": counts(numbers.rows),
        "quoted": f"{FOLDER}/",
        "confidence": percent(CONFIDENCE),
        "percent": percent,
        "cases": printed(str(compared.sizes["case"]), "checks/solvers", "second_divergence"),
        "diverging": printed(str(diverging), "checks/solvers", "second_divergence"),
        "allowed": Printed(number(ORDER.number), Source(claim="energy_small")),
        "errors": {name: regular_error(results, name) for name in ("ode45", "taylor")},
        "cells": printed(str(results["checks/chart"]["measured"].size), "checks/chart", "measured"),
        "mark": MARK,
        "omegas": printed(str(study.sizes["omega"]), UNBOUNDED, "exponent"),
        "levels": [
            printed(number(level, 2), UNBOUNDED, "level_speed") for level in study["level"].values
        ],
        "noises": [
            printed(number(size, 2), UNBOUNDED, "distance") for size in study["noise"].values[:-1]
        ],
        "left_out": Printed(str(study.attrs["edge"]), Source(UNBOUNDED, attribute="edge")),
        "largest_bound": largest_bound(results),
        "radius": printed(
            upward(results["certified/breathers"]["radius"].max()), "certified/breathers", "radius"
        ),
        "peer": lambda name: times_as_long(speed, name),
        "by_hand": times_as_long(speed, *cpp_programs),
        "fastest_in": wins_of_taylor(speed),
        "spread_from": printed(number(spread_from(study)), UNBOUNDED, "level_speed"),
        "grown": grown(numbers),
        "least_between": printed(percent(least_between(results[FRONTS])), FRONTS, "power_between"),
        "full_run": {name: printed(time, TIMES) for name, time in full_run(results).items()},
    }


def times_as_long(speed: xr.Dataset, *peers: str) -> Printed:
    """Return the time of the fastest of `peers` divided by our solver's, as a range over cases."""
    ratios = speed["ratio"].sel(peer=list(peers)).min("peer")
    text = f"{enclosing_span(float(ratios.min()), float(ratios.max()), 2)}{MARK}"
    return printed(text, SPEED, "ratio", {"peer": list(peers)})


def wins_of_taylor(speed: xr.Dataset) -> Printed:
    """Return the number of cases in which the Taylor method is fastest at equal error."""
    best = speed["best_seconds"].dropna("solver", how="all").dropna("case", how="all")
    wins = int((best.idxmin("solver") == "taylor").sum())
    text = f"{'all' if wins == best.sizes['case'] else f'{wins} of'} {best.sizes['case']} cases"
    return printed(text, SPEED, "best_seconds")


def spread_from(study: xr.Dataset) -> float:
    """Return the time from which the speed of spreading of A + B is measured."""
    left_out = re.search(r"left_out_part = ([\d.]+)", study["level_speed"].attrs["choices"])[1]
    return float(left_out) * float(study.attrs["end_time"])


def least_between(fronts: xr.Dataset) -> float:
    """Return the smallest ratio of P between the fronts to P of the thermal state with A = -B."""
    return float((fronts["power_between"] / fronts["thermal_antisymmetric_power"]).min())


def grown(numbers: Numbers) -> Printed:
    """Return the number of runs from other initial conditions whose norm grows."""
    share, runs = (numbers.measured("unbounded_starts", key) for key in ("share", "runs"))
    return Printed(f"{share * runs:.0f}", Source(claim="unbounded_starts"))


def counts(rows: list[dict]) -> dict[str, Printed]:
    """Return the numbers of the paper's claims, by kind and by verdict, and of controls."""
    of_paper = Counter(tally(rows).get(Origin.PAPER, {}))
    kinds = Counter(row["kind"] for row in rows if row["origin"] == Origin.PAPER)
    controls = [control["passes"] for row in rows for control in row["controls"]]
    of_all = "" if all(controls) else f"{controls.count(True)} of the"
    numbers = {
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
    return {name: Printed(str(count), COUNTS) for name, count in numbers.items()}


def regular_error(results: Results, solver: str) -> Printed:
    """Return the largest error of a solver's norms in the cases that are not chaotic."""
    is_regular = results["checks/lyapunov"]["chaotic"] == 0
    errors = results["checks/trust"]["difference"].sel(solver=solver).where(is_regular)
    text = number(float(errors.max()), 2)
    return printed(text, "checks/trust", "difference", {"solver": solver})


def largest_bound(results: Results) -> Printed:
    """Return the largest proven distance of a computed curve from the true one, rounded upward."""
    bounds = {case: float(results[f"{PROOFS}/{case}"]["bound"].max()) for case in PAPER_CASES}
    worst = max(bounds, key=bounds.get)
    return printed(upward(bounds[worst]), f"{PROOFS}/{worst}", "bound")


def upward(bound: float) -> str:
    """Return a bound rounded up to two digits."""
    return number(UPWARD * float(bound), 2)


def full_run(results: Results) -> dict[str, str]:
    """Return the wall times of full runs in s, as measured once, and the number of cores."""
    measured = json.loads(results.path(TIMES).read_text(encoding="utf-8"))
    times = {name: f"{run['wall']:.0f}" for name, run in measured["runs"].items()}
    return times | {"cores": str(measured["machine"]["cores"])}
