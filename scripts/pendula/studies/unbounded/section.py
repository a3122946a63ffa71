"""The conjecture, on chains without ends: growth in time, the front, and the bulk behind it."""

from typing import Any

import numpy as np

from pendula.ledger.section import Ledger
from pendula.problem import is_even
from pendula.report.results import Results, Section
from pendula.report.words import MINUS, case_of, number, span

ROOT, SLOW = 0.5, 0.25
"""The exponents of l2 behind a steady front, and of diffusion."""

OF = ("of", "thermal_of")
"""A mean largest modulus of so many sites, measured and of the thermal state."""

GROWTH, FRONT, THERMAL = "unbounded/growth", "unbounded/front", "unbounded/thermal"
MAIN = "unbounded/fig4_small"
MAPS = ["unbounded/map_fig5_left", "unbounded/map_fig5_right"]
MAPS += ["unbounded/map_fig6_left", "unbounded/map_fig6_right"]


def gather(results: Results, ledger: Ledger) -> dict[str, Any]:
    """Return the exponents of tau, the fronts over Omega, and the three pictures."""
    cases = [_case(results, str(name)) for name in results[GROWTH]["case"].values]
    fronts = _fronts(results)
    return {
        "cases": cases,
        "even": all(map(is_even, map(str, results[GROWTH]["initial"].values))),
        "main": _main(results, ledger),
        "maximum": _maximum(results, ledger),
        "bulk": _bulk(results, ledger),
        "warm": _warm(ledger),
        "fronts": fronts["rows"],
        "omegas": results.quote(FRONT, len(fronts["rows"])),
        "speed_ratio": results.say(FRONT, span(fronts["speed_ratio"], 4)),
        "resolved": bool(np.isfinite(ledger.value("unbounded_front", "resolution"))),
        "resolution": ledger.quote("unbounded_front", "resolution", 2),
        "power_ratio": results.say(FRONT, span(fronts["power_ratio"], 2)),
        "tries_known": bool(np.isfinite(ledger.value("unbounded_large", "tried"))),
        "tried": ledger.quote("unbounded_large", "tried"),
        "spreading": ledger.quote("unbounded_large", "spreading"),
        "verdicts": {name: ledger.verdict(name) for name in ("unbounded_in_time",
                     "ensemble_fig5_conjecture", "ensemble_fig6_diverges", "unbounded_window")},
        "because": {name: ledger.because(name) for name in ("ensemble_fig5_conjecture",
                    "unbounded_window")},
        "pictures": _pictures(results, cases, fronts),
    }  # fmt: skip


def _main(results: Results, ledger: Ledger) -> dict[str, Any]:
    names = ("end", "sites", "over_its_law", "members")
    quotes = {name: ledger.quote("unbounded_in_time", name, 5) for name in names}
    power, error = (ledger.value("unbounded_in_time", name) for name in ("exponent", "error"))
    return {
        **quotes,
        "known": bool(np.isfinite(power)),
        "because": ledger.because("unbounded_in_time"),
        "omega": results.quote(
            "unbounded/fig4_small", results["unbounded/fig4_small"].attrs["omega"]
        ),
        "power": results.quote_error(MAIN, power, error),
        "near": abs(power - ROOT) <= error,
        "half": number(ROOT),
    }


def _maximum(results: Results, ledger: Ledger) -> dict[str, Any]:
    """Return the largest modulus of N neighbours in the bulk, beside that of the thermal state."""
    row = "unbounded_maximum"
    names = ("norm_over_thermal", "norm_over_thermal_error")
    norm, error = (ledger.value(row, name) for name in names)
    known = bool(np.isfinite(norm))
    sizes = results[MAIN]["neighbours"].values if known else []
    return {
        "known": known,
        "because": ledger.because(row),
        "last": ledger.quote(row, "last"),
        "norm": results.quote_error(MAIN, norm, error),
        "sizes": [
            [results.quote(MAIN, int(n)), *(ledger.quote(row, f"{of}_{n}_sites", 4) for of in OF)]
            for n in sizes
        ],
    }


def _bulk(results: Results, ledger: Ledger) -> dict[str, Any]:
    """Return P of the bulk and of the slope of l2^2 beside that of the thermal state."""
    row, thermal = "unbounded_slope", results[THERMAL]
    both = {
        name: results.quote_error(
            MAIN, ledger.value(row, f"power_of_{name}"), ledger.value(row, f"power_of_{name}_error")
        )
        for name in ("bulk", "slope")
    }
    longest = thermal.isel(omega=int(thermal["correlation_length"].values.argmax()))
    return {
        **both,
        "known": bool(np.isfinite(ledger.value(row, "power_of_slope"))),
        "thermal": ledger.quote(row, "thermal_power", 5),
        "because": ledger.because("unbounded_equilibrium"),
        "slope_because": ledger.because(row),
        "length": results.quote(THERMAL, float(longest["correlation_length"]), 2),
        "length_omega": results.quote(THERMAL, float(longest["omega"])),
    }


def _warm(ledger: Ledger) -> dict[str, Any]:
    """Return the energy that the front leaves behind, and P beside the thermal ones."""
    row, value = "unbounded_warm", ledger.value
    names = ("energy", "energy_error", "power", "power_error")
    names += ("thermal_power", "thermal_power_without_energy")
    return {
        "known": bool(np.isfinite(value(row, "energy"))),
        "because": ledger.because(row),
        **{name: ledger.quote(row, name, 4) for name in names},
    }


def _case(results: Results, name: str) -> dict[str, Any]:
    case = results[GROWTH].sel(case=name)
    exponents = case["l2_exponent"].values
    last, error = float(exponents[-1]), float(case["l2_exponent_error"][-1])
    octaves = ", ".join(f"{exponent:.3f}".replace("-", MINUS) for exponent in exponents)
    run = f"unbounded/{name}"
    end = float(results[run]["tau"].max())
    return {
        "case": case_of(case),
        "grows": last - float(np.nan_to_num(error)) > SLOW,  # a single run has no error
        "row": [
            case_of(case),
            results.quote(run, end, 4),
            results.quote(run, int(results[run]["width"].max()), 6),
            results.quote(GROWTH, float(case["l2"].sel(band="mean").isel(point=-1))),
            results.say(GROWTH, octaves),
            results.quote_error(GROWTH, last, error),
        ],
        "power": results.quote_error(GROWTH, last, error),
    }


def _fronts(results: Results) -> dict[str, Any]:
    front = results[FRONT]
    with_errors = ("corrected_speed", "mean_power", "slope_power")
    rows = []
    for index, omega in enumerate(front["omega"].values):
        one = front.isel(omega=index)
        speed, power, slope = (
            results.quote_error(FRONT, float(one[name]), float(one[f"{name}_error"]))
            for name in with_errors
        )
        predicted = results.quote(FRONT, float(one["predicted_speed"]), 4)
        thermal = results.quote(FRONT, float(one["expected_power"]), 5)
        rows.append([f"Ω = {number(omega)}", speed, predicted, power, slope, thermal])
    return {
        "rows": rows,
        "speed_ratio": (front["corrected_speed"] / front["predicted_speed"]).values,
        "power_ratio": (front["mean_power"] / front["expected_power"]).values,
    }


def _pictures(results: Results, cases: list[dict], fronts: dict) -> dict[str, Any]:
    told = "; ".join(f"{case['case']}: last exponent {case['power']}" for case in cases)
    maps = [results[name] for name in MAPS]
    widths, ends = maps[0]["half_width"].values, maps[0]["end"].values
    return {
        "law": results.picture("growth_law", f"Norms without ends against τ. {told}."),
        "front": results.picture(
            "front",
            f"Speeds of the front at {len(fronts['rows'])} values of Ω, "
            f"{span(fronts['speed_ratio'], 4)} of the predicted, and the bulk behind it.",
        ),
        "windows": results.picture(
            "window_map",
            f"Largest l2 over windows that end at τ = {number(np.min(ends))} to "
            f"{number(np.max(ends))}, half-widths {widths.min()} to {widths.max()}, in "
            f"{len(maps)} sweeps.",
        ),
    }


SECTIONS = (Section("growth", "Growth without bound", gather),)
