"""The numbers that the article quotes, by name, each read from a dataset and linked to it."""

import json
from collections import Counter
from collections.abc import Callable
from typing import Any

import numpy as np
import xarray as xr
from latticode.measures.confidence import CONFIDENCE

from pendula.configuration.schema import PAPER_CASES
from pendula.ledger.claim import Kind, Origin
from pendula.ledger.criterion import Verdict
from pendula.ledger.rows import (
    Ledger,
    counted_verdicts,
    load,
    on_figure,
    tally,
    whether_it_holds,
)
from pendula.report.results import Results
from pendula.report.words import FIRM, Quote, number, percent, span, with_error
from pendula.studies.paper.solvers import ORDER

KEPT = "../tests/baseline"
"""Where committed datasets lie, seen from the article."""
QUOTED = f"{KEPT}/quoted/"
LONG = f"{QUOTED}unbounded"
MARK = "†"
"""It follows each result of a long study, which a full run does not make again."""
ROUNDING = 1e-9
"""A number with a smaller relative error is printed without it."""
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
            exact = error < ROUNDING * abs(value)
            return self.long(name, number(value, digits) if exact else with_error(value, error))
        return self._say(name, data, variable, lambda one: number(one, digits))

    def span(self, name: str, variable: str, digits: int = 3) -> Quote:
        """Return the range of a number over all its labels, which contains their errors."""
        data = self.results[name]
        value, error = (data[f"{variable}{part}"].values for part in ("", "_error"))
        return self.long(name, span(np.array([value - error, value + error]), digits))

    def percent_of(self, name: str, variable: str, **labels) -> Quote:
        """Return a number with its error in per cent."""
        data = self.results[name].sel(labels)
        value, error = (100.0 * float(data[f"{variable}{part}"]) for part in ("", "_error"))
        return self.long(name, f"({with_error(value, error)}){FIRM}%")

    def share(self, name: str, variable: str, **labels) -> Quote:
        """Return a fraction in per cent."""
        return self._say(name, self.results[name].sel(labels), variable, percent)

    def range_of(self, name: str, variable: str, digits: int = 2, **labels) -> Quote:
        """Return the range of several numbers, such as 6.9 to 7.5."""
        return self.long(name, span(self.results[name].sel(labels)[variable].values, digits))

    def share_span(self, name: str, variable: str, **labels) -> Quote:
        """Return the range of several fractions in per cent."""
        parts = self.results[name].sel(labels)[variable].values
        return self.long(name, f"{percent(parts.min())} to {percent(parts.max())}")

    def _say(
        self, name: str, data: xr.Dataset, variable: str, write: Callable[[float], str]
    ) -> Quote:
        """Return a number with its confidence interval, if this has a width."""
        given = data[variable] if variable in data.variables else data.attrs[variable]
        ends = [write(float(data[end]))
                for end in (f"{variable}_low", f"{variable}_high") if end in data]  # fmt: skip
        told = write(float(given))
        interval = f" ({' to '.join(ends)})" if set(ends) - {told} else ""
        say = self.long if variable in data.data_vars else self.results.say
        return say(name, told + interval)

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
    return {
        **{name: getattr(numbers, name) for name in functions},
        "counts": counts(load(results)),
        "kept": QUOTED,
        "confidence": percent(CONFIDENCE),
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
        "peer": lambda name: numbers.of(f"{KEPT}/speed/work_precision", "mean_ratio", peer=name),
        "by_hand": by_hand(results[f"{KEPT}/speed/work_precision"]),
        "full_run": full_run(results),
    }


def by_hand(speed: xr.Dataset) -> str:
    """Return a phrase that compares the fastest Taylor method in C++ with our best solver."""
    of_cpp = [str(name).startswith("cpp_taylor") for name in speed["peer"].values]
    ratio = float(speed["mean_ratio"][of_cpp].min())
    if ratio < 1:
        return f"is {number(1 / ratio)}{MARK} times faster"
    return f"takes {number(ratio)}{MARK} times as long"


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
