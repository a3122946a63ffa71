"""Facts on breathers, on the sensitivity to the data, and on the fates of data on one pair."""

import numpy as np
import xarray as xr
from pendula.report.words import number, percent
from pendula.studies.breathers.claims import DATA_POWER, OF_PAPER
from pendula.studies.breathers.fate_contents import LONGEST
from pendula.studies.breathers.nearest import HALF_PERIODS, NEAR, WAVES
from pendula.studies.breathers.section import share_with_limits

from .baseline import Baseline
from .words import from_to


def breathers(baseline: Baseline) -> dict:
    """Return what the claims on breathers measured, and the shares of runs that spread."""
    rows = {row["name"]: row["measured"] for row in baseline.claims()}
    growth, spread = baseline["breathers/growth"], baseline["breathers/sensitivity"]
    law, scanned = rows["grows_by_drive"], spread["initial"].values
    return {
        "omega": number(spread.attrs["omega"]),
        **_least_power(baseline["breathers/periodic"], DATA_POWER),
        "collisions": _collisions(baseline["breathers/periodic"]),
        "weak": number(growth["gamma"].min()),
        "off": percent(law["largest_difference"]),
        "strong": number(law["strongest"]),
        "passed": number(law["passed_by"]),
        "scanned": str(len(scanned)),
        "spread": percent(rows["spreading_is_an_accident"]["of_the_scan"]),
        "first": number(scanned.min()),
        "last": number(scanned.max()),
        "step": number(scanned[1] - scanned[0]),
        "end": number(spread.attrs["end_time"]),
        "members": str(int(spread.attrs["members"])),
        "rows": [
            {
                "size": number(size),
                "share": percent(spread["share"].sel(size=size)),
                "limits": from_to(spread["share_low"], spread["share_high"], size=size),
            }
            for size in spread["size"].values
        ],
    }


def _least_power(periodic: xr.Dataset, data_power: float) -> dict[str, str]:
    """Return the least P of breathers at two instants of their period, and where it is that."""
    family = periodic.sel(omega=OF_PAPER, family="A only")
    frequency = family["least_power_frequency"].values
    real, imaginary = family["least_power"].values
    return {
        "data_power": number(data_power),
        "least_largest": number(real, 4),
        "at_largest": number(frequency[0]),
        "least": number(imaginary, 4),
        "at_least": number(frequency[1]),
    }


def _collisions(periodic: xr.Dataset) -> dict[str, str]:
    """Return the number of collisions of multipliers by kind, their frequencies and signatures."""
    frequency = periodic["collision_frequency"]
    met = np.isfinite(frequency)
    quartets = int((met & (periodic["collision_multiplier"].sel(part="im") > 0.0)).sum())
    product = periodic["collision_signature"].astype(float).prod("colliding").where(met)
    omegas = periodic["omega"].where(met.any([name for name in met.dims if name != "omega"]))
    return {
        "count": str(int(met.sum())),
        "omegas": ", ".join(number(omega) for omega in omegas.dropna("omega").values),
        "first": number(frequency.min(), 4),
        "last": number(frequency.max(), 4),
        "pairs": str(int(met.sum()) - quartets),
        "quartets": str(quartets),
        "signatures": "opposite" if (product.max() < 0.0) else "not always opposite",
    }


def fates(baseline: Baseline) -> dict:
    """Return shares of fates, and of runs that spread, from the long study of breathers."""
    long = baseline["quoted/breathers"]
    start = long["from_amplitude"].values
    return {
        "end": number(long.attrs["end_time"]),
        "members": number(long.attrs["members"]),
        "points": number(long.attrs["points"]),
        "spread": ", ".join(
            f"{percent(long['share'].sel(size=size))} at {number(size)}"
            for size in long["size"].values
        ),
        "scanned": number(long["scanned"]),
        "scan": ", ".join(
            f"{percent(part)} between {number(a)} and {number(a + 1)}"
            for a, part in zip(start, long["scan_share"].values, strict=True)
        ),
        "largest": number(long["largest_that_spreads"], 4),
        "rows": [
            {"omega": number(omega), "cases": OF_PLANE[str(plane)]}
            | {str(fate): _area(long, plane, omega, fate) for fate in long["fate_name"].values}
            for plane in long["plane"].values
            for omega in long["omega"].values
        ],
        "periodic": [
            {
                "omega": number(one["omega"]),
                "share": percent(one["periodic_share"]),
                "less": percent(one["periodic_if_less"]),
                "more": percent(one["periodic_if_more"]),
                "unknown": percent(one["unknown_share"]) if one["unknown_share"] else "",
                "alone": percent(one["alone"]),
                "near": percent(one["near"]),
                "median": number(one["median_distance"], 2),
            }
            for omega in long["omega"].values
            for one in [long.sel(omega=omega)]
            if np.isfinite(one["near"])
        ],
        "half_periods": number(HALF_PERIODS),
        "waves": number(WAVES),
        "less_waves": number(WAVES / long.attrs["margin"]),
        "more_waves": number(WAVES * long.attrs["margin"]),
        "within": percent(NEAR),
        "stay": number(long["stay"]),
        "stay_on": number(long["stay_on"].sel(conditions=LONGEST)),
        "longest": number(long["longest"]),
        "common": number(baseline["breathers/fates"]["common"].sum()),
        "agreed": number(baseline["breathers/fates"]["agreed"].sum()),
        "checked": number(long["checked"]),
        "terms": [
            {
                "cases": str(terms),
                "changed": percent(long["changed"].sel(conditions=terms).max()),
                "stays": percent(_at_most_mixed(long, terms, "stays")),
                "spreads": percent(_at_most_mixed(long, terms, "spreads")),
            }
            for terms in long["conditions"].values
        ],
        "mixed": number(_most_mixed(long)),
        "mixed_are": "most runs that stay are"
        if long["periodic_share"].sel(omega=_most_mixed(long)) > 0.5
        else "most runs that stay are not",
    }


OF_PLANE = {"amplitudes": "real A_0 and B_0", "phases": "A_0 and the phase of B_0"}


def _area(long: xr.Dataset, plane: str, omega: float, fate: str) -> str:
    """Return the share of an area in per cent with its limits."""
    return share_with_limits(long.sel(plane=plane, omega=omega, fate_name=fate))


def _most_mixed(long: xr.Dataset) -> float:
    """Return the Omega at which other terms change the most fates."""
    return float(long["omega"][int(long["changed"].max("conditions").argmax("omega"))])


def _at_most_mixed(long: xr.Dataset, terms: str, fate: str) -> float:
    at = {"fate_name": fate, "conditions": terms, "omega": _most_mixed(long)}
    return float(long["terms_share"].sel(at))
