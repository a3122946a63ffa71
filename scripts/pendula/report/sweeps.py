"""Figures 5 and 6: the norms against the half-width, in each reading, and where they level off."""

from typing import Any

import numpy as np

from ..theory.readings import CONSTANT, levelling
from .numbers import number, percent
from .results import Results
from .words import case_of

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
        "l2": [curve for curve in found if curve["norm"] == "l2"],
    }


def _curve(results: Results, source: str, panel: str, reading: str, norm: str) -> dict[str, Any]:
    data = results[source].sel(panel=panel, reading=reading)
    kept = data[norm].dropna("half_width")
    widths, values = kept["half_width"].values, kept.values
    statistic, window = (str(data[key].values) for key in ("statistic", "window"))
    level = levelling(widths, values)
    change, case = values[-1] / values[0] - 1.0, case_of(data)
    told = f"{STATISTICS[statistic]} on {window}"
    row = [
        f"{case}: {NORMS[norm]}, {told}",
        results.quote(source, values[0]),
        results.quote(source, values[-1]),
        results.say(source, f"{moved(change)}, {percent(change)}"),
        results.say(source, levelled(level)),
    ]
    alt = f"{case}: {told} goes from {number(values[0])} to {number(values[-1])}"
    return {"row": row, "alt": alt, "norm": norm, "by_text": reading == "text", "case": case,
            "told": told, "moved": moved(change), "level": results.say(source, levelled(level)),
            "last": results.quote(source, values[-1])}  # fmt: skip


def moved(change: float) -> str:
    """Return in a word which way a curve went, by the measure of the claims."""
    if abs(change) < CONSTANT:
        return "unchanged"
    return "grows" if change > 0 else "falls"


def levelled(level: float) -> str:
    """Return from which half-width a curve is level."""
    return f"levels off from M = {number(level)}" if np.isfinite(level) else "does not level off"
