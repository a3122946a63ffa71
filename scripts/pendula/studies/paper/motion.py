"""The report's part on the chain in motion: moduli over sites and time, and a run to play."""

import base64
from typing import Any

import numpy as np

from pendula.ledger.section import Ledger
from pendula.report.results import Results
from pendula.report.words import case_in_words, case_of, measured, number, percent

from .known import is_chaotic, trusted

SIZES = ("small", "large")

PLAYED = "fig4_small"
"""The case that the page plays: small data that fill the chain."""
STEPS = 255
MOVING = 0.5
"""Part of the largest modulus above which a site counts as moving, in the words for a picture."""


def gather_motion(results: Results, ledger: Ledger) -> dict[str, Any]:
    """Return the pictures beside Figs 2 to 4 and the run to play."""
    trust = results["checks/trust"]
    return {
        "pictures": [_spacetime(results, which) for which in (2, 3, 4)],
        "played": played(results, f"trajectories/{PLAYED}"),
        "visible": percent(float(trust["size"].sel(level="visible"))),
        "regular": [
            case_of(trust.sel(case=case))
            for case in map(str, trust["case"].values)
            if trusted(results, case).state == "off" and not is_chaotic(results, case)
        ],
        "unknown": [
            case_of(trust.sel(case=case))
            for case in map(str, trust["case"].values)
            if trusted(results, case).state == "unknown"
        ],
    }


def _spacetime(results: Results, which: int) -> dict[str, Any]:
    told, alts, omegas = [], [], {}
    for source in (f"trajectories/fig{which}_{size}" for size in SIZES):
        run = results[source]
        case = case_in_words(run.attrs["omega"], run.attrs["initial"])
        omegas.setdefault(float(run.attrs["omega"]), source)
        last = run["modulus"].isel(snapshot=-1).max("component").values
        numbers = (
            str(int((last > MOVING * last.max()).sum())),
            str(len(last)),
            measured(float(last.max())),
        )
        told.append((case, *(results.say(source, text) for text in numbers)))
        moving, sites, largest = numbers
        alts.append(
            f"{case}: at the end {moving} of {sites} sites move at over half the largest size "
            f"{largest}"
        )
    alt = f"Moduli of A and B over sites and time. {'; '.join(alts)}."
    return {
        "number": which,
        "picture": results.picture(f"fig{which}_spacetime", alt),
        "omegas": [results.quote(source, omega) for omega, source in omegas.items()],
        "told": told,
    }


def played(results: Results, source: str) -> dict[str, Any]:
    """Return a run with its moduli in 256 steps, time after time, as the page's script reads it."""
    run = results[source]
    modulus = run["modulus"].transpose("snapshot", "component", "site").values
    peak = float(modulus.max())
    steps = np.rint(modulus * (STEPS / peak)).astype(np.uint8)
    tau = run["snapshot_tau"].values
    half = half_way(modulus)
    still = len(modulus) - 1 if half is None else half
    return {
        "half": half is not None,
        "case": case_in_words(run.attrs["omega"], run.attrs["initial"]),
        "source": results.say(source, source),
        "frames": base64.b64encode(steps.tobytes()).decode(),
        "count": len(steps),
        "sites": [int(site) for site in run["site"].values],
        "first": number(int(run["site"][0])),
        "peak": results.quote(source, peak),
        "step": float(tau[1] - tau[0]),
        "end": results.quote(source, float(tau[-1])),
        "still": still,
        "still_tau": results.quote(source, float(tau[still])),
        "bars": [[round(float(v) / STEPS, 3) for v in row] for row in steps[still]],
    }


def half_way(modulus: np.ndarray) -> int | None:
    """Return the first time at which half of the sites move, None if there is none.

    `modulus` is (time, component, site); the picture of that time shows where the front is.
    """
    moving = (modulus.max(axis=1) > MOVING * modulus.max(axis=(1, 2))[:, None]).mean(axis=1)
    found = np.flatnonzero(moving >= 0.5)
    return int(found[0]) if found.size else None
