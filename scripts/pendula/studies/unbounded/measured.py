"""Numbers measured on infinite chains: speeds of fronts, powers behind them, and the law of l2.

If the chain at rest is unstable, a front moves at the speed v_1 of linear spreading. Behind it A =
-B, up to a second front with the speed v_2. With the powers P' between the fronts and P behind the
second one, l2^2 = 2 (v_2 P + (v_1 - v_2) P') tau.

Energy is conserved and zero at rest, so the states behind the fronts have zero energy on average.
In equilibrium they are distributed as exp(-beta H), and the energy determines beta without a fit.
The module `thermal` solves these states.
"""

import numpy as np
import xarray as xr
from latticode.datasets.netcdf import Variable, as_xarray
from latticode.measures.confidence import CONFIDENCE, ConfidenceInterval, mean_limits
from latticode.measures.spreading import fit_line, lay_line
from latticode.numerics.elementary import log
from replication.variables import REGULAR, SCATTERED, chaotic_along, missing

from .bulk import BEHIND, BETWEEN, KINDS, LEVEL, POWER, PREDICTED_SPEED

NO_FRONT, NO_SITES = missing("no second front has formed"), missing("the region has no sites")
NO_STATE = REGULAR | missing("no thermal state was solved")

LATE = 0.5
"""Fraction of a run, at its end, over which powers are averaged."""

SETTLED = 1 / 3
"""Fraction of a run, at its start, in which speeds are not measured, because they approach their
limits from below."""

FIRST_OF_LINE = 0.25
"""The line through l2^2 starts at this fraction of a run."""


def mean_powers(
    run: xr.Dataset, region: str, kind: str = KINDS[0], late: float = LATE
) -> np.ndarray:
    """Return a mean over a region and the last fraction `late` of a run, (variant, member).

    States in which the region has no sites are left out. The mean is NaN if no state is left.
    """
    tau, values = run["piece_tau"], run["region_mean"].sel(region=region, kind=kind)
    at_end = values.isel(piece_tau=np.flatnonzero(tau > (1.0 - late) * tau[-1]))
    return at_end.mean("piece_tau").transpose("variant", "member").values


def with_first_choices(run: xr.Dataset) -> xr.Dataset:
    """Return a run at the first of its levels and edges; short runs have only one of each."""
    return run.isel(level=0, edge=0, missing_dims="ignore")


# --- The fronts -----------------------------------------------------------------------------------


def resolution(tau: np.ndarray, settled: float = SETTLED) -> float:
    """Return the error of a front's speed because its sites are whole numbers.

    An error of half a site either way changes the slope of least squares by at most 3/2 sites over
    the time of the fit, equally in all members.
    """
    return 1.5 / ((1.0 - settled) * float(tau[-1]))


def speeds(run: xr.Dataset, settled: float = SETTLED) -> tuple[np.ndarray, np.ndarray]:
    """Return the speed of the first front of each variant, and its error.

    The speed is corrected for the predicted delay of a pulled front.
    """
    lost = run["predicted_delay"] * xr.DataArray(log(run["piece_tau"].values), dims="piece_tau")
    return _slopes(run, run["front"] + lost, settled)


def second_speeds(run: xr.Dataset, settled: float = SETTLED) -> tuple[np.ndarray, np.ndarray]:
    """Return the speed of the second front and its error, NaN if |S|^2 stays below LEVEL."""
    filled = mean_powers(run, BEHIND, KINDS[1]).mean(axis=1) > LEVEL
    slopes = level_speeds(run, settled)
    return tuple(np.where(filled, speeds, np.nan) for speeds in slopes)


def level_speeds(run: xr.Dataset, settled: float = SETTLED) -> tuple[np.ndarray, np.ndarray]:
    """Return the speed of the last site with |S|^2 above a level, and its error.

    Both are NaN if a member has no such site at the end.
    """
    reached = (run["second_front"].isel(piece_tau=-1) >= 0.0).all("member").values
    slopes = _slopes(run, run["second_front"], settled)
    return tuple(np.where(reached, speeds, np.nan) for speeds in slopes)


def _slopes(run: xr.Dataset, sites: xr.DataArray, settled: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the mean over members of the late slope of a front's sites, and its error, (variant,).

    The error is half of the confidence interval, and at least the `resolution`.
    """
    tau = run["piece_tau"].values
    late = tau >= settled * tau[-1]
    late_sites = sites.transpose("variant", "member", "piece_tau").values[:, :, late]
    slopes = [[lay_line(tau[late], series).slope for series in members] for members in late_sites]
    limits = mean_limits(np.transpose(slopes))
    return limits.value, np.maximum(_known(limits.half, 0.0), resolution(tau, settled))


def _known(halves: np.ndarray, otherwise: float = np.nan) -> np.ndarray:
    """Return halves of confidence intervals; `otherwise` replaces infinite ones of one member."""
    return np.where(np.isfinite(halves), halves, otherwise)


# --- The law of l2^2 ------------------------------------------------------------------------------


def thermal_powers(thermal: xr.Dataset, run: xr.Dataset, name: str = "power") -> np.ndarray:
    """Return P of the thermal states at each Omega of a run, (variant,), NaN if none was solved.

    For the states with A = -B, `name` is "antisymmetric_power".
    """
    return thermal[name].reindex(omega=run["omega"].values, method="nearest", tolerance=1e-9).values


def law_of(run: xr.Dataset, thermal: xr.Dataset, second: np.ndarray | None = None) -> np.ndarray:
    """Return l2^2 by thermal states and speeds of fronts, (variant, tau), without a fit.

    It is 2 (v_2 P + (v_1 - v_2) P') tau - 2 P' delay ln tau, with the delay of a pulled front and
    the predicted v_1. v_2 is `second` (variant,) if given, else measured, and zero if no second
    front has formed. The law is NaN without a front or without thermal states.
    """
    delay, first = run["predicted_delay"].values, run["predicted_speed"].values
    second = np.nan_to_num(second_speeds(run)[0] if second is None else second)
    both, alone = (thermal_powers(thermal, run, f"{of}power") for of in ("", "antisymmetric_"))
    rates = 2.0 * (second * both + (first - second) * alone)
    lost, tau = 2.0 * alone * delay, np.maximum(run["tau"].values, 1.0)
    law = rates[:, None] * tau - lost[:, None] * log(tau)
    return np.where(delay[:, None] > 0.0, law, np.nan)


def slope_ratios(
    run: xr.Dataset,
    thermal: xr.Dataset,
    confidence: float = CONFIDENCE,
    second: np.ndarray | None = None,
    first: float = FIRST_OF_LINE,
) -> list[ConfidenceInterval]:
    """Return the ratio of the slopes of l2^2 and of its law, with limits, for each variant.

    The time at which the law begins is unknown, so an offset is fitted. For `second` see `law_of`.
    """
    is_late = run["tau"].values >= first * float(run["tau"][-1])
    squares = run["l2"].transpose("variant", "member", "tau").values[:, :, is_late] ** 2
    return [
        fit_line(law, curves, law[0], confidence).slope
        if np.isfinite(law).all()
        else ConfidenceInterval(np.nan, np.nan, np.nan)
        for law, curves in zip(law_of(run, thermal, second)[:, is_late], squares, strict=True)
    ]


# --- The dataset ----------------------------------------------------------------------------------


def measure_fronts(omegas: xr.Dataset, thermal: xr.Dataset) -> xr.Dataset:
    """Return the dataset of speeds of fronts and powers behind them, measured and predicted."""
    omegas = with_first_choices(omegas)
    (first, first_error), (second, second_error) = speeds(omegas), second_speeds(omegas)
    formed = np.where(np.isfinite(second), 1.0, np.nan)
    behind = mean_limits((mean_powers(omegas, BEHIND) * formed[:, None]).T)
    between = mean_limits(mean_powers(omegas, BETWEEN).T)
    of_speed, limits = "in sites per unit of tau", "half of the 95 % confidence interval"
    measured = {
        "omega": (omegas["omega"].values, ""),
        "front_speed": (first, f"speed of the first front, corrected for its delay, {of_speed}"),
        "front_speed_error": (
            first_error,
            f"{limits}, or the resolution by whole sites",
            SCATTERED,
        ),
        "linear_speed": (omegas["predicted_speed"].values, PREDICTED_SPEED, REGULAR),
        "second_front_speed": (second, f"speed of the second front, {of_speed}", NO_FRONT),
        "second_front_speed_error": (second_error, limits, NO_FRONT | SCATTERED),
        "power_behind": (behind.value, f"{POWER} {BEHIND}", NO_FRONT),
        "power_behind_error": (_known(behind.half), limits, NO_FRONT | SCATTERED),
        "power_between": (between.value, f"{POWER} {BETWEEN}", NO_SITES),
        "power_between_error": (_known(between.half), limits, NO_SITES | SCATTERED),
        "thermal_power": (
            thermal_powers(thermal, omegas),
            f"{POWER} in the thermal state",
            NO_STATE,
        ),
        "thermal_antisymmetric_power": (
            thermal_powers(thermal, omegas, "antisymmetric_power"),
            f"{POWER} in the thermal state of the chain with A = -B",
            NO_STATE,
        ),
    }
    variables = {
        name: Variable(("omega",), values, long_name, attributes=dict(*attributes))
        for name, (values, long_name, *attributes) in measured.items()
    }
    title = "The two fronts on infinite chains, and the states behind them"
    return as_xarray(variables, {**omegas.attrs, "title": title, **chaotic_along("omega")})
