"""The numbers of long runs on infinite chains, each measured again with its choices changed.

The long study is run at two tolerances. Its other choices belong to the measurement: the fraction
of a run that is used or fitted, the level of the second front, and the number of sites behind the
first front that do not count as between the fronts.
"""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import xarray as xr
from latticode.measures.confidence import ConfidenceInterval, mean_limits
from latticode.measures.spreading import fit_exponent, lay_line
from latticode.numerics.elementary import log

from pendula.varied import Estimate, NamedNumber, VariedNumber, as_dataset, names_of, vary

from .bulk import BEHIND, BETWEEN, POWER, PREDICTED_SPEED
from .measured import (
    FIRST_OF_LINE,
    LATE,
    SETTLED,
    level_speeds,
    mean_powers,
    second_speeds,
    slope_ratios,
    speeds,
    thermal_powers,
)
from .noise import ROUNDING

OCTAVES = 2
"""Octaves of time at the end of a run over which exponents are fitted."""
FRACTIONS, PREDICTED = [1.0, 0.5], ["predicted", "measured"]
SPEED = "in sites per unit of tau"
ROUNDING_ERROR = 2.0**-53


def vary_numbers(
    omegas: xr.Dataset,
    omegas_coarse: xr.Dataset,
    large: xr.Dataset,
    large_coarse: xr.Dataset,
    thermal: xr.Dataset,
    transverse: xr.Dataset,
    noise: xr.Dataset,
) -> xr.Dataset:
    """Return the numbers of long runs over Omega and of fig3_large, with their variations.

    The dataset also has the predicted numbers, with variations of their own.
    """
    over_omega = by_tolerance(omegas, omegas_coarse)
    numbers = {
        **numbers_of_fronts(over_omega),
        **numbers_of_states(over_omega, thermal),
        **numbers_of_growth(over_omega, thermal, transverse),
        "large_exponent": exponent_of_case(by_tolerance(large, large_coarse)),
    }
    coordinates = {
        "omega": ("omega", omegas["omega"].values, {"long_name": "detuning"}),
        "level": ("level", omegas["level"].values, omegas["level"].attrs),
    }
    data = as_dataset(numbers, coordinates).assign(without_choices(omegas, thermal))
    distances = as_dataset(
        {
            "predicted_distance": predict_distances(noise, transverse),
            **differences(noise, transverse),
        },
        noise.coords,
    )
    title = "Numbers of long runs on infinite chains, with their variations"
    attributes = {name: omegas.attrs[name] for name in SHARED_ATTRIBUTES}
    attributes |= {"end_time": float(omegas["tau"][-1]), "large_end_time": float(large["tau"][-1])}
    attributes |= {"large_members": large.attrs["members"], "edge": int(omegas["edge"][0])}
    datasets = [data, transverse, noise, distances]
    merged = xr.merge([dataset.drop_attrs(deep=False) for dataset in datasets], join="outer")
    return merged.assign_attrs(title=title, **attributes)


SHARED_ATTRIBUTES = ("epsilon", "gamma", "members", "solver", "solver_rtol", "solver_atol", "rest")


def without_choices(omegas: xr.Dataset, thermal: xr.Dataset) -> dict[str, tuple]:
    """Return the numbers over Omega that depend on no choice: counts and predictions."""
    last = omegas["front"].isel(piece_tau=-1).max("member").values
    both, alone = (thermal_powers(thermal, omegas, f"{of}power") for of in ("", "antisymmetric_"))
    state = f"{POWER} in the thermal state"
    numbers = {
        "sites": ((2 * last + 1).astype(int), "sites that the front has passed at the end"),
        "predicted_speed": (omegas["predicted_speed"].values, PREDICTED_SPEED),
        "thermal_power": (both, state),
        "thermal_antisymmetric_power": (alone, f"{state} of the chain with A = -B"),
    }
    return {
        name: ("omega", values, {"long_name": label}) for name, (values, label) in numbers.items()
    }


def predict_distances(noise: xr.Dataset, transverse: xr.Dataset) -> NamedNumber:
    """Return ln(1 / noise) / kappa, the distance of the second front from the first, with noise.

    The noise of runs in A and B is a rounding error.
    """
    sizes = [
        ROUNDING_ERROR if noise_level == ROUNDING else float(noise_level)
        for noise_level in noise["noise"].values
    ]
    growth = transverse.sel(omega=noise["omega"].values)
    logs = -log(np.array(sizes))[:, None]
    kappa, error = (growth[names_of("growth_behind_front")[n]].values for n in (0, 2))
    variations = growth[names_of("growth_behind_front")[3]].dropna("variation", how="all")
    varied_kappa = {
        str(variation["variation"].item()): logs / variation.values for variation in variations.T
    }
    number = VariedNumber(logs / kappa, logs * error / (kappa * kappa), {}, varied_kappa)
    long_name = "predicted distance of the second front with noise from the first, in sites"
    return NamedNumber(("noise", "omega"), number, long_name)


def differences(noise: xr.Dataset, transverse: xr.Dataset) -> dict[str, NamedNumber]:
    """Return the distance with the first size of noise minus the distance with the second.

    The prediction is ln(second / first) / kappa. Growth does not start at one site, which adds an
    unknown constant to both distances. This constant cancels. The errors of the two measured
    distances are assumed to be independent.
    """
    first, second = (noise.isel(noise=n) for n in (0, 1))
    predicted = predict_distances(noise, transverse).number
    errors = [data["distance_statistical_error"].values for data in (first, second)]
    both = np.sqrt(errors[0] ** 2 + errors[1] ** 2)
    changes = first["distance_varied"] - second["distance_varied"]
    variations = {
        str(variation["variation"].item()): variation.values
        for variation in changes.transpose("variation", ...)
    }
    measured = VariedNumber((first["distance"] - second["distance"]).values, both, {}, variations)
    computed = VariedNumber(
        predicted.value[0] - predicted.value[1],
        predicted.statistical_error[0] - predicted.statistical_error[1],
        {},
        {label: values[0] - values[1] for label, values in predicted.variations.items()},
    )
    label = "difference of the distances with the first and the second size of noise, in sites"
    return {
        "distance_difference": NamedNumber(("omega",), measured, label),
        "predicted_distance_difference": NamedNumber(("omega",), computed, f"predicted {label}"),
    }


def by_tolerance(*runs: xr.Dataset) -> dict[float, xr.Dataset]:
    """Return runs by the tolerance of their solver, in this order."""
    return {float(run.attrs["solver_rtol"]): run for run in runs}


def select_fraction(run: xr.Dataset, fraction: float, **at: float) -> xr.Dataset:
    """Return a run up to a fraction of its end time, at a level and an edge."""
    end = fraction * float(run["tau"][-1])
    return run.sel(tau=slice(0.0, end), piece_tau=slice(0.0, end), **at)


def _first(run: xr.Dataset) -> dict[str, float]:
    """Return the first level and the first edge of a run, by name."""
    return {name: run[name].values[0] for name in ("level", "edge")}


def varied(
    runs: Mapping[float, xr.Dataset], measure: Callable[..., Estimate], **choices: list
) -> VariedNumber:
    """Return `measure(run, ...)`, varied by `choices` and by fractions and tolerances of runs.

    A level or an edge in `choices` selects the fronts and regions of the run.
    """

    def measured(**chosen: Any) -> Estimate:
        run = runs[chosen.pop("tolerance")]
        at = {key: chosen.pop(key, first) for key, first in _first(run).items()}
        return measure(select_fraction(run, chosen.pop("part_of_run"), **at), **chosen)

    return vary(measured, {"tolerance": list(runs), "part_of_run": FRACTIONS, **choices})


def _with_half(limits: ConfidenceInterval) -> Estimate:
    return limits.value, np.where(np.isfinite(limits.half), limits.half, np.nan)


# --- Numbers over Omega ---------------------------------------------------------------------------


def numbers_of_fronts(runs: Mapping[float, xr.Dataset]) -> dict[str, NamedNumber]:
    """Return the speeds of both fronts, and of the last sites with |S|^2 above each level."""
    levels = [float(level) for level in next(iter(runs.values()))["level"].values]
    fitted = [SETTLED, 0.5 * SETTLED, 2.0 * SETTLED]
    first = varied(runs, _by_part(speeds), left_out_part=fitted)
    second = varied(runs, _by_part(second_speeds), left_out_part=fitted, level=levels[:3])
    of_levels = varied_levels(runs, fitted)
    along = ("omega",)
    return {
        "front_speed": NamedNumber(along, first, f"speed of the first front, {SPEED}"),
        "second_front_speed": NamedNumber(along, second, f"speed of the second front, {SPEED}"),
        "level_speed": NamedNumber(
            ("level",),
            of_levels,
            f"speed of the last site with |S|^2 above a level, at the largest Omega, {SPEED}",
        ),
    }


def _by_part(measure: Callable[..., Estimate]) -> Callable[..., Estimate]:
    return lambda run, left_out_part: measure(run, left_out_part)


def varied_levels(runs: Mapping[float, xr.Dataset], fitted: list[float]) -> VariedNumber:
    """Return the speed of the last site above each level, at the largest Omega, (level,)."""

    def measured(tolerance: float, part_of_run: float, left_out_part: float) -> Estimate:
        run = runs[tolerance].isel(variant=[int(runs[tolerance]["omega"].values.argmax())])
        values = [
            level_speeds(select_fraction(run, part_of_run, level=level), left_out_part)
            for level in run["level"].values
        ]
        return tuple(np.concatenate(values) for values in zip(*values, strict=True))

    choices = {"tolerance": list(runs), "part_of_run": FRACTIONS, "left_out_part": fitted}
    return vary(measured, choices)


def numbers_of_states(
    runs: Mapping[float, xr.Dataset], thermal: xr.Dataset
) -> dict[str, NamedNumber]:
    """Return the powers behind both fronts, and their ratios to thermal powers."""
    edges = [int(edge) for edge in next(iter(runs.values()))["edge"].values]
    numbers = {}
    for name, region, state, choices in (
        ("behind", BEHIND, "power", {}),
        ("between", BETWEEN, "antisymmetric_power", {"edge": edges}),
    ):
        for quantity, expected in (("power", None), ("ratio", state)):
            measure = _power_of(region, thermal, expected)
            number = varied(runs, measure, averaged_part=[LATE, 0.5 * LATE], **choices)
            over = ", divided by that of the thermal state" if expected else ""
            numbers[f"{quantity}_{name}"] = NamedNumber(
                ("omega",), number, f"{POWER} {region}{over}"
            )
    return numbers


def _power_of(region: str, thermal: xr.Dataset, state: str | None) -> Callable[..., Estimate]:
    """Return a function that measures the power in a region, divided by that of `state` if any."""

    def measure(run: xr.Dataset, averaged_part: float) -> Estimate:
        limits = mean_limits(mean_powers(run, region, late=averaged_part).T)
        unit = thermal_powers(thermal, run, state) if state else 1.0
        formed = np.isfinite(second_speeds(run)[0]) | (region != BEHIND)
        return np.where(formed, limits.value / unit, np.nan), _with_half(limits)[1] / unit

    return measure


def numbers_of_growth(
    runs: Mapping[float, xr.Dataset], thermal: xr.Dataset, transverse: xr.Dataset
) -> dict[str, NamedNumber]:
    """Return the growth of l-infinity, exponents of tau in l2, and l2^2 compared with its law."""
    octaves = [OCTAVES, OCTAVES // 2, 2 * OCTAVES]
    with_offset = varied(runs, exponents, octaves=octaves)
    exponents_without_law = varied(runs, plain_exponents, octaves=octaves)

    omegas = next(iter(runs.values()))["omega"].values
    predicted = transverse["predicted_second_speed"].sel(omega=omegas).values

    def ratio(run: xr.Dataset, second_speed: str, fitted_from: float) -> Estimate:
        speed = predicted if second_speed == PREDICTED[0] else None
        limits = slope_ratios(run, thermal, second=speed, first=fitted_from)
        return np.array([limit.value for limit in limits]), np.array(
            [limit.half for limit in limits]
        )

    first = [FIRST_OF_LINE, 2.0 * FIRST_OF_LINE]
    law = varied(runs, ratio, second_speed=PREDICTED, fitted_from=first)
    maximum = varied(runs, growths_of_maximum)
    along = ("omega",)
    return {
        "maximum_growth": NamedNumber(
            along, maximum, "relative growth, in two octaves of tau, of the octave mean of linf"
        ),
        "exponent": NamedNumber(
            along, with_offset, "exponent of tau in l2, with a free offset of l2^2"
        ),
        "plain_exponent": NamedNumber(along, exponents_without_law, "slope of log l2 over log tau"),
        "slope_ratio": NamedNumber(along, law, "slope of l2^2 divided by the slope of its law"),
    }


def exponents(run: xr.Dataset, octaves: int) -> Estimate:
    """Return the exponent of tau in l2 over the last octaves, with a free offset, (variant,)."""
    tau, start = run["tau"].values, float(run["tau"][-1]) * 0.5**octaves
    curves = run["l2"].transpose("variant", "member", "tau").values
    limits = [fit_exponent(tau, members, start) for members in curves]
    return np.array([limit.value for limit in limits]), np.array([limit.half for limit in limits])


def plain_exponents(run: xr.Dataset, octaves: int) -> Estimate:
    """Return the slope of log l2 over log tau in the last octaves, (variant,)."""
    is_late = run["tau"].values >= float(run["tau"][-1]) * 0.5**octaves
    tau, curves = run["tau"].values[is_late], run["l2"].transpose("member", "variant", "tau").values
    slopes = [
        [lay_line(log(tau), log(series[is_late])).slope for series in member] for member in curves
    ]
    return _with_half(mean_limits(slopes))


def growths_of_maximum(run: xr.Dataset) -> Estimate:
    """Return the relative growth of the mean l-infinity from (T/8, T/4] to (T/2, T].

    T is the end of the run.
    """
    tau = run["tau"]
    before = run["linf"].sel(tau=(tau > tau[-1] / 8.0) & (tau <= tau[-1] / 4.0)).mean("tau")
    growth = run["linf"].sel(tau=tau > tau[-1] / 2.0).mean("tau") / before - 1.0
    return _with_half(mean_limits(growth.transpose("member", "variant").values))


def exponent_of_case(runs: Mapping[float, xr.Dataset]) -> NamedNumber:
    """Return the exponent of tau in l2 of the large case at Omega = -4."""

    def measure(run: xr.Dataset, octaves: int) -> Estimate:
        value, error = exponents(run, octaves)
        return value[0], error[0]

    number = varied(runs, measure, octaves=[OCTAVES, OCTAVES // 2, 2 * OCTAVES])
    return NamedNumber((), number, "exponent of tau in l2 of the large case at Omega = -4")
