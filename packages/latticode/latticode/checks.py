"""Checks of a run: its error, whether its motion is chaotic, and a localised state nearby.

A method of another family integrates the problem again, with tight tolerances. The difference of
the two runs, in the norms and in the fields at all sites, is the error of the worse run. If the
first run used the default solver and tolerances, this is the error of double precision. The growth
of a random tangent vector shows whether the motion is chaotic, and when rounding errors become
visible. The last check finds a localised state near the initial data, and its stability.
"""

from collections.abc import Collection, Mapping

import numpy as np
import xarray as xr

from latticode.datasets.checks import table, variable
from latticode.datasets.netcdf import as_xarray
from latticode.datasets.trajectories import trajectory_contents
from latticode.integrators.families import Agreement, compare, other_family
from latticode.integrators.method import SMALLEST_ERROR
from latticode.integrators.methods import METHODS
from latticode.localised.breathers import NoStateError, exponents, find_state
from latticode.localised.rest import describe_unstable_rest
from latticode.localised.tangents import STEP, TangentGrowth, grow, random_tangent
from latticode.measures.difference import (
    NORMS,
    VISIBLE,
    at_times,
    difference,
    divergence_time,
    first_above,
)
from latticode.measures.growth import (
    ROUNDING,
    amplification,
    is_chaotic,
    mean_rate,
    mean_rate_error,
    predict,
)
from latticode.numerics.elementary import complex_of, log, modulus
from latticode.simulation.equations import GaveUpError, IntegrationError
from latticode.simulation.problem import Problem
from latticode.simulation.simulate import simulate

TITLE = "A run and its checks"
UNSTABLE_REST = "unstable_rest"
"""The attribute with a warning about sites at rest at an unstable point."""


def choose_solver(name: str, peak: float, known: Collection[str] = METHODS) -> dict:
    """Return a solver of another family than `name`, to check a run of amplitude `peak`.

    `known` are the methods that can integrate the equations. For amplitudes below 1 the absolute
    tolerance is smaller, but at least SMALLEST_ERROR.
    """
    judge = other_family(name, known)
    rtol = METHODS[judge].tightest
    atol = max(rtol * (peak if 0 < peak < 1 else 1.0), SMALLEST_ERROR)
    return {"name": judge, "rtol": rtol, "atol": atol}


def run_again(problem: Problem, run: xr.Dataset) -> xr.Dataset:
    """Return the norms of a second run and its differences from `run`; NaN if it fails.

    `run` is the stored trajectory of `problem` by any solver. It may have no phases before the end
    time, so its solver runs again too, and stores the fields at the snapshots.
    """
    peak, known = float(modulus(problem.initial).max()), set(problem.equations.methods)
    solver = choose_solver(str(run.attrs["solver"]), peak, known)
    norm_difference = xr.full_like(run["linf"].isel(component=0, drop=True), np.nan)
    second_norms, agreement, refusal = run[list(NORMS)] * np.nan, None, {}
    try:
        try:
            second = simulate(problem.changed(solver=solver))
        except GaveUpError:  # a power series may fail where the solution continues
            solver = choose_solver(str(run.attrs["solver"]), peak, known - {"taylor"})
            second = simulate(problem.changed(solver=solver))
        first = simulate(problem.changed(solver=solver_of(run.attrs)))
        first = first._replace(final=_final_of(run, first.final))
        agreement = compare(first, second)
        without_snapshots = problem.changed(snapshot_every=0, snapshots_at=())
        second_norms = as_xarray(*trajectory_contents("second run", without_snapshots, second))
        norm_difference = difference(run, second_norms).reindex(tau=run["tau"])
    except IntegrationError as error:
        refusal = {"second_refusal": str(error)}
    controls = {f"second_{key}": value for key, value in solver.items()}
    return _compared(run, second_norms, norm_difference, agreement).assign_attrs(controls | refusal)


def solver_of(attributes: Mapping) -> dict:
    """Return the solver of a run, with its controls, from the attributes of its dataset."""
    start = "solver_"
    keys = [key for key in attributes if key.startswith(start)]
    controls = {key.removeprefix(start): attributes[key] for key in keys}
    return {"name": str(attributes["solver"]), **controls}


def _final_of(run: xr.Dataset, final: np.ndarray) -> np.ndarray:
    """Return the stored fields at the end of a run, or `final` if none are stored."""
    if "final" not in run:
        return final
    real_and_imaginary = run["final"].transpose("part", "component", "site").values
    return real_and_imaginary if final.ndim == 3 else complex_of(*real_and_imaginary)


def _compared(
    run: xr.Dataset,
    second_norms: xr.Dataset,
    norm_difference: xr.DataArray,
    agreement: Agreement | None,
) -> xr.Dataset:
    """Return the norms of the second run, and the differences of both runs in norms and fields."""
    data = at_times(second_norms, run["tau"]).drop_attrs(deep=False)
    data = data.rename({norm: f"second_{norm}" for norm in NORMS})
    for norm in NORMS:
        long_name = f"{run[norm].attrs['long_name']}, by another method"
        data[f"second_{norm}"].attrs = {"long_name": long_name, "units": run[norm].attrs["units"]}
    data["difference"] = norm_difference.assign_attrs(
        long_name="largest difference of the norms of two runs, relative to full scale", units="1"
    )
    largest, diverged = norm_difference.max(), divergence_time(norm_difference)
    if agreement is not None:
        long_name_of_fields = "largest difference of fields at a site, relative to full scale"
        times = variable(agreement.kept_tau, ("kept_tau",), "time at which fields are compared")
        fields = variable(agreement.fields, ("kept_tau",), long_name_of_fields)
        data = data.merge(
            xr.Dataset.from_dict(table(TITLE, {}, kept_tau=times, field_difference=fields)),
            combine_attrs="override",
        )
        largest = largest.clip(min=agreement.fields.max())
        first = first_above(agreement.kept_tau, agreement.fields, VISIBLE)
        diverged = diverged.clip(max=first, keep_attrs=True)
    data["largest_difference"] = largest.assign_attrs(
        long_name="largest difference of fields and norms: the error of the worse run", units="1"
    )
    data["divergence_time"] = diverged
    return data


# --- Sensitivity ----------------------------------------------------------------------------------

FEWEST_STEPS, SEED = 64, 20170817


def follow(problem: Problem) -> TangentGrowth:
    """Return the growth of a random tangent vector along the trajectory of a problem."""
    even, rng = problem.equations.find_reduction().even, np.random.default_rng(SEED)
    tangent = random_tangent(problem.sites, rng, even, len(problem.model.fields))
    step = min(STEP, problem.span / FEWEST_STEPS)
    return grow(problem, tangent[None], problem.span, even, step)


def measure_sensitivity(problem: Problem) -> xr.Dataset:
    """Return the growth rate of a tangent vector, a test for chaos, and when errors are visible."""
    try:
        growth = follow(problem)
    except IntegrationError as error:
        return xr.Dataset(attrs={"sensitivity_refusal": str(error)})
    tau, log_growth, size = growth.tau, growth.log_growth[0], growth.size
    middle = tau[-1] / 2
    with np.errstate(divide="ignore", invalid="ignore"):  # at rest the size is zero
        relative = log_growth - log(size)
        late = relative[-1] - relative[np.searchsorted(tau, middle)]
        amplified = amplification(tau, log_growth, size)
    chaotic = int(is_chaotic(tau, log_growth, size))
    numbers = {
        "exponent": (
            mean_rate(tau, log_growth, middle),
            "growth rate of a tangent vector, second half, per unit of tau",
        ),
        "exponent_error": (mean_rate_error(tau, log_growth, middle), "standard error of the rate"),
        "late_growth": (late, "logarithm of tangent growth over solution growth, second half"),
        "chaotic": (chaotic, "chaotic (1: yes, 0: no)"),
        "divergence_rounding": (
            problem.start_time + predict(tau, amplified, ROUNDING),
            "tau at which rounding errors, one per unit of tau, reach 1 %",
        ),
    }
    described = {name: variable(value, (), text) for name, (value, text) in numbers.items()}
    curve = variable(log_growth, ("growth_tau",), "logarithm of the growth of a tangent vector")
    return xr.Dataset.from_dict(
        table(TITLE, {"growth_tau": problem.start_time + tau}, log_growth=curve, **described)
    )


# --- A localised state ----------------------------------------------------------------------------

LOCALISED = 0.01
"""At the sites farthest from its centre, a localised state is at most this fraction of its peak."""


def check_breather(problem: Problem) -> xr.Dataset:
    """Return a localised state with its exponents, or an attribute with the reason for its absence.

    Floquet multipliers are over one period; those of a steady state are over one unit of tau.
    """
    try:
        with np.errstate(all="ignore"):  # Newton's method may diverge; `find_state` detects this
            state = find_state(problem)
    except NoStateError as error:
        return xr.Dataset(attrs={"breather_refusal": str(error)})
    fields = state.components(problem)
    moduli = np.sqrt(np.sum(fields**2, axis=1))
    sizes = moduli.max(axis=0)
    away = np.abs(np.arange(sizes.size) - sizes.argmax())
    end = sizes[away >= away.max() - 1].max() / sizes.max()
    waves = exponents(problem, state._replace(x=0.0 * state.x))
    state_exponents = exponents(problem, state)
    period = 2.0 * np.pi / abs(state.frequency) if state.frequency else 1.0
    growth, multipliers = state_exponents.real.max(), np.exp(period * state_exponents)
    frequencies = "distance of the frequency from those of linear waves"
    edge = "largest value at the farthest sites, divided by that at the centre"
    modes, sites = ("part", "mode"), np.array(problem.site_numbers)
    numbers = {
        "_frequency": (state.frequency, (), "frequency lambda of a localised state"),
        "_gap": (np.abs(waves).min(), (), frequencies),
        "_end": (end, (), edge),
        "_growth": (growth, (), "largest growth rate of perturbations, per unit of tau"),
        "_exponents": (
            _real_and_imaginary(state_exponents),
            modes,
            "exponents of perturbations, per unit of tau",
        ),
        "_multipliers": (
            _real_and_imaginary(multipliers),
            modes,
            "Floquet multipliers of perturbations",
        ),
        "": (moduli, ("component", "site"), "moduli of a localised state"),
    }
    described = {f"breather{name}": variable(*given, digits=6) for name, given in numbers.items()}
    axes = {"part": ["re", "im"], "component": list(problem.model.fields), "site": sites}
    state_exponents = xr.Dataset.from_dict(table(TITLE, axes, **described))
    state_exponents["component"].attrs["long_name"] = problem.equations.names.component
    return state_exponents


def _real_and_imaginary(values: np.ndarray) -> np.ndarray:
    return np.stack([values.real, values.imag])


# --- All checks -----------------------------------------------------------------------------------


def check_conserved(run: xr.Dataset) -> xr.Dataset:
    """Return the largest drift of each conserved quantity, relative to its largest magnitude."""
    if "conserved" not in run:
        return xr.Dataset()
    values = run["conserved"].values
    drift = np.abs(values - values[:, :1]).max(axis=1)
    sizes = np.abs(values).max(axis=1)
    drift /= np.where(sizes > 0, sizes, 1.0)
    long_name = "largest change of a conserved quantity, relative to its largest size"
    names = {"conserved_quantity": run["conserved_quantity"].values}
    described = variable(drift, ("conserved_quantity",), long_name)
    return xr.Dataset.from_dict(table(TITLE, names, conserved_drift=described))


def check_rest(problem: Problem, run: xr.Dataset) -> xr.Dataset:
    """Return an attribute with a warning if sites are at rest at an unstable point."""
    sentence = describe_unstable_rest(problem, run["modulus"].values) if "modulus" in run else ""
    return xr.Dataset(attrs={UNSTABLE_REST: sentence} if sentence else {})


def check_run(problem: Problem, run: xr.Dataset) -> xr.Dataset:
    """Return all checks of a run as one dataset, with the attributes of the run.

    `run` is the stored trajectory of `problem`.
    """
    second_run, growth = run_again(problem, run), measure_sensitivity(problem)
    other_checks = check_conserved(run), check_rest(problem, run), check_breather(problem)
    return merged(run, second_run, growth, *other_checks)


def merged(run: xr.Dataset, *checks: xr.Dataset) -> xr.Dataset:
    """Return several checks of a run as one dataset, with the attributes of the run."""
    data = xr.merge(checks, combine_attrs="drop_conflicts")
    return data.assign_attrs({**run.attrs, **data.attrs})
