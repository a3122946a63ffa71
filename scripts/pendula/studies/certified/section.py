"""The report's part on proofs: how far computed curves can be from the true ones."""

from decimal import ROUND_CEILING, ROUND_FLOOR, Context
from typing import Any

import numpy as np

from pendula.ledger.section import Ledger
from pendula.report.page import Picture
from pendula.report.results import Results, Section
from pendula.report.words import case_in_words, case_of, number, symbols

from .states import Verdict

LINES = "certified/lines"
BREATHERS, CONSTANTS = "certified/breathers", "certified/constants"
NORMS = {"linf": "ℓ∞", "l2": "ℓ2"}


def gather(results: Results, ledger: Ledger) -> dict[str, Any]:
    """Return what is proved, topic by topic."""
    return {
        "curves": _curves(results),
        "lines": _lines(results),
        "breathers": _breathers(results),
        "constants": _constants(results),
    }


def _curves(results: Results) -> dict[str, Any]:
    names = [
        f"certified/{case}"
        for case in results.settings["certified"]["curves"]["cases"]
        if f"certified/{case}" in results
    ]
    return {
        "head": ["case", "until τ =", "proven bound", "largest distance to the reference"],
        "rows": [_curve(results, name) for name in names],
        "picture": _picture(results, names),
    }


def _curve(results: Results, name: str) -> list:
    one = results[name]
    return [
        case_in_words(one.attrs["omega"], one.attrs["initial"]),
        number(float(one["tau"][-1])),
        results.quote(name, _cut(one["bound"].max(), ROUND_CEILING)),
        results.quote(name, float(one["reference_distance"].max())),
    ]


def _picture(results: Results, names: list[str]) -> Picture:
    said = "; ".join(
        f"{case_in_words(one.attrs['omega'], one.attrs['initial'])}: at the end at most "
        f"{number(_cut(one['bound'][-1], ROUND_CEILING))}"
        for one in map(results.__getitem__, names)
    )
    alt = f"Proven bounds of the distance to the true solution, and their parts. {said}."
    return results.picture("certified_curves", alt)


def _lines(results: Results) -> dict[str, Any]:
    """Return until when each printed line contains the true curve, proved and measured."""
    lines = results[LINES]
    curves = [(norm, one) for norm in lines["norm"].values for one in lines["component"].values]
    return {
        "head": ["case", *(f"{NORMS[str(norm)]} of {one}" for norm, one in curves)],
        "rows": [
            [case_of(case), *(_until(results, case.sel(norm=n, component=c)) for n, c in curves)]
            for case in (lines.sel(case=name) for name in lines["case"].values)
        ],
    }


def _until(results: Results, curve) -> Any:
    proved, measured = (float(curve[f"{how}_until"]) for how in ("contained", "measured"))
    words = [f"{number(proved, 4)} proved" if np.isfinite(proved) else "nothing proved"]
    words += [f"{number(measured, 4)} measured"] if np.isfinite(measured) else ["none measured"]
    return results.say(LINES, ", ".join(words))


VERDICTS = {Verdict.STABLE: "stable", Verdict.UNSTABLE: "unstable", Verdict.UNDECIDED: "open"}


def _breathers(results: Results) -> dict[str, Any]:
    proved = results[BREATHERS]
    return {
        "head": [
            "family",
            "Ω",
            "ε",
            "a true state within",
            "no other within",
            "on the finite chain",
            "growth per unit of τ, at least",
        ],
        "rows": [_breather(results, i) for i in range(proved.sizes["proof"])],
        "sites": results.quote(BREATHERS, 2 * int(proved.attrs["chain_half_width"]) + 1),
        "bits": results.quote(BREATHERS, int(proved.attrs["bits"])),
        "refused": [
            results.quote(BREATHERS, float(omega))
            for omega in proved["tested_omega"].values[np.isinf(proved["wrong_radius"].values)]
        ],
    }


def _breather(results: Results, index: int) -> list:
    """Return what is proved of one state, its digits cut off on the safe side."""
    one = results[BREATHERS].isel(proof=index)
    found = bool(np.isfinite(one["radius"]))
    ends = {"radius": ROUND_CEILING, "unique_radius": ROUND_FLOOR, "growth_low": ROUND_FLOOR}
    safe = [_cut(one[name], way) for name, way in ends.items()]
    told = [results.quote(BREATHERS, x) if found else "no proof" for x in safe]
    verdict = Verdict(int(one["stable"]))
    return [
        symbols(str(one["family"].item())),
        number(float(one["omega"])),
        number(float(one["epsilon"])),
        *told[:2],
        results.say(BREATHERS, VERDICTS[verdict]),
        told[2] if verdict is Verdict.UNSTABLE else "none" if verdict else "",
    ]


def _cut(value, way: str) -> float:
    """Return a proved number with the digits that the page shows, rounded to the safe side."""
    return float(Context(3, way).create_decimal(float(value)))


def _constants(results: Results) -> dict[str, Any]:
    constants = results[CONSTANTS]
    return {
        "count": results.quote(CONSTANTS, constants.sizes["constant"]),
        "error": results.quote(CONSTANTS, float(constants["stored_error"].max())),
    }


SECTIONS = (Section("certified", "Numbers with a proof", gather),)
