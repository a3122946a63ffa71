"""Facts on curves, breathers and constants that are proved."""

import json
from fractions import Fraction
from pathlib import Path

import numpy as np
import xarray as xr
from pendula.report.words import number

from .baseline import Baseline


def proofs(baseline: Baseline) -> dict:
    """Return how near true breathers and true constants are proved to be, rounded upward."""
    proved, constants = baseline["certified/breathers"], baseline["certified/constants"]
    return {
        "states": str(proved.sizes["proof"]),
        "radius": number(1.05 * float(proved["radius"].max()), 2),
        "unique": number(0.95 * float(proved["unique_radius"].min()), 2),
        "chain_sites": str(2 * int(proved.attrs["chain_half_width"]) + 1),
        "stable": str(int((proved["stable"] == 1).sum())),
        "unstable": str(int((proved["stable"] == 0).sum())),
        "bits": str(int(proved.attrs["bits"])),
        "constants": str(constants.sizes["constant"]),
        "constants_off": number(1.05 * float(constants["stored_error"].max()), 2),
    }


def certified(baseline: Baseline) -> dict:
    """Return the proven bounds of curves, rounded upward, what lines contain, and a short proof."""
    lines = baseline["certified/lines"]
    cases = [str(case) for case in lines["case"].values]
    framed = [case for case in cases if baseline.has(f"proofs/{case}")]
    known = [case for case in cases if baseline.has(f"certified/{case}")] + framed
    curves = {
        case: baseline[f"proofs/{case}" if case in framed else f"certified/{case}"]
        for case in known
    }
    whole = lines["contained_until"] == lines["run_end"]
    share = lines["largest_distance"] / lines["half_line"]
    return {
        "rows": [_certified_curve(curves[case], case) for case in known if case not in framed],
        "framed": [
            {
                **_certified_curve(curves[case], case),
                "growth": number(float(curves[case]["error_exponent"][-1]), 3),
            }
            for case in framed
        ],
        "count": number(len(known)),
        "largest": _upward(max(curves[case]["bound"].max() for case in known)),
        "until": number(min(float(curves[case]["tau"][-1]) for case in known)),
        "contained": number(int(whole.sum())),
        "in_lines": _upward(share.where(whole & np.isfinite(share)).max()),
        "certificate": _short_case(baseline.folder / "proofs/short_case.json"),
    }


def _upward(bound) -> str:
    """Return two digits of a number that is no smaller than the bound."""
    return number(1.05 * float(bound), 2)


def _certified_curve(curve: xr.Dataset, case: str) -> dict[str, str]:
    last = curve.isel(tau=int(curve["bound"].argmax("tau")))
    largest = last["bound_parts"].argmax("bound_part")
    return {
        "case": case,
        "end": number(float(curve["tau"][-1])),
        "bound": _upward(last["bound"]),
        "part": str(curve["bound_part"].values[int(largest)]),
        "of_part": number(float(last["bound_parts"][largest]), 2),
        "distance": number(float(curve["reference_distance"].max()), 2),
    }


def _short_case(path: Path) -> dict[str, str]:
    made = json.loads(path.read_text(encoding="utf-8"))
    return {
        "sites": number(len(made["initial"][0])),
        "steps": number(len(made["steps"])),
        "end": number(float(Fraction(made["end_time"]))),
        "bound": _upward(made["steps"][-1]["bound"] / 2 ** made["bound_bits"]),
    }
