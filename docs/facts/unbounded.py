"""Facts on chains without ends, and on the growth of the norms there."""

import xarray as xr
from pendula.report.words import number, percent, span

from .baseline import Baseline
from .words import with_stored_error

GROWN = 2.0
"""A norm grows if it grows by this factor, as the ledger has it."""


SITE = 0.05
"""A part of a site that no front can show."""


def unbounded(baseline: Baseline) -> dict:
    """Return exponents, fronts and powers of the long study of the chain without ends."""
    long = baseline["quoted/unbounded"]
    return {
        **_growth(long),
        **_thermal(long),
        **_omegas(long),
        **_large_data(long),
        **_maxima(long),
        **_tolerances(long),
        **_cut(baseline["quoted/cut_front"]),
        **_costs(baseline["speed/cost"]),
    }


def _growth(long: xr.Dataset) -> dict[str, str]:
    """Return the law by which the norms of Fig 4's data grow, and how it was measured."""
    bulk = long.sel(case="fig4_small")
    return {
        "end": number(bulk["end"], 4),
        "from": number(bulk["end"] / 4, 4),
        "members": str(int(bulk["members"])),
        "sites": f"{int(bulk['sites']):,}",
        "exponent": with_stored_error(bulk, "exponent"),
        "linf": number(bulk["linf"]),
        "speed": with_stored_error(bulk, "speed"),
        "predicted": number(bulk["predicted_speed"], 5),
        "bulk_power": with_stored_error(bulk, "bulk_power"),
        "slope_power": with_stored_error(bulk, "slope_power"),
        "small_growth": with_stored_error(long.sel(case="fig3_small"), "growth"),
        "stable_growth": with_stored_error(long.sel(case="fig2_large"), "growth"),
        "grown": number(GROWN),
    }


def _thermal(long: xr.Dataset) -> dict[str, str]:
    """Return how the power behind the front is that of thermal states."""
    bulk, large = (long.sel(case=case) for case in ("fig4_small", "fig3_large"))
    centre = long.sel(varied_omega=0.0)
    missed = abs(float(bulk["bulk_power"]) - float(centre["omega_thermal_power"]))
    return {
        "bulk_off": percent(missed / float(centre["omega_thermal_power"])),
        "bulk_limits": percent(float(bulk["bulk_power_error"] / bulk["bulk_power"])),
        "thermal_power": number(centre["omega_thermal_power"], 5),
        "centre_length": number(centre["omega_correlation_length"], 2),
        "warm_energy": with_stored_error(long, "warm_energy"),
        "warm_bulk_power": with_stored_error(large, "bulk_power"),
        "warm_power": number(long["warm_power"], 4),
        "cold_power": number(long["cold_power"], 4),
    }


def _omegas(long: xr.Dataset) -> dict[str, str]:
    """Return how fronts and powers follow Omega, and where thermal states miss the powers."""
    ratio = long["omega_bulk_power"] / long["omega_thermal_power"]
    furthest = long.isel(varied_omega=int(abs(ratio - 1.0).values.argmax()))
    off = abs(long["omega_bulk_power"] - long["omega_thermal_power"])
    apart = long["varied_omega"].where(off > long["omega_bulk_power_error"], drop=True)
    speeds = abs(long["omega_speed"] / long["omega_predicted_speed"] - 1.0)
    agree = abs(long["omega_speed"] - long["omega_predicted_speed"]) <= long["omega_speed_error"]
    return {
        "omegas": str(long.sizes["varied_omega"]),
        "least_omega": number(long["varied_omega"].min()),
        "largest_omega": number(long["varied_omega"].max()),
        "omega_end": number(long["omega_end"]),
        "omega_from": number(long["omega_end"] / 4),
        "omega_exponents": span(long["omega_exponent"].values, 2),
        "omega_speeds": number(speeds.max(), 2),
        "told_apart": ", ".join(map(number, apart.values)) or "none of them",
        "speeds_agree": "agree within it" if agree.all() else "do not all agree within it",
        "resolution": number((long["omega_speed_error"] / long["omega_speed"]).max(), 2),
        "furthest": percent(abs(ratio - 1.0).max()),
        "furthest_omega": number(furthest["varied_omega"]),
        "furthest_length": number(furthest["omega_correlation_length"], 2),
    }


def _large_data(long: xr.Dataset) -> dict[str, str]:
    """Return which large amplitudes spread, and how the large data of Fig 3 do."""
    large = long.sel(case="fig3_large")
    grown = long["amplitude"].where(long["amplitude_factor"] > GROWN, drop=True)
    return {
        "amplitudes": str(long.sizes["amplitude"]),
        "spreading": " and ".join(number(size) for size in grown.values),
        "amplitude_end": number(long["amplitude_end"]),
        "large_speed": number(large["speed"], 2),
        "large_exponent": with_stored_error(large, "exponent"),
        "large_from": number(large["end"] / 4, 4),
        "large_end": number(large["end"], 4),
    }


def _maxima(long: xr.Dataset) -> dict[str, str]:
    """Return the largest moduli of neighbours and l-infinity, beside those of the thermal state."""
    last = long.isel(block=-1)
    return {
        "neighbours": str(int(last["block_size"])),
        "block_maximum": number(last["block_maximum"], 4),
        "block_thermal": number(last["block_thermal"], 4),
        "block_low": number(long["block_low"]),
        "block_high": number(long["block_high"], 4),
        "extremal_index": number(long["extremal_index"], 4),
        "norm_ratio": with_stored_error(long, "norm_ratio"),
        "norm_ahead": number(long["norm_ahead"]),
        "norm_tau": number(long["norm_tau"]),
    }


def _tolerances(long: xr.Dataset) -> dict[str, str]:
    """Return the powers at other tolerances, and below which size a site counts as resting."""
    powers = (
        with_stored_error(long.isel({"tolerance": i}), "tolerance_bulk_power")
        + f" at {number(tolerance)}"
        for i, tolerance in enumerate(long["tolerance"].values)
    )
    return {"tolerances": ", ".join(powers), "rest": number(long.attrs["rest"])}


def _cut(cut: xr.Dataset) -> dict[str, str]:
    """Return how far a front lags that is computed without the smallest amplitudes."""
    return {
        "cut": number(cut.attrs["cut"]),
        "cut_lag": number(cut["lag"][-1], 2),
        "cut_end": number(cut["end"][-1], 4),
        "uncut_end": number(cut["end"].where(abs(cut["lag"]) < SITE).max(), 4),
    }


def _costs(cost: xr.Dataset) -> dict:
    """Return the memory and the time that a site takes which takes part in the motion."""
    seconds = cost["active_seconds"]
    pairs = zip(cost["active_width"].values, seconds.values, strict=True)
    return {
        "site_memory": number(cost["active_memory"][-1]),
        "site_factor": number(seconds.max() / seconds.min(), 2),
        "site_times": [
            {"width": f"{int(width):,}", "time": number(1e6 * each)} for width, each in pairs
        ],
    }
