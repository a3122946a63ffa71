"""One case of one's own: its figures with words for those who cannot see them, and its checks."""

from pathlib import Path
from typing import Any

import numpy as np

from pendula.datasets.netcdf import read
from pendula.measures.difference import VISIBLE
from pendula.report.numbers import Quote, number, percent, with_error
from pendula.report.pictures import Picture, picture

from .words import parameters, quotes, solver

# ASSUME: a bound counts as broken where the norms exceed it by more than their own error, and by
# more than this.
SLACK = 1e-6


def gather(name: str, folder: Path) -> dict[str, Any]:
    """Return what the page shows of the case: numbers as quotes, and what they decide."""
    run, link = read(folder / f"trajectories/{name}.nc"), f"own/cases/{name}.checks.nc"
    checks = read(folder / link)
    return {
        "name": name,
        "run": f"trajectories/{name}.nc",
        "checks": link,
        "parameters": parameters(run.attrs),
        "norms": _norms(name, run, folder),
        "spacetime": _spacetime(name, run, folder),
        "second": solver(checks.attrs, "second"),
        "refusals": {
            key: str(checks.attrs.get(f"{key}_refusal", "")) for key in ("second", "sensitivity")
        },
        "level": percent(VISIBLE),
        "rounding_level": percent(VISIBLE),
        "divergence_time": float(checks["divergence_time"]),
        "said": _said(checks, link),
        **_decided(checks),
    }


def _said(checks, link: str) -> dict[str, Quote]:
    said = quotes(checks, link)
    if "exponent" in checks:
        rate = with_error(float(checks["exponent"]), float(checks["exponent_error"]))
        said["exponent"] = Quote(rate, link)
    return said | {
        key: Quote(number(checks.attrs[key]), link)
        for key in ("end_time", "gamma", "epsilon", "half_width")
    } | {"sites": Quote(number(2 * checks.attrs["half_width"] + 1, 8), link)}  # fmt: skip


def _decided(checks) -> dict[str, Any]:
    error = np.nan_to_num(float(checks["largest_difference"]))
    limit = 1.0 + max(SLACK, 4.0 * error)  # P is a square, and both its values may be off
    return {
        "at_rest": float(checks["start"]) == 0.0,
        "parts": bool(np.isfinite(checks["divergence_time"])),
        "chaotic": bool(checks.get("chaotic", 0)),
        "lost": bool(np.isfinite(checks.get("divergence_rounding", np.nan))),
        "region": str(checks["region"].values),
        "growth_holds": bool(checks["from_start"] <= limit),
        "bound_holds": bool(checks["ratio"] <= limit),
        "infinite_grows": bool(checks["infinite_rate"] > 0),
        "finite_grows": bool(checks["finite_rate"] > 0),
        "other_sign": float(checks.attrs["epsilon"]) < 0,
    }


def _norms(name: str, run, folder: Path) -> Picture:
    parts = []
    for norm, word in (("linf", "l-infinity"), ("l2", "l2")):
        for component in ("A", "B"):
            curve = run[norm].sel(component=component)
            first, top, last = (number(x) for x in (curve[0], curve.max(), curve[-1]))
            when = number(curve["tau"][int(np.argmax(curve.values))])
            parts.append(
                f"{word} of {component} starts at {first}, has its largest value {top} at {when} "
                f"and ends at {last}"
            )
    end = number(run["tau"][-1])
    alt = f"Norms of {name} against tau from 0 to {end}: {'; '.join(parts)}."
    link = f"own/cases/{name}.png"
    return picture(folder / link, alt, link)


def _spacetime(name: str, run, folder: Path) -> Picture:
    modulus = run["modulus"].max("component")
    site, when = (int(i) for i in np.unravel_index(int(np.argmax(modulus.values)), modulus.shape))
    link = f"own/cases/{name}.spacetime.png"
    alt = (
        f"Moduli of A and B of {name} over sites {run['site'].values[0]} to "
        f"{run['site'].values[-1]} and tau from 0 to {number(run['tau'][-1])}: the largest, "
        f"{number(modulus.max())}, on site {run['site'].values[site]} at "
        f"{number(run['snapshot_tau'][when])}."
    )
    return picture(folder / link, alt, link)
