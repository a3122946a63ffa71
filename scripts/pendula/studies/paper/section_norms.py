"""Figures 1 to 4: the norms against time, until when they are the true ones, and their bounds."""

from typing import Any

import numpy as np

from pendula.report.numbers import measured, number, span
from pendula.report.results import Results
from pendula.report.words import case_of

ALT = "Norms of A and B against τ, 0 to {end}. {panels}."
PANEL = "{case}: l2 of the pair between {low} and {high}, largest amplitude {peak}"


def gather(results: Results) -> list[dict[str, Any]]:
    """Return Figs 2 to 4, each with its picture and a row for each of its two panels."""
    return [_figure(results, number_) for number_ in (2, 3, 4)]


def chain(results: Results):
    """Return Fig 1, and how many pairs it draws."""
    return results.picture("fig1", "A drawing of a chain of pendula pairs on strings, coupled "
                           "along the chain and across each pair.")  # fmt: skip


def _figure(results: Results, which: int) -> dict[str, Any]:
    data = results[f"figures/fig{which}"]
    sizes = [str(size) for size in data["amplitude"].values]
    panels = [_panel(results, which, size) for size in sizes]
    end = number(float(data["tau"].max()))
    alt = ALT.format(end=end, panels="; ".join(panel["alt"] for panel in panels))
    return {
        "number": which,
        "picture": results.picture(f"fig{which}", alt),
        "omega": results.quote(f"figures/fig{which}", float(data["omega"][0])),
        "end": results.quote(f"figures/fig{which}", float(data["tau"].max())),
        "rows": [panel["row"] for panel in panels],
        "divergences": [
            (panel["case"], panel["divergence_time"])
            for panel in panels
            if panel["divergence_time"]
        ],
    }


def _panel(results: Results, which: int, size: str) -> dict[str, Any]:
    source = f"figures/fig{which}"
    panel = results[source].sel(amplitude=size)
    l2 = np.sqrt((panel["l2"].values ** 2).sum(axis=0))
    late = l2[len(l2) // 2 :]
    time, case = float(panel["divergence_time"]), case_of(panel)
    run = f"trajectories/fig{which}_{size}"
    row = [
        case,
        results.say(source, span(l2)),
        results.say(source, measured(late.mean())),
        results.quote_time(source, time),
        *_bound(results, f"fig{which}_{size}"),
        results.quote(run, results[run].attrs["steps"], 6),
    ]
    peak = number(float(panel["linf"].max()))
    alt = PANEL.format(case=case, low=number(l2.min()), high=number(l2.max()), peak=peak)
    known = results.quote_time(source, time) if np.isfinite(time) else None
    return {"row": row, "alt": alt, "case": case, "divergence_time": known}


def _bound(results: Results, case: str) -> list:
    source = "checks/cases"
    found = results[source].sel(case=case)
    region = str(found["region"].values)
    covered = "Theorem 3 only" if region == "none" else region.capitalize()
    return [results.say(source, covered), results.quote(source, float(found["ratio"]))]
