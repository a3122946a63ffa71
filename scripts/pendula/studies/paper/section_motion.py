"""Where the chain moves: pictures of space and time, and one run to be played on the page."""

import base64
from typing import Any

import numpy as np

from pendula.report.numbers import measured, number
from pendula.report.results import Results
from pendula.report.words import case_in_words, case_of

PLAYED = "fig4_small"
"""The case that the page plays: small data that fill the chain."""
LEVELS = 255
MOVING = 0.5
"""Part of the largest modulus above which a site counts as moving, in the words for a picture."""


def gather(results: Results) -> dict[str, Any]:
    """Return the pictures beside Figs 2 to 4 and the run to play."""
    return {
        "pictures": [_spacetime(results, which) for which in (2, 3, 4)],
        "played": played(results, f"trajectories/{PLAYED}"),
    }


def _spacetime(results: Results, which: int):
    source = f"figures/fig{which}_spacetime"
    data = results[source]
    sizes = [data.sel(amplitude=size) for size in data["amplitude"].values]
    told = "; ".join(f"{case_of(size)}: {_in_words(size['modulus'])}" for size in sizes)
    alt = f"Moduli of A and B over sites and time. {told}."
    return {
        "number": which,
        "picture": results.picture(f"fig{which}_spacetime", alt),
        "told": [
            (case_of(size), *(results.say(source, n) for n in _in_numbers(size["modulus"])))
            for size in sizes
        ],
    }  # fmt: skip


def _moving(modulus) -> tuple[int, int, float]:
    """Return how many sites move at the end, at MOVING of the largest size, all, and that size."""
    last = modulus.isel(snapshot_tau=-1).max("component").values
    return int((last > MOVING * last.max()).sum()), len(last), float(last.max())


def _in_numbers(modulus) -> tuple[str, str, str]:
    moving, sites, largest = _moving(modulus)
    return str(moving), str(sites), measured(largest)


def _in_words(modulus) -> str:
    moving, sites, largest = _moving(modulus)
    return f"at the end {moving} of {sites} sites move at over half the largest size {largest:.3g}"


def played(results: Results, source: str) -> dict[str, Any]:
    """Return a run with its moduli in 256 steps, time after time, as the page's script reads it."""
    run = results[source]
    modulus = run["modulus"].transpose("snapshot", "component", "site").values
    peak = float(modulus.max())
    steps = np.rint(modulus * (LEVELS / peak)).astype(np.uint8)
    tau = run["snapshot_tau"].values
    still = half_way(modulus)
    return {
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
        "bars": [[round(float(v) / LEVELS, 3) for v in row] for row in steps[still]],
    }


def half_way(modulus: np.ndarray) -> int:
    """Return the first time at which half of the sites move, the last if there is none.

    `modulus` is (time, component, site); the picture of that time shows where the front is.
    """
    moving = (modulus.max(axis=1) > MOVING * modulus.max(axis=(1, 2))[:, None]).mean(axis=1)
    found = np.flatnonzero(moving >= 0.5)
    return int(found[0]) if found.size else len(modulus) - 1
