"""Where the chain moves: pictures of space and time, and one run to be played on the page."""

import base64
from typing import Any

import numpy as np

from .numbers import number
from .results import Results
from .words import case_in_words, case_of

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
    told = "; ".join(f"{case_of(size)}: {_spread(size['modulus'])}" for size in sizes)
    alt = f"Moduli of A and B over sites and time. {told}."
    return {
        "number": which,
        "picture": results.picture(f"fig{which}_spacetime", alt),
        "told": [
            (case_of(size), results.say(source, _spread(size["modulus"]))) for size in sizes
        ],
    }  # fmt: skip


def _spread(modulus) -> str:
    """Return in words how much of the chain moves at the end."""
    last = modulus.isel(snapshot_tau=-1).max("component")
    moving = last["site"].values[last.values > MOVING * float(last.max())]
    share = f"{len(moving)} of {last.sizes['site']} sites move at more than half the largest size"
    return f"{share}, which is {number(float(last.max()))}"


def played(results: Results, source: str) -> dict[str, Any]:
    """Return a run with its moduli in 256 steps, time after time, as the page's script reads it."""
    run = results[source]
    modulus = run["modulus"].transpose("snapshot", "component", "site").values
    peak = float(modulus.max())
    steps = np.rint(modulus * (LEVELS / peak)).astype(np.uint8)
    tau = run["snapshot_tau"].values
    return {
        "case": case_in_words(run.attrs["omega"], run.attrs["initial"]),
        "source": results.say(source, source),
        "frames": base64.b64encode(steps.tobytes()).decode(),
        "count": len(steps),
        "sites": [int(site) for site in run["site"].values],
        "peak": results.quote(source, peak),
        "step": float(tau[1] - tau[0]),
        "end": results.quote(source, float(tau[-1])),
        "last": [[round(float(v) / LEVELS, 3) for v in row] for row in steps[-1]],
    }
