"""The report's part on the paper's figures: norms against time, and against the half-width."""

from collections.abc import Iterable
from typing import Any

import numpy as np

from pendula.datasets.registry import SOLVER_NAMES
from pendula.ledger.claim import CHANGE, CONSTANT
from pendula.ledger.section import Ledger
from pendula.measures.levels import levelling
from pendula.problem import is_even, name_window
from pendula.report.results import Results, Section
from pendula.report.words import (
    FIRM,
    NORMS,
    STATISTICS,
    case_in_words,
    measured,
    number,
    percent,
    span,
)

from .known import KNOWN, TRUST, is_chaotic, trusted
from .motion import SIZES, gather_motion
from .section_breathers import beside_breathers
from .section_solvers import gather_solvers

DRAWN = {5: ("l2", "linf"), 6: ("l2",)}
"""The norms that the paper's figures of sweeps draw."""

SWEPT = ("fig5_left", "fig5_right", "fig6_left", "fig6_right")

SAMPLES = "checks/ensemble_runs"
ENSEMBLES = "checks/ensembles"


def gather_figures(results: Results, ledger: Ledger) -> dict[str, Any]:
    """Return Figs 1 to 6, each with its picture and what its datasets say in numbers."""
    alt = "A drawing of a chain of pendula pairs on strings, coupled along the chain and across "
    return {
        "chain": results.picture("fig1", f"{alt}each pair."),
        "norms": [_norms(results, which) | beside_breathers(results, which) for which in (2, 3, 4)],
        "sweeps": [_sweeps(results, which) | beside_breathers(results, which) for which in (5, 6)],
        **half_widths(results, SWEPT),
        "verdicts": {which: ledger.counts(f"Fig {which}") for which in range(1, 7)},
        "cases": results.quote(TRUST, results[TRUST].sizes["case"]),
        "visible": _visible(results),
        "ensemble": {
            "runs": results.quote(ENSEMBLES, int(results[ENSEMBLES].attrs["members"])),
            "share": results.say(SAMPLES, percent(float(results[SAMPLES]["band_share"]))),
        },
    }


def _visible(results: Results) -> str:
    return percent(float(results[TRUST]["size"].sel(level="visible")))


def _norms(results: Results, which: int) -> dict[str, Any]:
    names = [f"fig{which}_{size}" for size in SIZES]
    panels = [_panel(results, name) for name in names]
    runs = [f"trajectories/{name}" for name in names]
    last = max(runs, key=lambda run: float(results[run]["tau"][-1]))
    end = float(results[last]["tau"][-1])
    told = "; ".join(panel["alt"] for panel in panels)
    alt = f"Norms of A and B against τ, 0 to {number(end)}. {told}."
    known = {state: [p for p in panels if p["known"] == state] for state in KNOWN}
    return {
        "number": which,
        "picture": results.picture(f"fig{which}", alt),
        "omegas": omegas(results, runs),
        "end": results.quote(last, end),
        "rows": [panel["row"] for panel in panels],
        "divergences": [(panel["case"], panel["time"]) for panel in known["off"]],
        "chaotic": any(panel["chaotic"] for panel in known["off"]),
        "regular": [panel["case"] for panel in known["off"] if not panel["chaotic"]],
        "bands": any(panel["band"] for panel in known["off"]),
        "even": all(panel["even"] for panel in known["off"]),
        "agree": [panel["case"] for panel in known["agrees"]],
        "all_agree": len(known["agrees"]) == len(panels),
        "ended": [(panel["case"], panel["until"], panel["end"]) for panel in known["ended"]],
        "unknown": [panel["case"] for panel in known["unknown"]],
    }


def omegas(results: Results, runs: list[str]) -> list:
    """Return each detuning of some trajectories once, linked to the first that has it."""
    found = {}
    for run in runs:
        found.setdefault(float(results[run].attrs["omega"]), run)
    return [results.quote(run, omega) for omega, run in found.items()]


def _panel(results: Results, name: str) -> dict[str, Any]:
    run = f"trajectories/{name}"
    data = results[run]
    l2 = np.sqrt((data["l2"].values ** 2).sum(axis=0))
    late = l2[len(l2) // 2 :]
    case = case_in_words(data.attrs["omega"], data.attrs["initial"])
    off, time, until, source = trusted(results, name)
    row = [
        case,
        results.say(run, span(l2)),
        results.say(run, measured(late.mean())),
        results.say(source, time),
        *_bound(results, name),
        results.quote(run, data.attrs["steps"], 6),
    ]
    peak = number(float(data["linf"].max()))
    alt = f"{case}: l2 of the pair between {number(l2.min())} and {number(l2.max())}, largest "
    return {
        "row": row,
        "alt": f"{alt}amplitude {peak}",
        "case": case,
        "known": off,
        "chaotic": is_chaotic(results, name),
        "time": results.say(source, time),
        "until": results.quote(source, until),
        "end": results.quote(run, float(data["tau"][-1])),
        "band": name in results[ENSEMBLES]["case"].values,
        "even": is_even(data.attrs["initial"]),
    }


def _bound(results: Results, case: str) -> list:
    source = "checks/cases"
    found = results[source].sel(case=case)
    region = str(found["region"].values)
    covered = "Theorem 3 only" if region == "none" else region.capitalize()
    return [results.say(source, covered), results.quote(source, float(found["ratio"]))]


def _sweeps(results: Results, which: int) -> dict[str, Any]:
    names = [f"fig{which}_{side}" for side in ("left", "right")]
    readings = [(statistic, norm) for norm in DRAWN[which] for statistic in STATISTICS]
    found = [_curve(results, name, *reading) for name in names for reading in readings]
    told = "; ".join(curve["alt"] for curve in found if curve["norm"] == "l2" and curve["by_text"])
    widths = half_widths(results, names)
    alt = f"Norms of the pair against the half-width M, {widths['least']} to {widths['longest']}. "
    return {
        "number": which,
        "picture": results.picture(f"fig{which}", f"{alt}{told}."),
        **widths,
        "rows": [curve["row"] for curve in found],
        "samples": _samples(results, which),
        "l2": [curve for curve in found if curve["norm"] == "l2"],
    }


def half_widths(results: Results, names: Iterable[str]) -> dict[str, Any]:
    """Return how many half-widths some sweeps have, and the least and the longest of all."""
    swept = {f"sweeps/{name}": results[f"sweeps/{name}"]["half_width"].values for name in names}
    counts = sorted({len(widths) for widths in swept.values()})
    longest = max(swept, key=lambda source: swept[source].max())
    return {
        "widths": results.say(longest, " or ".join(map(str, counts))),
        "least": str(min(widths.min() for widths in swept.values())),
        "longest": results.quote(longest, int(swept[longest].max()), 6),
    }


def _curve(results: Results, name: str, statistic: str, norm: str) -> dict[str, Any]:
    """Return one curve of a sweep: the text speaks of the maximum, the caption of the average."""
    source = f"sweeps/{name}"
    sweep = results[source].sortby("half_width")
    window = name_window(results.settings["sweeps"][name]["drawn"][statistic])
    at = {"quantity": "pair", "statistic": statistic, "window": window}
    widths, values = sweep["half_width"].values, sweep[norm].sel(at).values
    case = case_in_words(sweep.attrs["omega"], sweep.attrs["initial"])
    level, way = levelled(levelling(widths, values)), shape(widths, values)
    told = f"{STATISTICS[statistic]} on {window.replace(' ', FIRM)}"
    row = [
        f"{case}: {NORMS[norm]}, {told}",
        *(results.say(source, measured(value)) for value in (values[0], values.max(), values[-1])),
        results.say(source, f"{way}, {percent(values[-1] / values[0] - 1.0)}"),
        results.say(source, level),
    ]
    return {
        "row": row,
        "alt": f"{case}: {told} goes from {measured(values[0])} to {measured(values[-1])}",
        "norm": norm,
        "by_text": statistic == "max",
        "case": case,
        "told": told,
        "shape": results.say(source, way),
        "grows": values.max() > (1.0 + CHANGE.value) * values[0],
        "level": results.say(source, level),
    }


def shape(widths: np.ndarray, values: np.ndarray) -> str:
    """Return in words how a curve goes, by the measures of the claims."""
    peak = int(values.argmax())
    if values[peak] > (1.0 + CHANGE.value) * max(values[0], values[-1]):
        return f"rises to {measured(values[peak])} at M = {widths[peak]} and falls again"
    change = values[-1] / values[0] - 1.0
    if abs(change) < CONSTANT.value:
        return "stays as it is"
    return "grows" if change > 0 else "falls"


def levelled(level: float) -> str:
    """Return from which half-width a curve is level."""
    if not np.isfinite(level):
        return "not level by the end"
    return f"level from M{FIRM}={FIRM}{number(level)}"


def _samples(results: Results, which: int) -> list[dict[str, Any]]:
    """Return what runs from almost equal data give on their longest chain, of chaotic sweeps."""
    data = results[SAMPLES]
    names = [str(name) for name in data["sweep"].values if str(name).startswith(f"fig{which}_")]
    known = {name: data.sel(sweep=name).dropna("half_width", subset=["l2_mean"]) for name in names}
    return [
        _sample(results, name, shared.isel(half_width=-1))
        for name, shared in known.items()
        if shared.sizes["half_width"]
    ]


def _sample(results: Results, name: str, last) -> dict[str, Any]:
    off, members = float(last["deviations"]), results[ENSEMBLES]["swept_members"].sel(sweep=name)
    return {
        "case": case_in_words(float(last["swept_omega"]), str(last["swept_initial"].values)),
        "chaotic": is_chaotic(results, results.settings["sweeps"][name]["case"]),
        "solver": SOLVER_NAMES[str(results[f"sweeps/{name}"].attrs["solver"])],
        "width": results.quote(SAMPLES, int(last["half_width"]), 6),
        "runs": results.quote(ENSEMBLES, int(members)),
        "mean": results.say(SAMPLES, measured(float(last["l2_mean"]))),
        "deviation": results.quote(SAMPLES, float(last["l2_deviation"]), 2),
        "run": results.say(SAMPLES, measured(float(last["swept_run"]))),
        "off": results.quote(SAMPLES, abs(off), 2),
        "below": off < 0,
    }


SECTIONS = (
    Section("figures", "The figures", gather_figures),
    Section("motion", "The chain in motion", gather_motion),
    Section("solvers", "The paper's solvers", gather_solvers),
)
