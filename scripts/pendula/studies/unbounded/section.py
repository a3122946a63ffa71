"""The conjecture, on chains without ends: growth in time, the front, and the sea behind it."""

from typing import Any

import numpy as np

from pendula.ledger.section import Ledger
from pendula.report.numbers import MINUS, number, span
from pendula.report.results import Results
from pendula.report.words import case_of

from .fronts import speeds

# ASSUME: "as the square root": the last octave's power is within this of one half
ROOT, NEAR = 0.5, 0.1
LAW, FRONT = "figures/growth_law", "figures/front"
OMEGAS, THERMAL = "unbounded/omegas", "unbounded/thermal"


def gather(results: Results, ledger: Ledger) -> dict[str, Any]:
    """Return the powers of tau, the fronts over Omega, and the three pictures."""
    cases = [_case(results, str(name)) for name in results[LAW]["case"].values]
    fronts = _fronts(results)
    return {
        "cases": cases,
        "main": _main(results, ledger),
        "fronts": fronts["rows"],
        "omegas": results.quote(OMEGAS, len(fronts["rows"])),
        "speed_ratio": results.say(OMEGAS, span(fronts["speed_ratio"], 4)),
        "power_ratio": results.say(FRONT, span(fronts["power_ratio"], 2)),
        "tries_known": bool(np.isfinite(ledger.value("unbounded_large", "tried"))),
        "tried": ledger.quote("unbounded_large", "tried"),
        "spreading": ledger.quote("unbounded_large", "spreading"),
        "verdicts": {name: ledger.verdict(name) for name in ("unbounded_in_time",
                     "fig5_conjecture", "fig6_diverges", "unbounded_window")},
        "because": {name: ledger.because(name) for name in ("fig5_conjecture", "unbounded_window")},
        "pictures": _pictures(results, cases, fronts),
    }  # fmt: skip


def _main(results: Results, ledger: Ledger) -> dict[str, Any]:
    names = ("end", "sites", "over_its_law")
    quotes = {name: ledger.quote("unbounded_in_time", name, 5) for name in names}
    power, error = (ledger.value("unbounded_in_time", name) for name in ("power", "error"))
    return {
        **quotes,
        "known": bool(np.isfinite(power)),
        "power": results.quote_error("unbounded/fig4_small", power, error),
        "near": abs(power - ROOT) < NEAR,
        "half": number(ROOT),
        "measure": number(NEAR),
        "linf_power": ledger.quote("unbounded_maximum", "power", 2),
        "linf_last": ledger.quote("unbounded_maximum", "last"),
    }


def _case(results: Results, name: str) -> dict[str, Any]:
    case = results[LAW].sel(case=name)
    last = case["l2_power"].isel(octave=-1)
    power, error = (float(last.sel(part=part)) for part in ("power", "error"))
    octaves = [f"{float(p):.3f}".replace("-", MINUS) for p in case["l2_power"].sel(part="power")]
    run = f"unbounded/{name}"
    end = float(results[run]["tau"].max())
    return {
        "case": case_of(case),
        "grows": power - 3.0 * error > 0 and power > NEAR,
        "row": [
            case_of(case),
            results.quote(run, end, 4),
            results.quote(run, int(results[run]["width"].max()), 6),
            results.quote(LAW, float(case["l2"].sel(statistic="mean").isel(point=-1))),
            results.say(LAW, ", ".join(octaves)),
            results.quote_error(LAW, power, error),
        ],
        "power": results.quote_error(LAW, power, error),
    }


def _fronts(results: Results) -> dict[str, Any]:
    front, omegas = results[FRONT], results[OMEGAS]
    measured, errors = speeds(omegas, corrected=True)
    predicted = omegas["predicted_speed"].values
    sea, thermal = front["power"].values, _thermal(results, omegas["omega"].values)
    rows = [
        [
            f"Ω = {number(omega)}",
            results.quote_error(OMEGAS, measured[i], errors[i]),
            results.quote(OMEGAS, predicted[i], 4),
            results.quote(FRONT, sea[i]),
            results.quote(THERMAL, thermal[i]),
        ]
        for i, omega in enumerate(omegas["omega"].values)
    ]
    return {"rows": rows, "speed_ratio": measured / predicted, "power_ratio": sea / thermal}


def _thermal(results: Results, omegas: np.ndarray) -> np.ndarray:
    """Return the power of the thermal state at each Omega, NaN where none was sampled."""
    known = results[THERMAL]["power"]
    return known.reindex(omega=omegas, method="nearest", tolerance=1e-9).values


def _pictures(results: Results, cases: list[dict], fronts: dict) -> dict[str, Any]:
    told = "; ".join(f"{case['case']}: last power {case['power']}" for case in cases)
    window = results["figures/window_map"]
    widths, ends = window["half_width"].values, window["end"].values
    return {
        "law": results.picture("growth_law", f"Norms without ends against τ. {told}."),
        "front": results.picture(
            "front",
            f"Speeds of the front at {len(fronts['rows'])} values of Ω, "
            f"{span(fronts['speed_ratio'], 4)} of the predicted, and the sea behind it.",
        ),
        "windows": results.picture(
            "window_map",
            f"Largest l2 over windows that end at τ = {number(np.min(ends))} to "
            f"{number(np.max(ends))}, half-widths {widths.min()} to {widths.max()}, in "
            f"{window.sizes['sweep']} sweeps.",
        ),
    }
