"""The numbers that the article quotes, by name, each read from a dataset and linked to it."""

import json
import re
from collections import Counter
from collections.abc import Callable
from typing import Any

import numpy as np
import xarray as xr
from latticode.measures.confidence import CONFIDENCE
from replication.ledger.claim import Kind, Origin
from replication.ledger.criterion import Verdict
from replication.ledger.rows import (
    Ledger,
    counted_verdicts,
    load,
    on_figure,
    tally,
    whether_it_holds,
)
from replication.report.results import Results
from replication.report.words import (
    DOWN,
    FIRM,
    UP,
    Quote,
    enclosing_span,
    number,
    outward,
    percent,
    with_error,
)

from pendula.configuration.schema import PAPER_CASES
from pendula.studies.paper.solvers import ORDER
from pendula.varied import VARIATION

KEPT = "../tests/baseline"
"""Where committed datasets lie, seen from the article."""
QUOTED = f"{KEPT}/quoted/"
LONG, FRONTS = f"{QUOTED}unbounded", "unbounded/fronts"
MARK = "†"
"""It follows each result of a long study, which a full run does not make again."""
PER_CENT_DIGITS = 2
"""So many digits has a fraction in per cent."""
UPWARD = 1.05
"""By so much a bound grows before two of its digits are printed: they are then no smaller."""


class Numbers:
    """Numbers of a run: `of` datasets, or measured for claims (`n`), also in per cent."""

    def __init__(self, results: Results):
        self.results, self.ledger = results, Ledger(results)

    def labels(self, name: str, coordinate: str) -> list:
        """Return the labels of a coordinate."""
        return list(self.results[name][coordinate].values)

    def of(self, name: str, variable: str, digits: int = 3, **labels) -> Quote:
        """Return a number with what the dataset has of its error; a time may never come."""
        data = self.results[name].sel(labels)
        if f"{variable}_error" in data and f"{variable}_low" not in data:
            value, error = (float(data[f"{variable}{part}"]) for part in ("", "_error"))
            return self.long(name, with_error(value, error, digits))
        return self._say(name, data, variable, digits, lambda value: number(value, digits))

    def span(self, name: str, variable: str, digits: int = 3) -> Quote:
        """Return the range of a number over all its labels, which contains their errors."""
        return self.long(name, enclosing_span(*self._limits(name, variable, {}), digits))

    def percent_of(self, name: str, variable: str, **labels) -> Quote:
        """Return a number with its error in per cent."""
        data = self.results[name].sel(labels)
        value, error = (100.0 * float(data[f"{variable}{part}"]) for part in ("", "_error"))
        return self.long(name, f"({with_error(value, error)}){FIRM}%")

    def share(self, name: str, variable: str, **labels) -> Quote:
        """Return a fraction in per cent."""
        return self._say(name, self.results[name].sel(labels), variable, PER_CENT_DIGITS, percent)

    def range_of(
        self, name: str, variable: str, digits: int = 2, definition: str = "", **labels
    ) -> Quote:
        """Return the range of several numbers with their limits, such as 6.7 to 7.9.

        Variations of `definition` are left out: they measure another thing, printed by itself.
        """
        limits = self._limits(name, variable, labels, definition)
        return self.long(name, enclosing_span(*limits, digits))

    def share_span(self, name: str, variable: str, **labels) -> Quote:
        """Return the range of several fractions with their limits in per cent."""
        low, high = self._limits(name, variable, labels)
        ends = outward(low, PER_CENT_DIGITS, DOWN), outward(high, PER_CENT_DIGITS, UP)
        return self.long(name, " to ".join(map(percent, ends)))

    def _limits(
        self, name: str, variable: str, labels: dict, definition: str = ""
    ) -> tuple[float, float]:
        """Return the least lower and the largest upper limit of all numbers of a variable."""
        data = self.results[name].sel(labels)
        value = data[variable]
        if definition:
            error = data[f"{variable}_statistical_error"]
            again = data[f"{variable}_varied"]
            varies = [not str(label).startswith(definition) for label in data[VARIATION].values]
            again = again.isel({VARIATION: varies})
            values = [value - error, value + error, again]
        elif f"{variable}_low" in data:
            values = [data[f"{variable}_low"], data[f"{variable}_high"]]
        elif f"{variable}_error" in data:
            values = [value - data[f"{variable}_error"], value + data[f"{variable}_error"]]
        else:
            values = [value]
        return min(float(part.min()) for part in values), max(float(part.max()) for part in values)

    def _say(
        self, name: str, data: xr.Dataset, variable: str, digits: int, write: Callable[[float], str]
    ) -> Quote:
        """Return a number with its confidence interval, if this has a width, rounded outward."""
        value = float(data[variable] if variable in data.variables else data.attrs[variable])
        middle = write(outward(value, digits, DOWN) if variable.endswith("_low") else value)
        ends = [
            write(outward(float(data[f"{variable}{end}"]), digits, direction))
            for end, direction in (("_low", DOWN), ("_high", UP))
            if f"{variable}{end}" in data
        ]
        interval = f" ({' to '.join(ends)})" if set(ends) - {middle} else ""
        say = self.long if variable in data.data_vars else self.results.say
        return say(name, middle + interval)

    def long(self, name: str, text: str) -> Quote:
        """Return a result, with a mark if it is of a long study."""
        return self.results.say(name, f"{text}{MARK if name.startswith(QUOTED) else ''}")

    def n(self, claim: str, key: str, digits: int = 3) -> Quote:
        """Return a number that decides a claim."""
        return self.ledger.quote(claim, key, digits)

    def share_of(self, claim: str, key: str) -> Quote:
        """Return the same in per cent."""
        return self.n(claim, key)._replace(text=percent(self.ledger.value(claim, key)))

    def verdicts(self, figure: int) -> str:
        """Return how many of the paper's claims on a figure have each verdict."""
        return counted_verdicts(on_figure(self.ledger.rows, figure))

    def figure_holds(self, figure: int) -> str:
        """Return in words whether what the paper says of a figure holds."""
        return whether_it_holds(on_figure(self.ledger.rows, figure))


def gather(results: Results) -> dict[str, Any]:
    """Return all that the template names: functions of `Numbers`, and numbers made of several."""
    numbers = Numbers(results)
    functions = (
        "labels",
        "of",
        "span",
        "percent_of",
        "share",
        "range_of",
        "share_span",
        "n",
        "share_of",
        "verdicts",
        "figure_holds",
    )
    compared, study = results["checks/solvers"], results[LONG]
    speed = results[f"{KEPT}/speed/work_precision"]
    return {
        **{name: getattr(numbers, name) for name in functions},
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
