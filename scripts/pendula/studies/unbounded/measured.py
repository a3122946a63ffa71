"""Numbers measured on infinite chains: speeds of fronts, powers behind them, and the law of l2.

If the chain at rest is unstable, a front moves at the speed v_1 of linear spreading. Behind it A =
-B, up to a second front, whose speed is v_2. With the powers P' between the fronts and P behind the
second one the norm is l2 = (2 (v_2 P + (v_1 - v_2) P') tau)^(1/2).

Energy is conserved and zero at rest, so the states behind the fronts have none on average. In
equilibrium they are distributed as exp(-beta H), and their energy fixes beta. Nothing is fitted.
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
"""Fraction of a run, at its start, that is left out of speeds, which approach their limits from
below."""

FIRST_OF_LINE = 0.25
"""The line through l2^2 starts at this fraction of a run."""


def mean_powers(
    run: xr.Dataset, region: str, kind: str = KINDS[0], late: float = LATE
) -> np.ndarray:
    """Return a mean over a region and the fraction `late` of a run, at its end, (variant, member).

    States in which the region has no sites are left out; it is NaN if there are no others.
    """
    tau, values = run["piece_tau"], run["region_mean"].sel(region=region, kind=kind)
    at_end = values.isel(piece_tau=np.flatnonzero(tau > (1.0 - late) * tau[-1]))
    return at_end.mean("piece_tau").transpose("variant", "member").values


def with_first_choices(run: xr.Dataset) -> xr.Dataset:
    """Return a run at the first of its levels and edges; short runs have only one of each."""
    return run.isel(level=0, edge=0, missing_dims="ignore")


# --- The fronts -----------------------------------------------------------------------------------


def resolution(tau: np.ndarray, settled: float = SETTLED) -> float:
    """Return the error of the speed of a front that follows from its places being whole sites.

    Places that are off by half a site in either direction change the slope of least squares by at
    most 3/2 sites over the time of the fit, equally in all members.
    """
    return 1.5 / ((1.0 - settled) * float(tau[-1]))


def speeds(run: xr.Dataset, settled: float = SETTLED) -> tuple[np.ndarray, np.ndarray]:
    """Return the speed of the first front of each variant, with limits.

    The delay of a pulled front is added back.
    """
    lost = run["predicted_delay"] * xr.DataArray(log(run["piece_tau"].values), dims="piece_tau")
    return _slopes(run, run["front"] + lost, settled)


def second_speeds(run: xr.Dataset, settled: float = SETTLED) -> tuple[np.ndarray, np.ndarray]:
    """Return the speed of the second front with its error, NaN if |S|^2 stays below LEVEL."""
    filled = mean_powers(run, BEHIND, KINDS[1]).mean(axis=1) > LEVEL
    slopes = level_speeds(run, settled)
    return tuple(np.where(filled, speeds, np.nan) for speeds in slopes)


def level_speeds(run: xr.Dataset, settled: float = SETTLED) -> tuple[np.ndarray, np.ndarray]:
    """Return the speed of the last site where |S|^2 has reached a level, NaN if there is none."""
    reached = (run["second_front"].isel(piece_tau=-1) >= 0.0).all("member").values
    slopes = _slopes(run, run["second_front"], settled)
    return tuple(np.where(reached, speeds, np.nan) for speeds in slopes)


def _slopes(run, way, settled: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the slope of a front's place over the late time, its mean over members, and limits.

    The limits are those of the mean by Student's t, and at least the `resolution`.
    """
    tau = run["piece_tau"].values
    late = tau >= settled * tau[-1]
    ways = way.transpose("variant", "member", "piece_tau").values[:, :, late]
    slopes = [[lay_line(tau[late], places).slope for places in members] for members in ways]
    limits = mean_limits(np.transpose(slopes))
    return limits.value, np.maximum(_known(limits.half, 0.0), resolution(tau, settled))


def _known(halves, otherwise: float = np.nan):
    """Return limits, with another value in place of infinite ones of a single member."""
    return np.where(np.isfinite(halves), halves, otherwise)


# --- The law of l2^2 ------------------------------------------------------------------------------


def thermal_powers(thermal: xr.Dataset, run: xr.Dataset, name: str = "power") -> np.ndarray:
    """Return P of the thermal states at each Omega of a run, (variant,), NaN if none was solved.

    That of A = -B has the name "antisymmetric_power".
    """
    return thermal[name].reindex(omega=run["omega"].values, method="nearest", tolerance=1e-9).values


def law_of(run: xr.Dataset, thermal: xr.Dataset, second: np.ndarray | None = None) -> np.ndarray:
    """Return l2^2 by thermal states and speeds of fronts, (variant, tau), without a fit.

    It is 2 (v_2 P + (v_1 - v_2) P') tau minus 2 P' delay ln tau, the delay of a pulled front; v_1
    is predicted, v_2 is `second` (variant,) if given, otherwise measured, and zero if no second
    front has formed. NaN if no front is pulled or no state was solved.
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
    """Return the slope of l2^2 over that of its law for each variant, with limits over the members.

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
    of_speed, limits = "in sites per unit of tau", "half of the 95 % limits of that"
    measured = {
        "omega": (omegas["omega"].values, ""),
        "front_speed": (first, f"speed of the first front with its delay added back, {of_speed}"),
        "front_speed_error": (
            first_error,
            f"{limits}, or what the places of the front resolve",
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
