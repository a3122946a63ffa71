"""The report's part on the infinite chain: growth in time, the front, and the bulk behind it."""

from typing import Any

import numpy as np

from pendula.ledger.section import Ledger
from pendula.report.results import Results, Section, Table
from pendula.report.words import MINUS, case_of, number, span, told

GROWTH, FRONT, THERMAL = "unbounded/growth", "unbounded/front", "unbounded/thermal"
MAIN = "unbounded/fig4_small"


def gather(results: Results, ledger: Ledger) -> dict[str, Any]:
    """Return exponents of tau, maxima of neighbours, and fronts over Omega, with the figures."""
    front = results[FRONT]
    cases = [str(name) for name in results[GROWTH]["case"].values]
    speeds = span((front["corrected_speed"] / front["predicted_speed"]).values, 4)
    powers = span((front["mean_power"] / front["expected_power"]).values, 2)
    return {
        "cases": Table(
            "Runs on the infinite chain: only the sites in motion are integrated",
            ["case", "up to τ", "last site", "ℓ² at the end",
             "exponents of τ in ℓ², one for each doubling of τ", "the last, with its error"],
            [_case(results, name) for name in cases],
        ),
        "growth_law": results.figure("growth_law", (
            "Infinite chains against τ. Above: (ℓ²)² over τ, and its relative deviation from its "
            "law where there is one. Shaded bands reach from the lowest to the highest run of an "
            "ensemble; bars are confidence intervals of the mean by Student's t. The dashed law "
            "has no fitted constant: twice the speed of linear spreading times P of the thermal "
            "state, less the known delay of a pulled front. The dotted line adds a constant to "
            "(ℓ²)², which is fitted. Below: the exponents of τ in ℓ², and ℓ∞, whose dashed law is "
            "that of a chain in equilibrium up to the front."
        )),
        "maxima": _maxima(results, ledger),
        "fronts": Table(
            "The front and the bulk behind it; speeds in sites per unit of τ, P a mean per site",
            ["Ω", "speed of the front without its delay", "speed of linear spreading",
             "P of the bulk", "P from the slope of (ℓ²)²", "P of the thermal state"],
            [_front(results, front.isel(omega=index)) for index in range(front.sizes["omega"])],
        ),
        "front": results.figure("front", told(
            "The front and the bulk behind it against Ω. The speed of the front is {speeds} of "
            "that of linear spreading; all runs of an ensemble have one front. Outside of the "
            "unstable band the line is the largest group velocity, at which no front moves. The "
            "power P of a site in the bulk is {powers} of that of the thermal state.",
            speeds=results.say(FRONT, speeds), powers=results.say(FRONT, powers),
        )),
        "window_map": results.figure("window_map", (
            "Largest ℓ² over time windows and half-widths; each map has colours of its own. Solid "
            "lines show where a front has reached the end of the chain. Where the chain at rest is "
            "stable, dotted lines show how far the fastest waves have come. Bars span the runs of "
            "the ensemble."
        )),
    }  # fmt: skip


def _case(results: Results, name: str) -> list:
    case, run = results[GROWTH].sel(case=name), f"unbounded/{name}"
    exponents = case["l2_exponent"].values
    octaves = ", ".join(f"{exponent:.3f}".replace("-", MINUS) for exponent in exponents)
    return [
        case_of(case),
        results.quote(run, float(results[run]["tau"].max()), 4),
        results.quote(run, int(results[run]["width"].max()), 6),
        results.quote(GROWTH, float(case["l2"].sel(band="mean").isel(point=-1))),
        results.say(GROWTH, octaves),
        results.quote_error(GROWTH, float(exponents[-1]), float(case["l2_exponent_error"][-1])),
    ]


def _maxima(results: Results, ledger: Ledger) -> Table:
    """Return the largest modulus of N neighbours in the bulk, beside that of the thermal state."""
    row = "unbounded_maximum"
    known = np.isfinite(ledger.value(row, "norm_over_thermal"))
    return Table(
        "Largest |A_n| or |B_n| on N neighbouring sites: mean over the old half of the bulk at "
        f"Ω = {number(results[MAIN].attrs['omega'])}, and of the thermal state",
        ["N", "runs", "thermal state"],
        [[results.quote(MAIN, int(n)),
          *(ledger.quote(row, f"{of}_{n}_sites", 4) for of in ("of", "thermal_of"))]
         for n in (results[MAIN]["neighbours"].values if known else ())],
    )  # fmt: skip


def _front(results: Results, one) -> list:
    speed, power, slope = (
        results.quote_error(FRONT, float(one[name]), float(one[f"{name}_error"]))
        for name in ("corrected_speed", "mean_power", "slope_power")
    )
    predicted = results.quote(FRONT, float(one["predicted_speed"]), 4)
    thermal = results.quote(FRONT, float(one["expected_power"]), 5)
    return [number(float(one["omega"])), speed, predicted, power, slope, thermal]


SECTIONS = (Section("growth", "Growth without bound, on infinite chains", gather),)
