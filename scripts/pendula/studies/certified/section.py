"""The report's part on proofs: how far computed curves, states and constants can be off."""

from decimal import ROUND_CEILING, ROUND_FLOOR, Context
from typing import Any

import numpy as np

from pendula.ledger.section import Ledger
from pendula.report.results import Results, Section, Table
from pendula.report.words import NORMS, case_in_words, case_of, number, symbols

from .states import Verdict

LINES = "certified/lines"
BREATHERS, CONSTANTS = "certified/breathers", "certified/constants"
VERDICTS = {Verdict.STABLE: "stable", Verdict.UNSTABLE: "unstable", Verdict.UNDECIDED: "open"}


def gather(results: Results, ledger: Ledger) -> dict[str, Any]:
    """Return what is proved of curves, printed lines, breathers and constants."""
    proved, constants = results[BREATHERS], results[CONSTANTS]
    cases = results.settings["certified"]["curves"]["cases"]
    names = [name for name in (f"certified/{case}" for case in cases) if name in results]
    return {
        "curves": Table(
            "Proven distance of computed curves to the true ones",
            ["case", "until τ =", "proven bound", "largest distance to the reference"],
            [_curve(results, name) for name in names],
        ),
        "certified_curves": results.figure("certified_curves", (
            "The proven bound of the distance to the true solution, and its parts. The dotted line "
            "is the largest distance of a norm to the multiprecision reference up to each time."
        )),
        "lines": _lines(results),
        "breathers": Table(
            "Steady breathers as theorems for the infinite chain, in arithmetic of "
            f"{int(proved.attrs['bits'])} bits with all rounding bounded; the spectrum is enclosed "
            f"on a chain of {2 * int(proved.attrs['chain_half_width']) + 1} pairs",
            ["family", "Ω", "ε", "a true state within", "no other within", "on the finite chain",
             "growth per unit of τ, at least"],
            [_breather(results, i) for i in range(proved.sizes["proof"])],
        ),
        "constants": Table(
            "Constants of Lemma 1 and of Theorems 1 to 3, enclosed",
            ["constants", "largest distance of a stored one, relative where it exceeds one"],
            [[results.quote(CONSTANTS, constants.sizes["constant"]),
              results.quote(CONSTANTS, float(constants["stored_error"].max()))]],
        ),
    }  # fmt: skip


def _curve(results: Results, name: str) -> list:
    one = results[name]
    return [
        case_in_words(one.attrs["omega"], one.attrs["initial"]),
        number(float(one["tau"][-1])),
        results.quote(name, _cut(one["bound"].max(), ROUND_CEILING)),
        results.quote(name, float(one["reference_distance"].max())),
    ]


def _lines(results: Results) -> Table:
    """Return until when each printed line contains the true curve, proved and measured."""
    lines = results[LINES]
    curves = [(norm, one) for norm in lines["norm"].values for one in lines["component"].values]
    rows = []
    for case in (lines.sel(case=name) for name in lines["case"].values):
        both = ([float(case[f"{how}_until"].sel(norm=norm, component=one))
                 for how in ("contained", "measured")] for norm, one in curves)  # fmt: skip
        said = (", ".join([f"{number(proved, 4)} proved" if np.isfinite(proved) else "not proved",
                           f"{number(seen, 4)} measured" if np.isfinite(seen) else "not measured"])
                for proved, seen in both)  # fmt: skip
        rows.append([case_of(case), *(results.say(LINES, text) for text in said)])
    head = ["case", *(f"{NORMS[str(norm)]} of {one}" for norm, one in curves)]
    title = "τ up to which the printed lines of Figs 2 to 4 contain the true curves"
    return Table(title, head, rows)


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


SECTIONS = (Section("certified", "Proven bounds", gather),)
