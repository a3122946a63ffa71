"""The report's part on proofs: how far computed curves and states can be off."""

from decimal import ROUND_CEILING, ROUND_FLOOR, Context
from typing import Any

import numpy as np

from pendula.ledger.section import Ledger
from pendula.report.results import Results, Section, Table
from pendula.report.words import case_in_words, number, symbols

from .states import Verdict

BREATHERS = "certified/breathers"
VERDICTS = {Verdict.STABLE: "stable", Verdict.UNSTABLE: "unstable", Verdict.UNDECIDED: "open"}


def gather(results: Results, ledger: Ledger) -> dict[str, Any]:
    """Return what is proved of curves and breathers."""
    proved = results[BREATHERS]
    cases = results.settings["certified"]["curves"]["cases"]
    names = [name for name in (f"certified/{case}" for case in cases) if name in results]
    return {
        "curves": Table(
            "Proven distance of computed curves to the true ones",
            ["case", "until τ =", "proven bound"],
            [_curve(results, name) for name in names],
        ),
        "breathers": Table(
            "Steady breathers as theorems for the infinite chain, in arithmetic of "
            f"{int(proved.attrs['bits'])} bits with all rounding bounded; the spectrum is enclosed "
            f"on a chain of {2 * int(proved.attrs['chain_half_width']) + 1} pairs",
            ["family", "Ω", "ε", "a true state within", "no other within", "on the finite chain",
             "growth per unit of τ, at least"],
            [_breather(results, i) for i in range(proved.sizes["proof"])],
        ),
    }  # fmt: skip


def _curve(results: Results, name: str) -> list:
    one = results[name]
    return [
        case_in_words(one.attrs["omega"], one.attrs["initial"]),
        number(float(one["tau"][-1])),
        results.quote(name, _cut(one["bound"].max(), ROUND_CEILING)),
    ]


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
