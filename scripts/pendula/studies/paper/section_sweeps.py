"""Figures 5 and 6: the norms against the half-width, in each reading, and where they level off."""

from typing import Any

import numpy as np

from pendula.ledger.readings import CHANGE, CONSTANT
from pendula.measures.levels import levelling
from pendula.report.numbers import FIRM, measured, number, percent
from pendula.report.results import Results
from pendula.report.words import case_in_words, case_of

ALT = "Norms of the pair against the half-width M, {first} to {last}. {panels}."
NORMS = {"l2": "ℓ²", "linf": "ℓ∞"}
STATISTICS = {"max": "maximum", "mean": "average"}


def gather(results: Results) -> list[dict[str, Any]]:
    """Return Figs 5 and 6, each with its picture and a row for each curve in it."""
    return [_figure(results, which) for which in (5, 6)]


def _figure(results: Results, which: int) -> dict[str, Any]:
    source = f"figures/fig{which}"
    data = results[source]
    curves = [
        (panel, reading, norm)
        for panel in data["panel"].values
        for norm in NORMS
        if norm in data
        for reading in data["reading"].values
    ]
    found = [_curve(results, source, *curve) for curve in curves]
    told = [curve["alt"] for curve in found if curve["norm"] == "l2" and curve["by_text"]]
    widths = data["half_width"].values
    alt = ALT.format(first=widths[0], last=widths[-1], panels="; ".join(told))
    return {
        "number": which,
        "picture": results.picture(f"fig{which}", alt),
        "widths": results.quote(source, len(widths), 6),
        "longest": results.quote(source, int(widths[-1]), 6),
        "rows": [curve["row"] for curve in found],
        "samples": _samples(results, which),
        "l2": [curve for curve in found if curve["norm"] == "l2"],
    }


def _curve(results: Results, source: str, panel: str, reading: str, norm: str) -> dict[str, Any]:
    data = results[source].sel(panel=panel, reading=reading)
    kept = data[norm].dropna("half_width")
    widths, values = kept["half_width"].values, kept.values
    statistic, window = (str(data[key].values) for key in ("statistic", "window"))
    level, way, case = levelling(widths, values), shape(widths, values), case_of(data)
    told = f"{STATISTICS[statistic]} on {window.replace(' ', FIRM)}"
    row = [
        f"{case}: {NORMS[norm]}, {told}",
        *(results.say(source, measured(value)) for value in (values[0], values.max(), values[-1])),
        results.say(source, f"{way}, {percent(values[-1] / values[0] - 1.0)}"),
        results.say(source, levelled(level)),
    ]
    alt = f"{case}: {told} goes from {measured(values[0])} to {measured(values[-1])}"
    return {"row": row, "alt": alt, "norm": norm, "by_text": reading == "text", "case": case,
            "told": told, "shape": results.say(source, way), "grows": values.max() > (1.0 + CHANGE)
            * values[0], "level": results.say(source, levelled(level))}  # fmt: skip


def shape(widths: np.ndarray, values: np.ndarray) -> str:
    """Return in words how a curve goes, by the measures of the claims."""
    peak = int(values.argmax())
    if values[peak] > (1.0 + CHANGE) * max(values[0], values[-1]):
        return f"rises to {measured(values[peak])} at M = {widths[peak]} and falls again"
    change = values[-1] / values[0] - 1.0
    if abs(change) < CONSTANT:
        return "stays as it is"
    return "grows" if change > 0 else "falls"


def levelled(level: float) -> str:
    """Return from which half-width a curve is level."""
    if not np.isfinite(level):
        return "not level by the end"
    return f"level from M{FIRM}={FIRM}{number(level)}"


def _samples(results: Results, which: int) -> list[dict[str, Any]]:
    """Return what runs from almost equal data give on the longest chain, of chaotic sweeps."""
    source = "figures/ensembles"
    data = results[source]
    names = [str(name) for name in data["sweep"].values if f"fig{which}_" in str(name)]
    return [_sample(results, source, data.sel(sweep=name).isel(half_width=-1)) for name in names]


def _sample(results: Results, source: str, last) -> dict[str, Any]:
    mean, deviation = (float(last[name]) for name in ("l2_mean", "l2_deviation"))
    run = float(last["swept_run"])
    return {
        "case": case_in_words(float(last["swept_omega"]), str(last["swept_initial"].values)),
        "width": results.quote(source, int(last["half_width"]), 6),
        "runs": results.quote("checks/ensembles", data_members(results)),
        "mean": results.say(source, measured(mean)),
        "deviation": results.quote(source, deviation, 2),
        "run": results.say(source, measured(run)),
        "off": results.quote(source, abs(run - mean) / deviation, 2),
        "below": run < mean,
    }


def data_members(results: Results) -> int:
    """Return how many runs an ensemble of a sweep has."""
    return int(results["checks/ensembles"].attrs["swept_members"])
