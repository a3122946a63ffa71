"""Every number that the README and docs/ quote, as text, read from the datasets in tests/baseline.

A function stands for a topic, and its facts are named after what they are: a template says
`{{ chaos.rates }}`. No number is typed here. Arguments such as a time or a site say where in a
dataset a number stands; the text around the fact names them as well.
"""

import json
from fractions import Fraction
from pathlib import Path

import numpy as np
import study_errors
import xarray as xr
from pendula.configuration.messages import load
from pendula.datasets.netcdf import read
from pendula.datasets.registry import SOLVER_NAMES
from pendula.report.words import case_of, number, percent, span, symbols, with_error
from pendula.studies.pendula.claims_phases import pendula_norms
from pendula.studies.pendula.claims_remainder import STABLE, UNSTABLE, common_end

from benchmarks import reproduction

GROWN = 2.0
"""A norm grows if it grows by this factor, as the ledger has it."""

COMPARED = 1001, 100_001
"""Numbers of sites whose costs are compared."""

REGULAR_ERROR = 1e-10
"""The error at which solvers are compared."""

LATE, SITE = 60, 0.05
"""Half-widths that count as long in Fig 6, and a part of a site that no front can show."""


GROWING_LAWS = {
    "fourth_root": "fourth_root_of_log_tau",
    "log": "log_tau",
    "power": "power_of_tau",
}
"""Laws of the largest amplitude that have no bound, by a short name."""


class Baseline:
    """The datasets below tests/baseline by their names, each read once."""

    def __init__(self, folder: Path):
        self.folder = folder
        self._read = {}

    def __getitem__(self, name: str) -> xr.Dataset:
        if name not in self._read:
            self._read[name] = read(self.folder / f"{name}.nc")
        return self._read[name]

    def has(self, name: str) -> bool:
        """Return whether there is such a dataset."""
        return (self.folder / f"{name}.nc").exists()

    def claims(self) -> list[dict]:
        """Return the rows of the ledger of the last full run that was accepted."""
        return json.loads((self.folder / "quoted/claims.json").read_text(encoding="utf-8"))

    def reproduction(self) -> dict | None:
        """Return where the time of the whole reproduction went that was measured last, if any."""
        kept = self.folder / "quoted/reproduction.json"
        return json.loads(kept.read_text(encoding="utf-8")) if kept.exists() else None

    def mutation(self) -> dict:
        """Return the score of the last trial of mutants that was kept."""
        return json.loads((self.folder / "quoted/mutation.json").read_text(encoding="utf-8"))


def gather(baseline: Baseline, configuration: dict, chaos_study: dict) -> dict[str, dict]:
    """Return the facts of every topic; the last two are config.yaml and chaos.yaml as read."""
    topics = (
        ledger,
        solvers,
        second_solver,
        chaos,
        ensembles,
        lifetimes,
        breathers,
        fates,
        pendula,
        proofs,
        certified,
        unbounded,
        theory,
        references,
    )
    topics += (speed, pendula_speed, full_run, hard_cases, mutation)
    return {
        **{topic.__name__: topic(baseline) for topic in topics},
        **study_errors.facts(baseline),
        "configured": configured(configuration, chaos_study),
    }


def configured(configuration: dict, chaos_study: dict) -> dict:
    """Return parameters of solvers and of ensembles in the configuration."""
    given, drawn = load(configuration).solvers, chaos_study["chaos"]["ensembles"]
    return {
        "own_rtol": number(given.taylor.rtol),
        "members": number(drawn["members"]),
        "swept_members": number(drawn["sweeps"]["fig6_right"]["members"]),
        "size": number(drawn["size"]),
        "settled": number(chaos_study["chaos"]["lifetimes"]["settled"]),
    }


def ledger(baseline: Baseline) -> dict:
    """Return how many claims there are of each verdict, and those that do not hold."""
    rows = baseline.claims()
    verdicts = [row["verdict"] for row in rows]
    told = [
        {
            "place": row["place"],
            "says": symbols(row["says"]).replace("|", r"\|"),
            "verdict": row["verdict"],
            "because": symbols(row["because"]).replace("|", r"\|"),
        }
        for row in rows
        if row["verdict"] in ("not reproduced", "cannot be decided")
    ]
    return {
        "claims": str(len(rows)),
        "confirmed": str(verdicts.count("confirmed")),
        "caveat": str(verdicts.count("confirmed with a caveat")),
        "missed": str(verdicts.count("not reproduced")),
        "open": str(verdicts.count("cannot be decided")),
        "told": told,
        "ensemble": str(sum(row["name"].startswith("ensemble") for row in rows)),
        "papers": str(sum(row["place"] != "Beyond the paper" for row in rows)),
        "own": str(sum(row["place"] == "Beyond the paper" for row in rows)),
        "resting": str(sum(bool(row["rests_on"]) for row in rows)),
        "controls": str(sum(len(row["controls"]) for row in rows)),
        "failing": str(sum(not one["passes"] for row in rows for one in row["controls"])),
    }


def solvers(baseline: Baseline) -> dict:
    """Return how far the energy drifts by ode45, and when solvers leave each other or the truth."""
    found, trust = baseline["checks/solvers"], baseline["checks/trust"]
    cases = [found.sel(case=case) for case in found["case"].values]
    paper, high = "ode45 - crank_nicolson", "ode45 - dop853"
    conserving = "ode45 - delfour_fortin_payre"
    times = trust["horizon"].sel(level="visible")
    left = trust["case"].values[np.isfinite(times).any("solver").values]
    return {
        "cases": str(len(cases)),
        "visible": percent(found["visible"]),
        "early": number(found["until"].sel(span="early").max()),
        "whole": number(found["until"].sel(span="whole").max()),
        "allowed": number(found["allowed_drift"][0] / found["stated_drift"][0]),
        "kept": str(int(found["kept"].sel(solver="ode45", span="whole").sum())),
        "kept_early": str(int(found["kept"].sel(solver="ode45", span="early").sum())),
        "drift": [_drift(case) for case in cases],
        "diverged": str(int(np.isfinite(found["divergence_time"].sel(pair=paper)).sum())),
        "divergence": [
            {
                "case": case_of(case),
                "paper": _time(case["divergence_time"].sel(pair=paper)),
                "conserving": _time(case["divergence_time"].sel(pair=conserving)),
                "ode45": _time(case["divergence_time"].sel(pair=high)),
            }
            for case in cases
        ],
        "horizons": [
            {
                "case": case_of(trust.sel(case=case)),
                **{str(s): _time(times.sel(case=case, solver=s)) for s in trust["solver"].values},
            }
            for case in left
        ],
    }


def second_solver(baseline: Baseline) -> dict:
    """Return what the scheme and the step of the second solver decide, in the regular cases."""
    found, chaotic = baseline["checks/second_solver"], baseline["checks/lyapunov"]["chaotic"]
    step = float(found["step"][1])  # the steps are twice the configured one, itself, and half
    regular = found.sel(case=chaotic["case"].values[chaotic.values == 0])
    largest = regular["scheme_difference"].max("case")
    drifts = found["scheme_drift"].sel(step=step)
    return {
        "step": number(step),
        "least_drift": number(drifts.sel(scheme="crank_nicolson").min(), 2),
        "most_drift": number(drifts.sel(scheme="crank_nicolson").max(), 2),
        "conserving_drift": number(drifts.sel(scheme="delfour_fortin_payre").max(), 2),
        "regular": percent(largest.sel(scheme="crank_nicolson", step=step)),
        "halved": percent(largest.sel(scheme="crank_nicolson")[2]),
        "midpoint": percent(largest.sel(scheme="implicit_midpoint", step=step)),
        "conserving": percent(largest.sel(scheme="delfour_fortin_payre", step=step)),
    }


def _drift(case: xr.Dataset) -> dict[str, str]:
    drift = case["largest_drift"].sel(solver="ode45")
    return {
        "case": case_of(case),
        "stated": number(case["stated_drift"]),
        "early": number(drift.sel(span="early"), 2),
        "whole": number(drift.sel(span="whole"), 2),
    }


def _time(tau) -> str:
    """Return a time of an output, whose step of 0.025 five digits tell in single precision too."""
    return number(tau, 5) if np.isfinite(tau) else "never"


def _with_error(data: xr.Dataset, name: str) -> str:
    return with_error(float(data[name]), float(data[f"{name}_error"]))


def chaos(baseline: Baseline) -> dict:
    """Return the rates of growth of small perturbations, and when evenness is lost."""
    growth, even = baseline["checks/lyapunov"], baseline["checks/symmetry"]
    rates = growth["exponent"].max("parity")
    chaotic = growth["case"].values[growth["chaotic"].values > 0]
    return {
        "count": str(len(chaotic)),
        "cases": str(growth.sizes["case"]),
        "rows": [
            {
                "case": case_of(growth.sel(case=case)),
                **{
                    parity: _with_error(growth.sel(case=case, parity=parity), "exponent")
                    for parity in ("even", "odd")
                },
                "uneven": _time(even["rounded_time"].sel(case=case)),
            }
            for case in chaotic
        ],
        "regular_rate": number(rates.where(growth["chaotic"] == 0).max(), 2),
    }


def ensembles(baseline: Baseline) -> dict:
    """Return the widths of the bands of the ensembles, and the sweep of Fig 6, right."""
    bands, moments = baseline["checks/ensemble_runs"], baseline["checks/ensembles"]
    members = baseline["checks/members"]
    swept = moments.sel(sweep="fig6_right", quantity="pair", statistic="max", window="[10, 70]")
    swept = swept.dropna("half_width", subset=["l2_mean"])
    late = swept.where(swept["half_width"] >= LATE, drop=True)
    peak = swept.isel(half_width=int(swept["l2_mean"].values.argmax()))
    wide = swept.where(swept["half_width"] >= peak["half_width"], drop=True)
    scatter = wide["l2_deviation"] / wide["l2_mean"]
    return {
        "bands": [
            {
                "case": case_of(bands.sel(case=case)),
                "middle": number(bands["band_middle"].sel(case=case)),
                "width": percent(bands["band_width"].sel(case=case)),
                "ratio": number(members["width_ratio"].sel(case=case)),
                "limits": _limits(members.sel(case=case), "width_ratio"),
            }
            for case in bands["case"].values
        ],
        "share": percent(bands["band_share"]),
        "peak_at": number(peak["half_width"]),
        "peak": with_error(float(peak["l2_mean"]), float(peak["l2_error"])),
        "late_from": number(late["half_width"].min()),
        "late": span(late["l2_mean"].values, 2),
        "late_error": span(late["l2_error"].values, 1),
        "scatter": f"{percent(scatter.min())} to {percent(scatter.max())}",
    }


def _limits(data: xr.Dataset, name: str) -> str:
    """Return confidence limits; a time that no run lived to see is infinite."""
    low, high = (float(data[f"{name}_{end}"]) for end in ("low", "high"))
    return f"{number(low)} to {number(high)}" if np.isfinite(high) else f"over {number(low)}"


def _rate(life: xr.Dataset) -> str:
    """Return the rate of transitions, or what it is below where none was seen."""
    rate, high = float(life["rate"]), float(life["rate_high"])
    return number(rate, 2) if rate else f"below {number(high, 2)}"


def _chance(life: xr.Dataset) -> str:
    """Return the chance of the law of a rate, if transitions were seen."""
    return number(life["rate_chance"], 1) if float(life["rate"]) else "none seen"


def lifetimes(baseline: Baseline) -> dict:
    """Return how long the central pendulum stays localised, by its initial amplitude."""
    lives = baseline["checks/lifetimes"]
    differ = np.isfinite(lives["rate"].values)
    slow, fast = lives.isel(start_amplitude=differ), lives["median"].isel(start_amplitude=~differ)
    coarse = lives.isel(choice=int(lives["choice_tolerance"].values.argmax()))
    return {
        "from": number(slow["start_amplitude"].min()),
        "end": number(lives["tau"].max()),
        "fast": span(fast.values, 2),
        "rows": [
            {
                "case": number(a0),
                "kept": percent(slow["surviving"].sel(start_amplitude=a0)[-1]),
                "rate": _rate(slow.sel(start_amplitude=a0)),
                "limits": _limits(slow.sel(start_amplitude=a0), "rate"),
                "chance": _chance(slow.sel(start_amplitude=a0)),
            }
            for a0 in slow["start_amplitude"].values
        ],
        "coarse": number(coarse["choice_tolerance"]),
        "coarse_drift": number(coarse["choice_drift"], 1),
        "coarse_rate": number(coarse["choice_rate"], 2),
        "compared": number(lives["compared_amplitude"]),
    }


def breathers(baseline: Baseline) -> dict:
    """Return what the claims on breathers measured, and the shares of runs that spread."""
    rows = {row["name"]: row["measured"] for row in baseline.claims()}
    growth, spread = baseline["breathers/growth"], baseline["breathers/sensitivity"]
    law, scanned = rows["grows_by_drive"], spread["initial"].values
    return {
        "omega": number(spread.attrs["omega"]),
        "least_power": number(rows["data_below_breathers"]["least_power"]),
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
                "limits": _from_to(spread["share_low"], spread["share_high"], size=size),
            }
            for size in spread["size"].values
        ],
    }


def _from_to(low: xr.DataArray, high: xr.DataArray, **at) -> str:
    return " to ".join(percent(one.sel(at)) for one in (low, high))


def fates(baseline: Baseline) -> dict:
    """Return shares of fates, and of runs that spread, from the long study of breathers."""
    long = baseline["quoted/breathers"]
    start = long["from_amplitude"].values
    families = long.dropna("omega", subset=["near"])
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
        "near": [
            {
                "omega": number(omega),
                "share": percent(families["near"].sel(omega=omega)),
                "alone": percent(families["nearest_alone"].sel(omega=omega)),
                "median": number(families["median_distance"].sel(omega=omega), 2),
            }
            for omega in families["omega"].values
        ],
        "checked": number(long["checked"]),
        "terms": [
            {
                "cases": str(terms),
                "changed": percent(long["changed"].sel(terms=terms).max()),
                "breather": percent(_at_most_mixed(long, terms, "breather")),
                "spreads": percent(_at_most_mixed(long, terms, "spreads")),
            }
            for terms in long["terms"].values
        ],
        "mixed": number(_most_mixed(long)),
    }


OF_PLANE = {"amplitudes": "real A_0 and B_0", "phases": "A_0 and a phase"}


def _area(long: xr.Dataset, plane: str, omega: float, fate: str) -> str:
    """Return the share of an area in per cent with its limits, to three digits."""
    one = long.sel(plane=plane, omega=omega, fate_name=fate)
    names = ("area", "area_low", "area_high")
    value, low, high = (number(100.0 * float(one[name]), 3) for name in names)
    return f"{value} % ({low} to {high})"


def _most_mixed(long: xr.Dataset) -> float:
    """Return the Omega at which other terms change the most fates."""
    return float(long["omega"][int(long["changed"].max("terms").argmax("omega"))])


def _at_most_mixed(long: xr.Dataset, terms: str, fate: str) -> float:
    at = {"fate_name": fate, "terms": terms, "omega": _most_mixed(long)}
    return float(long["terms_share"].sel(at))


def pendula(baseline: Baseline) -> dict:
    """Return what Lemma 1 is for the pendula themselves, at the paper's detunings."""
    data = baseline["pendula/threshold"]
    largest = float(data["mu"].max())
    taken = (data["curve_gamma_0"].sel(mu=largest) == 0.0) & (data["curve_gamma_0_lemma"] > 0.0)
    norms = pendula_norms(baseline["pendula/phases"]).measured
    return {
        **_passages(baseline["quoted/pendula"]),
        "norms_mu": number(norms["at_mu"]),
        "orders": f"{number(norms['least_order'])} to {number(norms['largest_order'])}",
        "largest_mu": number(largest),
        "second_below": number(data["curve_omega"].where(taken).max()),
        "rows": [
            {"mu": number(mu), **{side: number(data["gamma_0"].sel(omega=omega, mu=mu), 12)
                                  for side, omega in (("below", -4.0), ("above", 8.0))}}
            for mu in data["mu"].values
        ],
        **_expansion(baseline["pendula/remainder"]),
    }  # fmt: skip


def _passages(long: xr.Dataset) -> dict:
    """Return who goes over the top in the long study, and how the angles grow then."""
    return {
        "end": number(long.attrs["end_time"]),
        "passing_members": number(long.attrs["members"]),
        "passages": [
            {
                "mu": number(mu, 4),
                "share": _with_limits(long.sel(mu=mu), "passed", percent),
                "median": _median(float(long["passage_median"].sel(mu=mu))),
                "rate": _with_limits(long.sel(mu=mu), "passage_rate", lambda one: number(one, 2)),
                "turns": number(long["turns"].sel(mu=mu)),
            }
            for mu in long["mu"].values
        ],
    }


def _median(tau: float) -> str:
    return number(tau) if np.isfinite(tau) else "later"


def _with_limits(one, name: str, write) -> str:
    """Return a number with its confidence limits; a dash where it is not known."""
    values = [float(one[f"{name}{end}"]) for end in ("", "_low", "_high")]
    if np.isnan(values[0]):
        return "-"
    value, low, high = map(write, values)
    return f"{value} ({low} to {high})"


def proofs(baseline: Baseline) -> dict:
    """Return how near true breathers and true constants are proved to be, rounded upward."""
    proved, constants = baseline["certified/breathers"], baseline["certified/constants"]
    return {
        "states": str(proved.sizes["proof"]),
        "radius": number(1.05 * float(proved["radius"].max()), 2),
        "unique": number(0.95 * float(proved["unique_radius"].min()), 2),
        "chain_sites": str(2 * int(proved.attrs["chain_half_width"]) + 1),
        "stable": str(int((proved["stable"] == 1).sum())),
        "unstable": str(int((proved["stable"] == 0).sum())),
        "bits": str(int(proved.attrs["bits"])),
        "constants": str(constants.sizes["constant"]),
        "constants_off": number(1.05 * float(constants["stored_error"].max()), 2),
    }


def certified(baseline: Baseline) -> dict:
    """Return the proven bounds of curves, rounded upward, what lines contain, and a short proof."""
    lines = baseline["certified/lines"]
    cases = [str(case) for case in lines["case"].values]
    framed = [case for case in cases if baseline.has(f"proofs/{case}")]
    known = [case for case in cases if baseline.has(f"certified/{case}")] + framed
    curves = {
        case: baseline[f"proofs/{case}" if case in framed else f"certified/{case}"]
        for case in known
    }
    whole = lines["contained_until"] == lines["run_end"]
    share = lines["largest_distance"] / lines["half_line"]
    return {
        "rows": [_certified_curve(curves[case], case) for case in known if case not in framed],
        "framed": [
            {
                **_certified_curve(curves[case], case),
                "growth": number(float(curves[case]["error_exponent"][-1]), 2),
            }
            for case in framed
        ],
        "bound": _upward(max(curves[case]["bound"].max() for case in known if case not in framed)),
        "contained": number(int(whole.sum())),
        "in_lines": _upward(share.where(np.isfinite(share)).max()),
        "certificate": _short_case(baseline.folder / "proofs/short_case.json"),
    }


def _upward(bound) -> str:
    """Return two digits of a number that is no smaller than the bound."""
    return number(1.05 * float(bound), 2)


def _certified_curve(curve: xr.Dataset, case: str) -> dict[str, str]:
    last = curve.isel(tau=int(curve["bound"].argmax("tau")))
    largest = last["bound_parts"].argmax("bound_part")
    return {
        "case": case,
        "end": number(float(curve["tau"][-1])),
        "bound": _upward(last["bound"]),
        "part": str(curve["bound_part"].values[int(largest)]),
        "of_part": number(float(last["bound_parts"][largest]), 2),
        "distance": number(float(curve["reference_distance"].max()), 2),
    }


def _short_case(path: Path) -> dict[str, str]:
    made = json.loads(path.read_text(encoding="utf-8"))
    return {
        "sites": number(len(made["initial"][0])),
        "steps": number(len(made["steps"])),
        "end": number(float(Fraction(made["end_time"]))),
        "bound": _upward(made["steps"][-1]["bound"] / 2 ** made["bound_bits"]),
    }


def _expansion(data: xr.Dataset) -> dict[str, str]:
    """Return orders in mu of the error of the expansion, and from when on it is visible."""
    end = common_end(data)
    there = data.sel(case=list(STABLE), end=end)
    constant = there["error_constant"].sel(expansion="leading")
    visible = data["visible_from"].sel(expansion="leading", case=UNSTABLE)
    times = visible.where(np.isfinite(visible), drop=True)
    early, late = times.sel(mu=EARLY_MU), times[-1]
    return {
        **{name: number(there["order"].sel(expansion=name).mean())
           for name in ("leading", "corrected")},
        "common_end": number(end),
        "least_constant": number(constant.min()),
        "largest_constant": number(constant.max()),
        "early_mu": number(early["mu"]),
        "visible_early": number(early),
        "late_mu": number(late["mu"]),
        "visible_late": number(late),
    }  # fmt: skip


EARLY_MU = 0.1
"""The mu from which on the horizon at Omega = 0 is told."""


def unbounded(baseline: Baseline) -> dict:
    """Return exponents, fronts and powers of the long study of the chain without ends."""
    long = baseline["quoted/unbounded"]
    bulk, large = (long.sel(case=case) for case in ("fig4_small", "fig3_large"))
    centre = long.sel(varied_omega=0.0)
    ratio = long["omega_bulk_power"] / long["omega_thermal_power"]
    furthest = long.isel(varied_omega=int(abs(ratio - 1.0).values.argmax()))
    off = abs(long["omega_bulk_power"] - long["omega_thermal_power"])
    missed = abs(float(bulk["bulk_power"]) - float(centre["omega_thermal_power"]))
    apart = long["varied_omega"].where(off > long["omega_bulk_power_error"], drop=True)
    speeds = abs(long["omega_speed"] / long["omega_predicted_speed"] - 1.0)
    agree = abs(long["omega_speed"] - long["omega_predicted_speed"]) <= long["omega_speed_error"]
    grown = long["amplitude"].where(long["amplitude_factor"] > GROWN, drop=True)
    cut, cost = baseline["quoted/cut_front"], baseline["speed/cost"]
    return {
        "end": number(bulk["end"], 4),
        "from": number(bulk["end"] / 4, 4),
        "members": str(int(bulk["members"])),
        "sites": f"{int(bulk['sites']):,}",
        "exponent": _with_error(bulk, "exponent"),
        "linf": number(bulk["linf"]),
        "speed": _with_error(bulk, "speed"),
        "predicted": number(bulk["predicted_speed"], 5),
        "bulk_power": _with_error(bulk, "bulk_power"),
        "slope_power": _with_error(bulk, "slope_power"),
        "bulk_off": percent(missed / float(centre["omega_thermal_power"])),
        "bulk_limits": percent(float(bulk["bulk_power_error"] / bulk["bulk_power"])),
        "thermal_power": number(centre["omega_thermal_power"], 5),
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
        "centre_length": number(centre["omega_correlation_length"], 2),
        "warm_energy": _with_error(long, "warm_energy"),
        "warm_bulk_power": _with_error(large, "bulk_power"),
        "warm_power": number(long["warm_power"], 4),
        "cold_power": number(long["cold_power"], 4),
        "amplitudes": str(long.sizes["amplitude"]),
        "spreading": " and ".join(number(size) for size in grown.values),
        "amplitude_end": number(long["amplitude_end"]),
        "large_speed": number(large["speed"], 2),
        "large_exponent": _with_error(large, "exponent"),
        "large_from": number(large["end"] / 4, 4),
        "large_end": number(large["end"], 4),
        "small_growth": _with_error(long.sel(case="fig3_small"), "growth"),
        "stable_growth": _with_error(long.sel(case="fig2_large"), "growth"),
        "grown": number(GROWN),
        **_laws(long),
        "tolerances": ", ".join(
            _with_error(long.isel({"tolerance": i}), "tolerance_bulk_power")
            + f" at {number(tolerance)}"
            for i, tolerance in enumerate(long["tolerance"].values)
        ),
        "rest": number(long.attrs["rest"]),
        "cut": number(cut.attrs["cut"]),
        "cut_lag": number(cut["lag"][-1], 2),
        "cut_end": number(cut["end"][-1], 4),
        "uncut_end": number(cut["end"].where(abs(cut["lag"]) < SITE).max(), 4),
        "site_memory": number(cost["active_memory"][-1]),
        "site_factor": number(cost["active_seconds"].max() / cost["active_seconds"].min(), 2),
        "site_times": [
            {"width": f"{int(width):,}", "time": number(1e6 * seconds)}
            for width, seconds in zip(
                cost["active_width"].values, cost["active_seconds"].values, strict=True
            )
        ],
    }


def _laws(long: xr.Dataset) -> dict[str, str]:
    """Return how bounded and growing laws of l-infinity fit, and what the growing ones predict."""
    ahead = long["law_ahead"]
    return {
        "spans": str(int(long["law_spans"])),
        "bounded_off": number(long["law_chi2"].sel(law="limit_less_1_over_root_tau")),
        **{
            f"{short}_off": number(long["law_chi2"].sel(law=law), 2)
            for short, law in GROWING_LAWS.items()
        },
        **{f"{short}_ahead": number(ahead.sel(law=law)) for short, law in GROWING_LAWS.items()},
        "far": number(long["law_tau"]),
    }


def theory(baseline: Baseline) -> dict:
    """Return what the checks of Lemma 1 and of Theorems 1 to 3 found."""
    charts = [baseline[f"checks/{name}"]["measured"] for name in ("chart", "short_chart")]
    sharp, threshold = baseline["checks/sharpness"], baseline["checks/threshold"]
    slow = threshold["spreading_exponent"].mean("omega").isel(decay=1)
    reached = sharp["reached"].isel(sites=-1)
    bootstrap = baseline["checks/bootstrap"]
    printed, gap = baseline["checks/theorem_3_constant"], baseline["checks/theorem_2_case"]
    measured = {row["name"]: row["measured"] for row in baseline.claims()}
    cases = baseline["checks/cases"]
    return {
        "cells": str(sum(chart.size for chart in charts)),
        "misclassified": str(int(measured["stable_below"]["misclassified"]) or "none"),
        "stable_rate": number(measured["stable_below"]["fastest"], 2),
        "decay": number(slow["decay"]),
        "slow_l2": number(slow.sel(norm="l2"), 2),
        "slow_linf": number(slow.sel(norm="linf"), 2),
        "sites": str(int(sharp["sites"][-1])),
        **{
            f"short_of_{form}": percent(1.0 - reached.sel(form=form), 2)
            for form in ("theorem_1", "theorem_2", "theorem_3")
        },
        "reached_ball": number(reached.sel(form="theorem_2_ball"), 2),
        "proof_constant": number(sharp["proof_constant"]),
        "least_constant": number(sharp["least_constant"]),
        "observed": span(cases["ratio"].values, 2),
        "broken_sites": number(printed["smallest"]),
        "printed_order": number(measured["printed_time"]["order"], 2),
        "right_order": number(measured["slow_time"]["order"], 2),
        "start": number(gap["start"]),
        "radius": number(gap["delta_0"]),
        "widened_radius": number(gap["widened_delta_0"]),
        "widened_bound": number(gap["widened_bound"]),
        "breaking": number(bootstrap["breaking"]),
        "allowed": number(bootstrap["allowed_power"]),
        "barrier": number(bootstrap["barrier_power"]),
    }


def references(baseline: Baseline) -> dict:
    """Return how well the references are known, and when the double next to a tenth shows."""
    trust = baseline["checks/trust"]
    known = [
        float(baseline[f"reference/{case}"].attrs["largest_discrepancy"])
        for case in trust["case"].values
    ]
    return {
        "discrepancy": number(max(known), 2),
        "decimals": number(trust["decimal_size"][0]),
        "first": _time(trust["decimal_horizon"][0]),
        "visible": percent(trust["decimal_size"][1]),
        "seen": _time(trust["decimal_horizon"][1]),
    }


def speed(baseline: Baseline) -> dict:
    """Return times at equal error, and the growth of the cost."""
    measured, cost = baseline["speed/work_precision"], baseline["speed/cost"]["seconds"]
    titles = measured["title"].to_series()
    ratios = measured["mean_ratio"].dropna("peer").to_series()
    tight = measured.sel(case=["fig2_small", "fig3_small"], contestant="taylor")
    errors = tight["error"].where(tight["accuracy"] < 1.5e-14)
    short, long = (cost.sel(sites=sites) for sites in COMPARED)
    return {
        "peers": [
            {
                "peer": titles[peer],
                "ratio": _ratio(ratio),
                "cases": str(int(measured["reached_cases"].sel(peer=peer))),
            }
            for peer, ratio in ratios.items()
        ],
        "best": [
            {"solver": SOLVER_NAMES[name], "time": number(1e3 * seconds, 2)}
            for name, seconds in _best(measured.sel(case="fig3_small"), REGULAR_ERROR).items()
        ],
        "processor": measured.attrs["processor"],
        "best_error": number(REGULAR_ERROR),
        "fastest_below": number(_fastest_below(measured, "taylor")),
        "faster": " and ".join(titles[peer] for peer, ratio in ratios.items() if ratio < 1),
        "taylor_error": number(float(errors.max()), 2),
        "sites": [
            {"sites": str(n), **_growth(1e6 * cost.sel(sites=n))} for n in cost["sites"].values
        ],
        "long_over_short": {"sites": f"{COMPARED[1]} over {COMPARED[0]}", **_growth(long / short)},
    }


def pendula_speed(baseline: Baseline) -> dict:
    """Return how many times as long peers take on Newton's equations, at equal error."""
    measured = baseline["speed/pendula"]
    titles = measured["title"].to_series()
    ratios = {str(peer): measured["ratio"].sel(peer=peer) for peer in measured["peer"].values}
    return {
        "target": measured.attrs["compared_at"],
        "peers": [
            {"peer": titles[peer], "ratio": " and ".join(map(_ratio, found.dropna("case").values))}
            for peer, found in ratios.items()
            if found.notnull().any()
        ],
    }


MANY = 12
"""So many jobs of a full run are shown, the costliest."""


def full_run(baseline: Baseline) -> dict:
    """Return what the time of a full run went to, with and without kernels compiled before."""
    if not (measured := baseline.reproduction()):
        return {"runs": []}
    full = {name: one for name, one in measured["runs"].items() if one["jobs"]}
    shares = {
        kind: [sum(told.get(kind, 0.0) for told in one["jobs"].values()) for one in full.values()]
        for kind in reproduction.KINDS
    }
    shares[reproduction.SNAKEMAKE] = [reproduction.rest(one) for one in full.values()]
    jobs = full["warm"]["jobs"]
    costliest = sorted(jobs, key=lambda name: -reproduction.spent(jobs[name]))[:MANY]
    return {
        "processor": measured["machine"]["processor"],
        "cores": str(measured["machine"]["cores"]),
        "runs": [
            {
                "run": reproduction.RUNS[name],
                **{key: f"{one[key]:.0f}" for key in ("wall", "processor")},
            }
            for name, one in measured["runs"].items()
        ],
        "columns": [{"run": reproduction.RUNS[name]} for name in full],
        "kinds": [
            {"kind": kind, "in_runs": [{"seconds": f"{value:.1f}"} for value in values]}
            for kind, values in shares.items()
        ],
        "jobs": [
            {
                "job": name,
                **{
                    kind.replace("-", "_"): f"{jobs[name].get(kind, 0.0):.1f}"
                    for kind in reproduction.KINDS
                    if kind != "imports"
                },
                "sum": f"{reproduction.spent(jobs[name]):.1f}",
            }
            for name in costliest
        ],
        "number": str(len(jobs) - ("imports" in jobs)),
        "memory": number(
            max(told["memory"] for one in full.values() for told in one["jobs"].values())
        ),
    }


def _growth(cost: xr.DataArray) -> dict[str, str]:
    return {name: number(float(cost.sel(solver=name))) for name in ("dop853", "taylor")}


def _ratio(value: float) -> str:
    """Return a factor to two or three digits, without a power of ten."""
    return f"{float(f'{value:.3g}'):.0f}" if value >= 10 else number(value, 2)


def _best(case: xr.Dataset, error: float) -> dict[str, float]:
    """Return the least time, in s, in which each solver comes within an error, the least first."""
    own = case.sel(contestant=case["solver"].values)
    least = own["seconds"].where(own["error"] <= error).min("point").dropna("contestant")
    return least.to_series().sort_values().to_dict()


def _fastest_below(measured: xr.Dataset, solver: str) -> float:
    """Return the largest power of ten below which the solver is the fastest in every case."""
    below = None
    for error in 10.0 ** np.arange(-13, 0):
        found = [_best(measured.sel(case=case), error) for case in measured["case"].values]
        if any(best and next(iter(best)) != solver for best in found):
            break
        below = error
    return below


def hard_cases(baseline: Baseline) -> dict:
    """Return how many hard cases there are, and the energy over a long time on a short chain."""
    cases = baseline["quoted/hard_cases"]
    long = cases.where(cases["reference"] == "the energy at the start", drop=True)
    return {
        "runs": str(cases.sizes["row"]),
        "refused": str(int((cases["refusal"] != "").sum())),
        "unexpected": str(int((cases["sound"] == 0).sum()) or "none"),
        "energy": [
            {"solver": solver, "drift": number(drift, 2)}
            for solver, drift in zip(long["solver"].values, long["error"].values, strict=True)
        ],
    }


def mutation(baseline: Baseline) -> dict:
    """Return which part of the mutants of decisive modules the tests notice."""
    kept = baseline.mutation()
    return {
        "modules": str(kept["modules"]),
        "mutants": f"{kept['mutants']:,}",
        "sample": str(kept["sample"]),
        "score": percent(kept["score"], 3),
        "low": percent(kept["low"], 3),
        "high": percent(kept["high"], 3),
        "confidence": percent(kept["confidence"]),
        "limits": " that plain Python can run" if kept["plain"] else "",
    }
