"""What is measured of runs on infinite chains: growth of the norms, the fronts, the states behind.

Where the chain at rest is unstable, a front moves at the speed v_1 of linear spreading. Behind it
A = -B, up to a second front, whose speed is v_2. With the powers P' between the fronts and P behind
the second one the norm is l2 = (2 (v_2 P + (v_1 - v_2) P') tau)^(1/2).
"""

from collections.abc import Iterator, Mapping
from itertools import pairwise

import numpy as np
import xarray as xr
from latticode.datasets.netcdf import Variable, as_xarray
from latticode.datasets.registry import NAMES
from latticode.datasets.stated import shared_by
from latticode.measures.confidence import mean_limits
from latticode.measures.growth import local_exponents
from latticode.measures.spreading import lay_line
from latticode.numerics.elementary import geometric, interpolated, log

from .active_sites import LEVEL
from .bulk import (
    BEHIND,
    BETWEEN,
    CELL,
    FIRST_OF_LINE,
    KINDS,
    POWER,
    law_of,
    mean_powers,
    slope_ratios,
    thermal_powers,
)
from .extremes import mean_maximum
from .front import PIECE_TAU, PREDICTED_SPEED, SITE_OF_FRONT

SETTLED = 1 / 3
"""The part of a run that is left out: at first the speed is below the one it tends to."""

SHOWN = 4.0
"""The Omega whose fronts are shown in space and time."""


def measure(
    runs: Mapping[str, xr.Dataset], omegas: xr.Dataset, transverse: xr.Dataset, thermal: xr.Dataset
) -> Iterator[xr.Dataset]:
    """Yield the growth of `runs`, which are by case, and the fronts of `omegas`, runs over Omega.

    `transverse` has the predicted speed of the second front, `thermal` the states that those behind
    the fronts are compared with.
    """
    yield measure_growth(runs, thermal, transverse)
    yield measure_fronts(omegas, transverse, thermal)


# --- Growth ---------------------------------------------------------------------------------------

POINTS, OCTAVES = 120, 4
"""Times of a series, equally spaced in log tau; the last octaves of time with an exponent each."""
BAND = ("lowest", "mean", "highest")
"""What is kept of a norm over the members of an ensemble."""
FIRST, SPANS = 10.0, 16
"""Where the comparison with the law begins, and its spans, equally long in log tau."""


def measure_growth(
    runs: Mapping[str, xr.Dataset], thermal: xr.Dataset, transverse: xr.Dataset
) -> xr.Dataset:
    """Return series, exponents and laws of the ensembles in `runs`, by case.

    `runs` are datasets of `long_runs.run_variables`, and the first variant of each is measured.
    `thermal` and `transverse` hold the powers of the thermal states and the speeds of the second
    front that the law takes. All values are dimensionless.
    """
    first = [run.isel(variant=0) for run in runs.values()]
    laws = [
        law_of(run, thermal, transverse)[0] if _is_of(thermal, run) else np.nan * run["tau"].values
        for run in runs.values()
    ]
    found = [
        _growth_of(run, thermal) | _rates_of(run, law) for run, law in zip(first, laws, strict=True)
    ]
    variables = {
        "case": Variable(("case",), list(runs)),
        "band": Variable(("band",), list(BAND), "value over the members of the ensemble"),
    }
    for name, (along, _, long_name, *_) in found[0].items():
        values = [one[name].values for one in found]
        variables[name] = Variable(("case", *along), values, long_name)
    shared = shared_by([run.attrs for run in first])
    return as_xarray(variables, {**shared, "title": "Growth of the norms on infinite chains"})


def _growth_of(run: xr.Dataset, thermal: xr.Dataset) -> dict[str, Variable]:
    """Return the series of one ensemble and its last exponents."""
    tau = run["tau"].values
    norms = {name: run[name].transpose("member", "tau").values for name in ("l2", "linf")}
    times = geometric(1.0, float(tau[-1]), POINTS)
    series = {
        name: _band(np.array([interpolated(times, tau, one) for one in values]))
        for name, values in norms.items()
    }
    middles, fits = local_exponents(tau, norms["l2"], OCTAVES)
    exponents, errors = np.array([fit.value for fit in fits]), _known([fit.half for fit in fits])
    equilibrium = np.full(len(times), np.nan)
    if _is_of(thermal, run) and abs(float(run["omega"] - thermal["bound_omega"])) <= 1e-9:
        reached = float(run["predicted_speed"]) * times - float(run["predicted_delay"]) * log(times)
        equilibrium = mean_maximum(thermal, np.maximum(1.0, reached))
    both, octave = "of A and B together", ("octave",)
    of_error = "95 % limits of the exponent of tau in l2 by Student's t, to each side"
    at_rest = "mean of the l-infinity norm where all sites behind the front are in equilibrium"
    return {
        "omega": Variable((), float(run["omega"])),
        "initial": Variable((), str(run.attrs["initial"])),
        "tau": Variable(("point",), times),
        "l2": Variable(("band", "point"), series["l2"], f"{NAMES['l2']}, {both}"),
        "linf": Variable(("band", "point"), series["linf"], f"{NAMES['linf']}, {both}"),
        "octave_tau": Variable(octave, middles, "middle of an octave of tau"),
        "l2_exponent": Variable(octave, exponents, "exponent of tau in l2"),
        "l2_exponent_error": Variable(octave, errors, of_error),
        "thermal_linf": Variable(("point",), equilibrium, at_rest),
    }


def _rates_of(run: xr.Dataset, law: np.ndarray) -> dict[str, Variable]:
    """Return l2^2 / tau over spans of time, and its law (tau,), in which no constant is fitted.

    Where the law begins is not known, so that an offset of l2^2 is fitted beside it.
    """
    tau, squares = run["tau"].values, run["l2"].transpose("member", "tau").values ** 2
    edges = geometric(FIRST, float(tau[-1]), SPANS + 1)
    spans = [(tau >= a) & (tau <= b) for a, b in pairwise(edges)]
    means = np.array([(squares[:, span] / tau[span]).mean(axis=1) for span in spans]).T
    late = tau >= FIRST_OF_LINE * tau[-1]
    offset = (squares.mean(axis=0) - law)[late].mean()
    law_rates = np.array([(law[span] / tau[span]).mean() for span in spans])
    offsets = np.array([offset * (1.0 / tau[span]).mean() for span in spans])
    along, of = ("span",), "l2^2 / tau, mean over a span of time"
    limits = f"half of the 95 % limits of the mean {of}"
    return {
        "span_tau": Variable(along, np.sqrt(edges[:-1] * edges[1:]), "middle of a span of tau"),
        "l2_rate": Variable(("band", "span"), _band(means), of),
        "rate_limits": Variable(along, _known(mean_limits(means).half), limits),
        "law_rate": Variable(along, law_rates, f"{of}, by thermal states and predicted fronts"),
        "offset_rate": Variable(along, offsets, "b / tau, with the offset b of l2^2 fitted"),
    }


def _is_of(thermal: xr.Dataset, run: xr.Dataset) -> bool:
    """Return whether thermal states over Omega were solved for the other constants of a run."""
    return all(thermal.attrs[name] == run.attrs[name] for name in ("epsilon", "gamma"))


def _over_omega(values, long_name: str = "") -> Variable:
    missing = "; NaN: no second front" if np.isnan(np.asarray(values, dtype=float)).any() else ""
    return Variable(("omega",), values, f"{long_name}{missing}")


def _known(halves) -> np.ndarray:
    """Return limits, and NaN in place of the infinite ones of a single member."""
    return np.where(np.isfinite(halves), halves, np.nan)


def _band(values: np.ndarray) -> np.ndarray:
    """Return the BAND of (member, ...) over the members."""
    return np.array([values.min(axis=0), values.mean(axis=0), values.max(axis=0)])


# --- The fronts, and the states behind them -------------------------------------------------------


def resolution(tau: np.ndarray) -> float:
    """Return how well the speed of a front can be known from its places at `tau`.

    A front lies between two sites, and waves at its edge move it to and fro between them. Places
    that are off by half a site either way change the slope of least squares by at most 3/2 sites
    over the time of the fit. All members of an ensemble have one front, so they make it no better.
    """
    return 1.5 / ((1.0 - SETTLED) * float(tau[-1]))


def speeds(run, corrected: bool = False, name: str = "front") -> tuple[np.ndarray, np.ndarray]:
    """Return the speeds of each variant of a dataset of runs, mean over members, and their limits.

    A speed is the slope of the front's site over time, of the late part of a run. `corrected` adds
    back what a pulled front loses on its way. The limits are those of the mean by Student's t, and
    no less than the `resolution`.
    """
    tau = run["piece_tau"].values
    way = run[name].transpose("variant", "member", "piece_tau").values
    if corrected:
        delay, rest = (run[f"predicted_{name}"].values[:, None, None] for name in ("delay", "rest"))
        way = way + delay * log(tau) + rest / np.sqrt(tau)
    late = tau >= SETTLED * tau[-1]
    found = [[lay_line(tau[late], one[late]).slope for one in members] for members in way]
    limits = mean_limits(np.transpose(found))
    half = np.where(np.isfinite(limits.half), limits.half, 0.0)
    return limits.value, np.maximum(half, resolution(tau))


def second_speeds(run) -> tuple[np.ndarray, np.ndarray]:
    """Return the same of the second front, NaN where |S|^2 behind it has not reached LEVEL."""
    filled = mean_powers(run, BEHIND, KINDS[1]).mean(axis=1) > LEVEL
    return tuple(np.where(filled, one, np.nan) for one in speeds(run, name="second_front"))


def measure_fronts(omegas: xr.Dataset, transverse: xr.Dataset, thermal: xr.Dataset) -> xr.Dataset:
    """Return speeds and powers over Omega, profiles at the end, and one run in space and time."""
    omega, about = omegas["omega"].values, "half of the 95 % limits of that"
    law = slope_ratios(omegas, law_of(omegas, thermal, transverse))
    (first, first_error), (second, second_error) = speeds(omegas), second_speeds(omegas)
    formed = np.where(np.isfinite(second), 1.0, np.nan)
    behind = mean_limits((mean_powers(omegas, BEHIND) * formed[:, None]).T)
    between = mean_limits(mean_powers(omegas, BETWEEN).T)
    known = transverse.reindex(omega=omega, method="nearest", tolerance=1e-9)
    states = [thermal_powers(thermal, omega, f"{of}power") for of in ("", "antisymmetric_")]
    of_speed = "in sites per unit of tau"
    alone = "in the thermal state of the chain with A = -B"
    energies = [mean_powers(omegas, one, "H").mean(axis=1) for one in (BEHIND, BETWEEN)]
    over_omega = {
        "omega": (omega,),
        "front_speed": (first, f"speed of the first front, {of_speed}"),
        "front_speed_error": (first_error, f"{about}, or what the places of the front resolve"),
        "linear_speed": (omegas["predicted_speed"].values, PREDICTED_SPEED),
        "second_front_speed": (second, f"speed of the second front, {of_speed}"),
        "second_front_speed_error": (second_error, about),
        "predicted_second_speed": (
            known["second_speed"].values, "speed at which a small A + B spreads on A = -B"
        ),
        "predicted_second_speed_error": (known["second_speed_error"].values, about),
        "transverse_exponent": (
            known["exponent"].values.max(axis=1), "largest exponent of a small A + B on A = -B"
        ),
        "power_behind": (behind.value, f"{POWER} {BEHIND}"),
        "power_behind_error": (_known(behind.half), about),
        "power_between": (between.value, f"{POWER} {BETWEEN}"),
        "power_between_error": (_known(between.half), about),
        "energy_behind": (energies[0] * formed, f"energy H of a pair, its mean {BEHIND}"),
        "energy_between": (energies[1], f"energy H of a pair, its mean {BETWEEN}"),
        "thermal_power": (states[0], f"{POWER} in the thermal state"),
        "thermal_antisymmetric_power": (states[1], f"{POWER} {alone}"),
        "slope_ratio": (
            [one.value for one in law], "slope of l2^2 over that of its law, in which nothing fits"
        ),
        "slope_ratio_error": ([one.half for one in law], about),
    }  # fmt: skip
    variables = {
        **{name: _over_omega(*given) for name, given in over_omega.items()},
        **_profiles(omegas),
        **_in_time(omegas.isel(variant=int(np.abs(omega - SHOWN).argmin()))),
    }
    title = "The two fronts on infinite chains, and the states behind them"
    return as_xarray(variables, {**omegas.attrs, "title": title})


def _profiles(omegas: xr.Dataset) -> dict[str, Variable]:
    """Return |S|^2 and |D|^2 at the end against the distance from the first front."""
    ends = omegas["front"].isel(member=0, piece_tau=-1).values
    count = max(1, int(ends.max()) // CELL)
    found = {}
    for sign, name in (("+", "symmetric_power"), ("-", "antisymmetric_power")):
        values = np.full((len(ends), count), np.nan)
        for row, end, cells in zip(values, ends, omegas[name].isel(piece_tau=-1), strict=True):
            behind = cells.values[: max(0, int(end) // CELL)][::-1]
            row[: behind.size] = behind
        long_name = f"|A_n {sign} B_n|^2 / 2 at the end, mean over {CELL} sites; NaN: ahead"
        found[f"{name}_behind_front"] = Variable(("omega", "distance"), values, long_name)
    distance = CELL * (np.arange(count) + 0.5)
    of_distance = "distance from the first front backwards, in sites"
    return found | {"distance": Variable(("distance",), distance, of_distance)}


def _in_time(run: xr.Dataset) -> dict[str, Variable]:
    """Return |S|^2 and |D|^2 of one run in space and time, with the places of its fronts."""
    one = run.isel(member=0)
    sites = CELL * (np.arange(one.sizes["cell"]) + 0.5)
    axes = ("piece_tau", "cell_site")
    return {
        "piece_tau": Variable(("piece_tau",), one["piece_tau"].values, PIECE_TAU),
        "cell_site": Variable(("cell_site",), sites, "site in the middle of a cell"),
        "shown_omega": Variable((), float(one["omega"]), "detuning Omega of the run in time"),
        **{
            name: Variable(axes, one[name].values, one[name].attrs["long_name"])
            for name in ("symmetric_power", "antisymmetric_power")
        },
        **{
            f"{name}_site": Variable(("piece_tau",), one[name].values, f"{SITE_OF_FRONT}{more}")
            for name, more in (("front", ""), ("second_front", ", second one"))
        },
    }
