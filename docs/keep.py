"""Keep what the README and docs/ quote of a finished run and tests/baseline does not hold yet.

Run as `python docs/keep.py results` after a full run, after `snakemake reproduction` on a quiet
machine, and after `snakemake unbounded`, `over_the_top`, or `fates sensitivity`, if a long study
was made anew. It reduces them to what is quoted and writes this to tests/baseline/quoted: the
ledger, the hard cases, how long a reproduction takes, and the long studies of the chain without
ends, of breathers and of the pendula.

Run as `python docs/keep.py config` after the paper is read in another way and config/*.yaml say so:
it keeps what they say as the configuration that the claims are about.
"""

import json
import shutil
import sys
from pathlib import Path

import numpy as np
import xarray as xr
import yaml

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "scripts")]

from pendula import __version__  # noqa: E402
from pendula.configuration import paper  # noqa: E402
from pendula.configuration.messages import STUDIES, load  # noqa: E402
from pendula.datasets.netcdf import Variable, read, write  # noqa: E402
from pendula.measures.confidence import mean_limits  # noqa: E402
from pendula.measures.spreading import fit_exponent, fit_line  # noqa: E402
from pendula.studies.breathers.fate_contents import TERMS, TIMES  # noqa: E402
from pendula.studies.breathers.fate_figures import MAPS  # noqa: E402
from pendula.studies.breathers.fates import FATES  # noqa: E402
from pendula.studies.breathers.nearest import NEAR  # noqa: E402
from pendula.studies.unbounded.bulk import (  # noqa: E402
    mean_powers,
    mean_terms,
    slope_powers,
    thermal_powers,
)
from pendula.studies.unbounded.claims_bulk import at_energy  # noqa: E402
from pendula.studies.unbounded.claims_state import FAR_AHEAD, unbounded_maximum  # noqa: E402
from pendula.studies.unbounded.front import BULK, FRONT, speeds  # noqa: E402

GIVEN = yaml.safe_load((ROOT / "config/unbounded.yaml").read_text())["unbounded"]
QUOTED = ROOT / "tests/baseline/quoted"


def keep_full_run(results: Path, folder: Path) -> None:
    """Keep the ledger and the outcome of every hard case."""
    shutil.copyfile(results / "claims.json", folder / "claims.json")
    cases = read(results / "checks/hard_cases.nc")
    kept = {
        str(name): Variable(values.dims, values.values, values.attrs["long_name"])
        for name, values in cases.variables.items()
    }
    _write(folder / "hard_cases.nc", "Hard cases for the solvers", kept)


def keep_reproduction(results: Path, folder: Path) -> None:
    """Keep the times of a whole reproduction."""
    shutil.copyfile(results / "speed/reproduction.json", folder / "reproduction.json")


def keep_long_study(results: Path, folder: Path) -> None:
    """Keep exponents, fronts and powers of the long study of the chain without ends."""
    long, thermal = results / "long/unbounded", read(results / "unbounded/thermal.nc")
    kept = {
        **_cases({name: read(long / f"{name}.nc") for name in GIVEN["cases"]}),
        **_omegas(read(long / "omegas.nc"), thermal),
        **_warm(read(long / "fig3_large.nc"), thermal),
        **_amplitudes(read(long / "amplitudes.nc")),
        **_tolerances(read(long / "tolerances.nc")),
        **_maxima(read(long / "fig4_small.nc"), thermal),
    }
    tolerance = GIVEN["long"]["solver"]["rtol"]
    solver = {"solver": "dop853", "solver_rtol": tolerance, "solver_atol": tolerance}
    problem = {"epsilon": 1.0, "gamma": 1.0, "rest": GIVEN["long"]["rest"], **solver}
    title = "The long study of the chain without ends, reduced to what the documents quote"
    _write(folder / "unbounded.nc", title, kept, **problem)


def _write(path: Path, title: str, variables: dict[str, Variable], **attributes) -> None:
    write(path, variables, {"title": title, **attributes, "version": __version__})


PASSAGES = ("passage_median", "passage_rate", "passed")
"""What is kept of first passages over the top, with its limits; of `passed` the last."""


def keep_passages(results: Path, folder: Path) -> None:
    """Keep shares, rates and angles of the long study of pendula that go over the top."""
    long = read(results / "long/pendula/over_the_top.nc")
    last, tau = long.isel(tau=-1), long["tau"].values
    names = [name for name in last if str(name).startswith(PASSAGES)]
    kept = {
        str(name): Variable(("mu",), last[name].values, last[name].attrs["long_name"])
        for name in ["mu", *names]
    }
    kept["turns"] = Variable(
        ("mu",),
        last["angle_so_far"].mean("member").values / (2.0 * np.pi),
        "largest angle by the end in turns, mean over the members",
    )
    about = {"members": long.sizes["member"], "end_time": tau[-1], "settled": long.attrs["settled"]}
    title = "The long study of pendula that go over the top, reduced to what the documents quote"
    _write(folder / "pendula.nc", title, kept, **about)


OCTAVES = 2
"""The exponents hold for so many of the last octaves of time, as in the ledger."""


def _exponent(run: xr.Dataset, variant: int = 0):
    """Return the exponent of tau in l2, and what l2^2 gains meanwhile, both with their limits.

    One member alone tells as much as all where the run is regular; else its limits are infinite.
    """
    values = run["l2"].isel(variant=variant).transpose("member", "tau").values
    tau = run["tau"].values
    start = tau[-1] * 0.5**OCTAVES
    return fit_exponent(tau, values, start), fit_line(tau, values[:1] ** 2, start).relative


def _varied(run: xr.Dataset, start: float = 10.0) -> tuple[list[float], list[float]]:
    """Return the exponent of each variant, and the least factor by which l2 grew from `start`."""
    l2 = run["l2"].transpose("variant", "member", "tau").values
    factors = l2[:, :, -1] / l2[:, :, np.searchsorted(run["tau"].values, start)]
    found = [_exponent(run, variant)[0].value for variant in range(run.sizes["variant"])]
    return found, list(factors.min(axis=1))


def _cases(runs: dict[str, xr.Dataset]) -> dict[str, Variable]:
    rows = [_case(run) for run in runs.values()]
    named = {"case": Variable(("case",), list(runs), "case of the paper, on a chain without ends")}
    return named | {
        name: Variable(("case",), [row[name] for row in rows], title)
        for name, title in {
            "end": "slow time at the end",
            "members": "members of the ensemble",
            "sites": "sites that the front has passed at the end",
            "exponent": "exponent of tau in the l2 norm over the last octaves",
            "exponent_error": "its 95 % limits by Student's t, to each side",
            "growth": "relative growth of l2 over the last octaves, of a line through its square",
            "growth_error": "its 95 % limits, to each side",
            "linf": "l-infinity norm at the end, mean over the members",
            "speed": "speed of the front, sites per unit of tau",
            "speed_error": "its 95 % limits, or what the places of the front resolve",
            "predicted_speed": "speed of linear spreading, sites per unit of tau",
            "bulk_power": "mean of |A_n|^2 + |B_n|^2 on the sites behind the front",
            "bulk_power_error": "its 95 % limits, to each side",
            "slope_power": "the same mean, from the slope of l2^2",
            "slope_power_error": "its 95 % limits, to each side",
        }.items()
    }


def _case(run: xr.Dataset) -> dict[str, float]:
    exponent, gained = _exponent(run)
    # where the chain at rest is stable no front is pulled: the bulk itself spreads, without a delay
    pulled = bool(run["predicted_delay"][0] > 0)
    level = FRONT if pulled else BULK
    speed, error = speeds(run, level, corrected=pulled)
    power, slope = mean_limits(mean_powers(run, level)[0]), slope_powers(run)[0]
    return {
        "end": float(run["tau"][-1]),
        "members": run.sizes["member"],
        "sites": 2 * int(run["front"].isel(piece_tau=-1).max()) + 1,
        "exponent": exponent.value,
        "exponent_error": exponent.half,
        "growth": 0.5 * gained.value,
        "growth_error": 0.5 * gained.half,
        "linf": float(run["linf"].isel(variant=0, tau=-1).mean()),
        "speed": speed[0],
        "speed_error": error[0],
        "predicted_speed": float(run["predicted_speed"][0]),
        "bulk_power": power.value,
        "bulk_power_error": power.half,
        "slope_power": slope.value,
        "slope_power_error": slope.half,
    }


def _omegas(run: xr.Dataset, thermal: xr.Dataset) -> dict[str, Variable]:
    omegas = run["omega"].values
    speed, error = speeds(run, corrected=True)
    powers, slopes = mean_limits(mean_powers(run).T), slope_powers(run)
    limits = "its 95 % limits, to each side"
    values = {
        "varied_omega": (omegas, "detuning Omega"),
        "omega_exponent": (
            _varied(run)[0],
            "exponent of tau in the l2 norm over the last two octaves",
        ),
        "omega_speed": (speed, "speed of the front, its known delay added back"),
        "omega_speed_error": (error, "its 95 % limits, or what the places of the front resolve"),
        "omega_predicted_speed": (run["predicted_speed"].values, "speed of linear spreading"),
        "omega_bulk_power": (
            powers.value,
            "mean of |A_n|^2 + |B_n|^2 on the sites behind the front",
        ),
        "omega_bulk_power_error": (powers.half, limits),
        "omega_slope_power": ([one.value for one in slopes], "that mean from the slope of l2^2"),
        "omega_slope_power_error": ([one.half for one in slopes], limits),
        "omega_thermal_power": (
            thermal_powers(thermal, omegas),
            "the same mean in the thermal state of zero energy",
        ),
        "omega_correlation_length": (
            thermal["correlation_length"].sel(omega=omegas, method="nearest").values,
            "sites over which the slowest correlation of that state falls by a factor of e",
        ),
    }
    end = Variable((), float(run["tau"][-1]), "slow time at the end of the runs over Omega")
    return {"omega_end": end} | {
        name: Variable(("varied_omega",), *value) for name, value in values.items()
    }


def _warm(run: xr.Dataset, thermal: xr.Dataset) -> dict[str, Variable]:
    """Return the energy that a front leaves behind, and P of the thermal states with or without."""
    energy = mean_limits(mean_terms(run, BULK)[0].sum(axis=1))
    words = "P of the thermal state at Omega = -4"
    return {
        "warm_energy": Variable((), energy.value, "energy a site of the bulk at Omega = -4"),
        "warm_energy_error": Variable((), energy.half, "its 95 % limits, to each side"),
        "warm_power": Variable(
            (), at_energy(thermal, float(energy.value))["power"], f"{words}, at that energy"
        ),
        "cold_power": Variable((), at_energy(thermal, 0.0)["power"], f"{words}, of no energy"),
    }


def _amplitudes(run: xr.Dataset) -> dict[str, Variable]:
    along, sizes = ("amplitude",), run["central_modulus"].values
    title = "factor by which l2 grew since tau = 10, the least of the members"
    return {
        "amplitude": Variable(along, sizes, "initial |A_0| = 5 |B_0| at Omega = -4"),
        "amplitude_factor": Variable(along, _varied(run)[1], title),
        "amplitude_end": Variable((), float(run["tau"][-1]), "slow time at the end of these runs"),
    }


def _tolerances(run: xr.Dataset) -> dict[str, Variable]:
    along, powers = ("tolerance",), mean_powers(run)
    limits = mean_limits(powers.T)
    title = "mean of |A_n|^2 + |B_n|^2 on the sites behind the front"
    return {
        "tolerance": Variable(along, run["tolerance"].values, "tolerance of dop853"),
        "tolerance_bulk_power": Variable(along, limits.value, title),
        "tolerance_bulk_power_error": Variable(along, limits.half, "its 95 % limits, to each side"),
    }


def _maxima(run: xr.Dataset, thermal: xr.Dataset) -> dict[str, Variable]:
    """Return the largest moduli of neighbours and the l-infinity norm beside the thermal ones."""
    found, sizes = unbounded_maximum(run, thermal).measured, run["neighbours"].values
    means = {of: [found[f"{of}_{n}_sites"] for n in sizes] for of in ("of", "thermal_of")}
    along, late = ("block",), "mean over the late half of the runs"
    about = thermal.sel(bound=means["thermal_of"][-1], method="nearest")
    index = float(about["bound_rate"] / -np.log(about["bound_overlap"]))
    return {
        "block_size": Variable(along, sizes, "neighbouring sites of a block"),
        "block_maximum": Variable(along, means["of"], f"largest modulus of a block, {late}"),
        "block_thermal": Variable(along, means["thermal_of"], "the same mean, thermal state"),
        "block_low": Variable((), found["bulk_at_least"], "least 95 % limit of their ratios"),
        "block_high": Variable((), found["bulk_at_most"], "largest 95 % limit of their ratios"),
        "extremal_index": Variable((), index, "extremal index of sites about the largest of them"),
        "norm_ratio": Variable(
            (), found["norm_over_thermal"],
            f"l-infinity norm over that of a chain in equilibrium up to the front, {late}",
        ),
        "norm_ratio_error": Variable(
            (), found["norm_over_thermal_error"], "its 95 % limits, to each side"
        ),
        "norm_ahead": Variable((), found["thermal_at_1e6"], "that norm of the chain, far ahead"),
        "norm_tau": Variable((), FAR_AHEAD, "slow time far ahead"),
    }  # fmt: skip


def keep_long_breathers(results: Path, folder: Path) -> None:
    """Keep the shares of the long studies of fates and of sensitivity, and the maps of fates."""
    fates, spread = (
        read(results / f"long/breathers/{name}.nc") for name in ("fates", "sensitivity")
    )
    whole = ("omega", "plane", "fate_name", "area", "area_low", "area_high")
    shares = ("size", "share", "share_low", "share_high")
    kept = {
        **{name: _as_it_is(fates[name]) for name in whole},
        **{name: _as_it_is(spread[name]) for name in shares},
        **{name: _as_it_is(fates[name]) for name in (*AXES, *MAPS)},
        **_nearness(fates),
        **_on_other_terms(fates),
        **_scanned(spread),
    }
    sizes = {"points": fates.sizes["a0"], "phases": fates.sizes["phase"]}
    about = {name: fates.attrs[name] for name in TERMS}
    title = "The long study of breathers, reduced to what the documents quote and a figure shows"
    more = {"members": spread.attrs["members"], "margin": MARGIN}
    _write(folder / "breathers.nc", title, kept, **about, **sizes, **more)


def _as_it_is(values: xr.DataArray) -> Variable:
    others = {name: one for name, one in values.attrs.items() if name.startswith("flag_")}
    about = (values.attrs["long_name"], values.attrs.get("units", "1"), others)
    return Variable(values.dims, values.values, *about)


AXES = ("a0", "b0", "turned_a0", "phase")
MARGIN = 2.0
"""By which factor the limit of P that does not return is changed, to see what rests on it."""


def _nearness(fates: xr.Dataset) -> dict[str, Variable]:
    """Return how much of what stays is periodic where A_0 and B_0 differ, by Omega, and how near.

    Shares of none are NaN.
    """
    unequal = fates["a0"] != fates["b0"]
    names = ["fate", "periodic", "unreturned", "breather_family", "family_distance"]
    here = fates[names].where(unequal & (fates["fate"] == FATES.index("stays")))
    stays, periodic = here["fate"].notnull(), here["periodic"] == 1
    left, distance = here["unreturned"], here["family_distance"]
    shares = {
        "periodic_share": ("share of what stays that is periodic", periodic, stays),
        "periodic_if_less": (
            f"the same if waves explained {MARGIN:g} times less P", left <= 1.0 / MARGIN, stays
        ),
        "periodic_if_more": (
            f"the same if waves explained {MARGIN:g} times more P", left <= MARGIN, stays
        ),
        "unknown_share": (
            "share of what stays of which it is not known whether it is periodic",
            here["periodic"] == -1, stays,
        ),
        "alone": ("share of breathers of the family with A only", here["breather_family"] == 1,
                  periodic),
        "compared": ("share of breathers whose family is known at their frequency",
                     distance.notnull(), periodic),
        "near": (f"share of these no further than {NEAR} from it", distance <= NEAR,
                 distance.notnull()),
    }  # fmt: skip
    found = {
        name: Variable(("omega",), some.where(whole).mean(("a0", "b0")).values, words)
        for name, (words, some, whole) in shares.items()
    }
    return found | {
        "median_distance": Variable(
            ("omega",), distance.median(("a0", "b0")).values, "median distance of these"
        )
    }


def _on_other_terms(fates: xr.Dataset) -> dict[str, Variable]:
    """Return how many data change their fate on other terms, and the shares of fates there."""
    checked = fates["checked_fate"]
    changed = (checked != checked.isel(conditions=0)).mean("checked")
    stay = checked == FATES.index("stays")
    shares = [(checked == kind).mean("checked").values for kind in range(fates.sizes["fate_name"])]
    return {
        "conditions": _as_it_is(fates["conditions"]),
        "changed": Variable(
            ("conditions", "omega"),
            changed.values,
            "share of data whose fate differs from the map's",
        ),
        "terms_share": Variable(
            ("fate_name", "conditions", "omega"),
            np.array(shares),
            "share of these data with a fate",
        ),
        "stay": Variable(
            (), int(stay.isel(conditions=0).sum()), "of these data that stay on the map"
        ),
        "stay_on": Variable(
            ("conditions",),
            (stay & stay.isel(conditions=0)).sum(("omega", "checked")).values,
            "of these data that stay on other terms too",
        ),
        "longest": Variable((), TIMES * fates.attrs["end_time"], "longest time of these runs"),
        "checked": Variable((), checked.sizes["checked"], "data at each Omega run on all terms"),
    }


def _scanned(spread: xr.Dataset) -> dict[str, Variable]:
    """Return the share that spreads of all amplitudes of the scan, and by unit of A_0."""
    amplitude = spread["initial"].values
    unit = np.minimum(np.floor(amplitude), np.ceil(amplitude.max()) - 1.0)
    starts = np.unique(unit)
    shares = [spread["spread"].values[unit == start].mean() for start in starts]
    return {
        "from_amplitude": Variable(("from_amplitude",), starts, "least A_0 of a unit of the scan"),
        "scan_share": Variable(("from_amplitude",), shares, "share of its amplitudes that spread"),
        "scanned": Variable((), len(amplitude), "amplitudes of the scan"),
        "scan_spread": Variable((), spread["spread"].values.mean(), "share of all that spread"),
        "largest_that_spreads": Variable(
            (), amplitude[spread["spread"].values == 1].max(), "largest A_0 that spreads"
        ),
    }


def main(results: Path, folder: Path = QUOTED) -> None:
    """Keep whatever of these the folder of results holds."""
    folder.mkdir(exist_ok=True)
    for needed, keep in {
        "claims.json": keep_full_run,
        "speed/reproduction.json": keep_reproduction,
        "long/unbounded/tolerances.nc": keep_long_study,
        "long/pendula/over_the_top.nc": keep_passages,
        "long/breathers/fates.nc": keep_long_breathers,
    }.items():
        if (results / needed).exists():
            keep(results, folder)


SECTIONS = ("cases", "sweeps", "solvers")
SECTIONS += ("chaos", "theory", "breathers", "pendula", "unbounded", "certified")
"""The sections of the configuration that claims rest on."""


def configuration() -> dict:
    """Return what config/*.yaml say of SECTIONS, but for long studies, which no claim reads."""
    files = [ROOT / f"config/{name}.yaml" for name in ("config", *STUDIES)]
    raw = {key: value for file in files for key, value in yaml.safe_load(file.read_text()).items()}
    whole = json.loads(load(raw).model_dump_json())
    kept = {name: whole[name] for name in SECTIONS}
    parts = ("periodic", "sensitivity", "fates")
    breathers = (kept["breathers"][name] for name in parts)
    for long in (kept["unbounded"], *breathers, kept["pendula"]["over_the_top"]):
        del long["long"]
    return kept


def keep_configuration() -> None:
    """Write it beside the module that compares other configurations with it, an entry a line."""
    sections = [
        ",\n".join(f'  "{name}": {json.dumps(value)}' for name, value in section.items())
        for section in configuration().values()
    ]
    pairs = zip(SECTIONS, sections, strict=True)
    text = ",\n".join(f' "{name}": {{\n{entries}\n }}' for name, entries in pairs)
    paper.FILE.write_text(f"{{\n{text}\n}}\n", encoding="utf-8")


if __name__ == "__main__":
    keep_configuration() if sys.argv[1] == "config" else main(Path(sys.argv[1]))
