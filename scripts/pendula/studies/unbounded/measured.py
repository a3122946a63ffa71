"""What is measured of runs on infinite chains: growth of the norms, speeds, the bulk behind.

Where the chain at rest is unstable, a front moves at the speed v of linear spreading and leaves a
thermal bulk of mean power P per site on both sides. The norm is then l2 = (2 v P tau)^(1/2).
"""

from collections.abc import Iterator, Mapping
from dataclasses import asdict, replace
from itertools import pairwise

import numpy as np
import xarray as xr

from pendula.datasets.netcdf import Variable, as_xarray
from pendula.datasets.registry import NAMES
from pendula.datasets.trajectories import shared_by
from pendula.measures.confidence import mean_limits
from pendula.measures.growth import local_exponents
from pendula.measures.spreading import lay_line
from pendula.numerics.elementary import complex_of, geometric, interpolated, log, modulus
from pendula.problem import Constants

from .bulk import (
    FIRST_OF_LINE,
    LENGTH,
    POWER,
    TERMS,
    bulk_of,
    energy_terms,
    mean_powers,
    profile,
    slope_powers,
    spectrum,
    statistics_of,
    thermal_powers,
)
from .extremes import mean_maximum
from .front import DELAY, PIECE_TAU, PREDICTED_SPEED, REST, SITE_OF_FRONT, linear_front

RESOLVES = "limits, to each side: what the places of a front between two sites resolve"

FRONT, BULK = 1e-2, 4.0
"""Powers at which a front is found: of a pulled one, and of a bulk amid waves that it radiates."""

SETTLED = 1 / 3
"""The part of a run that is left out: at first the speed is below the one it tends to."""


def measure(
    runs: Mapping[str, xr.Dataset],
    omegas: xr.Dataset,
    bulk: xr.Dataset,
    large: xr.Dataset,
    thermal: xr.Dataset,
) -> Iterator[xr.Dataset]:
    """Yield the growth of `runs`, which are by case, and the front.

    `omegas` are runs over Omega; `bulk` and `large` are the two whose bulk is looked at, in an
    unstable and in a stable chain at rest; `thermal` are the states that it is compared with.
    """
    yield measure_growth(runs, thermal)
    yield measure_front(omegas, bulk, large, thermal)


# --- Growth ---------------------------------------------------------------------------------------

POINTS, OCTAVES = 120, 4
"""Times of a series, equally spaced in log tau; the last octaves of time with an exponent each."""
BAND = ("lowest", "mean", "highest")
"""What is kept of a norm over the members of an ensemble."""
FIRST, SPANS = 10.0, 16
"""Where the comparison with the law 2 v P tau begins, and its spans, equally long in log tau."""


def measure_growth(runs: Mapping[str, xr.Dataset], thermal: xr.Dataset) -> xr.Dataset:
    """Return series, exponents and laws of the ensembles in `runs`, by case.

    `runs` are datasets of `long_runs.run_variables`, and the first variant of each is measured.
    `thermal` holds the mean power of the thermal states over Omega. All values are dimensionless.
    """
    first = [run.isel(variant=0) for run in runs.values()]
    found = [_growth_of(run, thermal) | _rates_of(run, thermal) for run in first]
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
        reached = float(run["predicted_speed"]) * (times - _delay(run) * log(times))
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


def _rates_of(run: xr.Dataset, thermal: xr.Dataset) -> dict[str, Variable]:
    """Return l2^2 / tau over spans of time and its law, in which no constant is fitted.

    Where the law begins is not known, so that an offset of l2^2 is fitted beside it. It is NaN
    where the chain at rest is stable or no state was solved.
    """
    tau, law = run["tau"].values, np.nan
    if _is_of(thermal, run) and run["predicted_delay"] > 0.0:
        power = float(thermal_powers(thermal, run["omega"].values))
        law = 2.0 * float(run["predicted_speed"]) * power
    squares = run["l2"].transpose("member", "tau").values ** 2
    edges = geometric(FIRST, float(tau[-1]), SPANS + 1)
    spans = [(tau >= a) & (tau <= b) for a, b in pairwise(edges)]
    means = np.array([(squares[:, span] / tau[span]).mean(axis=1) for span in spans]).T
    passed = tau - _delay(run) * log(np.maximum(tau, 1.0))
    late = tau >= FIRST_OF_LINE * tau[-1]
    offset = (squares.mean(axis=0) - law * passed)[late].mean()
    law_rates = np.array([law * (passed[span] / tau[span]).mean() for span in spans])
    offsets = np.array([offset * (1.0 / tau[span]).mean() for span in spans])
    along, of = ("span",), "l2^2 / tau, mean over a span of time"
    limits = f"half of the 95 % limits of the mean {of}"
    at_last = "2 v P: l2^2 / tau by linear spreading and the thermal bulk, for long times"
    return {
        "span_tau": Variable(along, np.sqrt(edges[:-1] * edges[1:]), "middle of a span of tau"),
        "l2_rate": Variable(("band", "span"), _band(means), of),
        "rate_limits": Variable(along, _known(mean_limits(means).half), limits),
        "law": Variable((), law, at_last),
        "law_rate": Variable(along, law_rates, "that law with the delay of a pulled front"),
        "offset_rate": Variable(along, offsets, "b / tau, with the offset b of l2^2 fitted"),
    }


def _is_of(thermal: xr.Dataset, run: xr.Dataset) -> bool:
    """Return whether thermal states over Omega were solved for the other constants of a run."""
    return all(thermal.attrs[name] == run.attrs[name] for name in ("epsilon", "gamma"))


def _delay(run: xr.Dataset) -> float:
    """Return the time that a pulled front loses per unit of log tau."""
    return float(run["predicted_delay"] / run["predicted_speed"])


def _known(halves) -> np.ndarray:
    """Return limits, and NaN in place of the infinite ones of a single member."""
    return np.where(np.isfinite(halves), halves, np.nan)


def _band(values: np.ndarray) -> np.ndarray:
    """Return the BAND of (member, ...) over the members."""
    return np.array([values.min(axis=0), values.mean(axis=0), values.max(axis=0)])


# --- The front, and the bulk behind it ------------------------------------------------------------

SPANS_OF_WAY = 36
"""Spans of log tau in which the front's way is averaged."""

BINS, HIGHEST, MODULI = 24, 1.2, 40
"""Cells of a profile, how far it reaches beyond the front, and cells of a distribution."""


def resolution(tau: np.ndarray) -> float:
    """Return how well the speed of a front can be known from its places at `tau`.

    A front lies between two sites, and waves at its edge move it to and fro between them. Places
    that are off by half a site either way change the slope of least squares by at most 3/2 sites
    over the time of the fit. All members of an ensemble have one front, so they make it no better.
    """
    return 1.5 / ((1.0 - SETTLED) * float(tau[-1]))


def speeds(run, level: float = FRONT, corrected: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """Return the speeds of each variant of a dataset of runs, mean over members, and their limits.

    A speed is the slope of the front's site over time, of the late part of a run. `corrected` adds
    back what a pulled front loses on its way. The limits are those of the mean by Student's t, and
    no less than the `resolution`.
    """
    tau = run["piece_tau"].values
    way = run["front"].sel(front_power=level).transpose("variant", "member", "piece_tau").values
    if corrected:
        delay, rest = (run[f"predicted_{name}"].values[:, None, None] for name in ("delay", "rest"))
        way = way + delay * log(tau) + rest / np.sqrt(tau)
    late = tau >= SETTLED * tau[-1]
    found = [[lay_line(tau[late], one[late]).slope for one in members] for members in way]
    limits = mean_limits(np.transpose(found))
    half = np.where(np.isfinite(limits.half), limits.half, 0.0)
    return limits.value, np.maximum(half, resolution(tau))


def measure_front(
    omegas: xr.Dataset, bulk: xr.Dataset, large: xr.Dataset, thermal: xr.Dataset
) -> xr.Dataset:
    """Return fronts over Omega, the way of one of them, and the state behind it.

    `omegas` are runs over Omega, `bulk` the run whose bulk is looked at, `large` one whose bulk
    spreads where the chain at rest is stable. `thermal` are the states without energy that the
    bulk is compared with.
    """
    constants = Constants.of(bulk.attrs)
    omega, line = omegas["omega"].values, np.linspace(-4.0, 8.0, 97)
    plain, plain_error = speeds(omegas)
    corrected, corrected_error = speeds(omegas, corrected=True)
    power, slopes = mean_limits(mean_powers(omegas).T), slope_powers(omegas)
    speed_at = [linear_front(replace(constants, omega=value)).speed for value in line]
    over_omega = {
        "omega": (omega,),
        "speed": (plain, "measured speed of the front, in sites per unit of tau"),
        "speed_error": (plain_error, f"{RESOLVES} of that speed"),
        "corrected_speed": (corrected, "speed of the front, its delay added back"),
        "corrected_speed_error": (corrected_error, f"{RESOLVES} of that speed"),
        "predicted_speed": (omegas["predicted_speed"].values, PREDICTED_SPEED),
        "mean_power": (power.value, POWER),
        "mean_power_error": (_known(power.half), f"half of the 95 % limits of the {POWER}"),
        "expected_power": (
            thermal_powers(thermal, omega), f"{POWER} in the thermal state at the same Omega"
        ),
        "slope_power": ([one.value for one in slopes], f"{POWER}, from the slope of l2^2"),
        "slope_power_error": (
            [one.half for one in slopes], "half of the 95 % limits of that from the slope"
        ),
    }  # fmt: skip
    first = omegas["front"].sel(front_power=FRONT).isel(member=0)
    of_bulk = large["front"].sel(front_power=BULK).squeeze("variant").isel(member=0)
    variables = {
        **{name: Variable(("omega",), *given) for name, given in over_omega.items()},
        "line_omega": Variable(("line_omega",), line, "detuning Omega, on a finer grid"),
        "line_speed": Variable(("line_omega",), speed_at, PREDICTED_SPEED),
        "piece_tau": Variable(("piece_tau",), omegas["piece_tau"].values, PIECE_TAU),
        "front": Variable(("omega", "piece_tau"), first.values, SITE_OF_FRONT),
        "large_tau": Variable(
            ("large_piece",), large["piece_tau"].values, "slow time, stable chain"
        ),
        "large_front": Variable(
            ("large_piece",), of_bulk.values, "site where the bulk ends, stable chain"
        ),
        **_way(bulk.squeeze("variant")),
        **_behind(bulk.squeeze("variant"), constants),
        **_thermal(thermal, constants.omega),
    }
    title = "The front on infinite chains, and the bulk behind it"
    about = {**shared_by([omegas.attrs, bulk.attrs]), **asdict(constants)}
    return as_xarray(variables, {**about, "title": title, "large_omega": large.attrs["omega"]})


def _way(bulk: xr.Dataset) -> dict[str, Variable]:
    """Return how far the front falls behind the speed of linear spreading, mean over members."""
    tau, v = bulk["piece_tau"].values, float(bulk["predicted_speed"])
    way = bulk["front"].sel(front_power=FRONT).transpose("member", "piece_tau").values
    behind = (way - v * tau).mean(axis=0)
    # waves at its edge move a front to and fro: means over short spans of log time show its way
    spans = np.digitize(log(tau), np.linspace(log(tau[0]), log(tau[-1]), SPANS_OF_WAY))
    found = [spans == span for span in np.unique(spans)]
    return {
        "way_tau": Variable(("span",), [tau[s].mean() for s in found], "slow time, mean of a span"),
        "behind": Variable(("span",), [behind[s].mean() for s in found], "site of front - v tau"),
        "delay": Variable((), float(bulk["predicted_delay"]), DELAY),
        "front_rest": Variable((), float(bulk["predicted_rest"]), REST),
    }


def _behind(bulk: xr.Dataset, constants: Constants) -> dict[str, Variable]:
    """Return profiles, spectrum and distribution of the final states of all members."""
    fronts = bulk["front"].isel(piece_tau=-1).sel(front_power=FRONT).values.astype(int)
    edges = np.linspace(0.0, HIGHEST, BINS + 1)
    terms, spectra, moduli = [], [], []
    for sites, front in zip(bulk["state"].values, fronts, strict=True):
        terms.append(profile(energy_terms(sites, constants), (edges * front).astype(int)))
        for amplitude in complex_of(sites[0::2], sites[1::2])[:, bulk_of(front)]:
            spectra.append(spectrum(amplitude, LENGTH))
            moduli.append(modulus(amplitude))
    moduli = np.concatenate(moduli)
    cells = np.linspace(0.0, 1.05 * moduli.max(), MODULI + 1)
    density = np.histogram(moduli, cells, density=True)[0]
    middles = 0.5 * (edges[1:] + edges[:-1])
    return {
        "term": Variable(("term",), list(TERMS), "term of the energy (8)"),
        "mean_terms": Variable(("term", "bin"), np.mean(terms, axis=0), "terms of H per site"),
        "scaled_site": Variable(("bin",), middles, "site over that of the front"),
        **statistics_of(np.mean(spectra, axis=0), density, cells),
    }


def _thermal(thermal: xr.Dataset, omega: float) -> dict[str, Variable]:
    """Return of the thermal states what the bulk is compared with, for some of it at one Omega."""
    one = thermal.reindex(omega=[omega], method="nearest", tolerance=1e-9).isel(omega=0)
    taken = [thermal["omega"], thermal["power"], one["modulus"], one["density"], one["spectrum"]]
    dims = {"omega": "state", "modulus": "cell", "wave": "wave"}
    return {
        f"thermal_{values.name}": Variable(
            tuple(dims[dim] for dim in values.dims),
            values.values,
            f"{values.attrs['long_name']}, thermal state",
        )
        for values in taken
    }
