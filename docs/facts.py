"""What the README and docs/ quote beside the sections of the report, as text.

These are the counts of the ledger, the long studies, which no full run makes, proofs rounded
upward, and what was measured of speed and of the tests. A function stands for a topic: a template
says `{{ long.exponent }}`. No number is typed here.
"""

import json
from collections import Counter
from fractions import Fraction
from pathlib import Path

import numpy as np
import xarray as xr
from pendula.datasets.json_files import load_json
from pendula.datasets.netcdf import read
from pendula.ledger.claim import Origin
from pendula.ledger.criterion import Verdict
from pendula.ledger.tables import tally
from pendula.report.words import number, percent, with_error
from pendula.studies.breathers.section import share_with_limits

from benchmarks import reproduction

BASELINE = Path(__file__).resolve().parents[1] / "tests/baseline"


class Baseline(dict):
    """The datasets below tests/baseline by their names, each read once."""

    def __missing__(self, name: str) -> xr.Dataset:
        self[name] = read(BASELINE / f"{name}.nc")
        return self[name]


def topics(baseline: Baseline) -> dict[str, dict]:
    """Return the facts of every topic."""
    return {
        "ledger": ledger(load_json(BASELINE / "claims.json")["rows"]),
        "long": long(baseline["quoted/unbounded"], baseline["quoted/cut_front"]),
        "fates": fates(baseline["quoted/breathers"]),
        "passages": passages(baseline["quoted/pendula"]),
        "proved": proved(baseline),
        "speeds": speeds(baseline),
        "full_run": full_run(_kept("reproduction")),
        "mutation": mutation(_kept("mutation")),
    }


def _kept(name: str) -> dict:
    return json.loads((BASELINE / f"quoted/{name}.json").read_text(encoding="utf-8"))


def ledger(rows: list[dict]) -> dict[str, str]:
    """Return how many claims there are of each origin and verdict, and how many controls."""
    counts = {origin: Counter(tally(rows).get(origin, {})) for origin in Origin}
    of_paper = counts[Origin.PAPER]
    return {
        "papers": str(of_paper.total()),
        "confirmed": str(of_paper[Verdict.CONFIRMED]),
        "caveat": str(of_paper[Verdict.CAVEAT]),
        "missed": str(of_paper[Verdict.NOT_REPRODUCED]),
        "open": str(of_paper[Verdict.UNDECIDED]),
        "questions": str(counts[Origin.OPEN].total()),
        "own": str(counts[Origin.OWN].total()),
        "resting": str(sum(bool(row["rests_on"]) for row in rows)),
        "controls": str(sum(len(row["controls"]) for row in rows)),
        "failing": str(sum(not one["passes"] for row in rows for one in row["controls"])),
    }


def long(study: xr.Dataset, cut: xr.Dataset) -> dict[str, str]:
    """Return the growth of norms on the infinite chain; `cut` is of the run with a cut edge."""
    bulk, large = (study.sel(case=case) for case in ("fig4_small", "fig3_large"))
    ratio = study["omega_bulk_power"] / study["omega_thermal_power"]
    off = abs(study["omega_bulk_power"] - study["omega_thermal_power"])
    apart = study["varied_omega"].where(off > study["omega_bulk_power_error"], drop=True)
    exponents = study["omega_exponent"]
    return {
        "end": number(bulk["end"], 4),
        "members": str(int(bulk["members"])),
        "sites": f"{int(bulk['sites']):,}",
        **{name: _with_error(bulk, name)
           for name in ("exponent", "speed", "bulk_power", "slope_power")},
        "predicted": number(bulk["predicted_speed"], 5),
        "thermal_power": number(study["omega_thermal_power"].sel(varied_omega=0.0), 5),
        "omegas": str(study.sizes["varied_omega"]),
        "omega_end": number(study["omega_end"]),
        "exponents": f"{number(exponents.min(), 2)} to {number(exponents.max(), 2)}",
        "apart": ", ".join(map(number, apart.values)) or "none of them",
        "furthest": percent(abs(ratio - 1.0).max()),
        "large_end": number(large["end"], 4),
        "large_exponent": _with_error(large, "exponent"),
        "small_growth": _with_error(study.sel(case="fig3_small"), "growth"),
        "cut": number(cut.attrs["cut"]),
        "cut_lag": number(cut["lag"][-1], 2),
        "cut_end": number(cut["end"][-1], 4),
        "stable_growth": _with_error(study.sel(case="fig2_large"), "growth"),
    }  # fmt: skip


def _with_error(data: xr.Dataset, name: str) -> str:
    return with_error(float(data[name]), float(data[f"{name}_error"]))


PERIODIC = ("periodic_share", "periodic_if_less", "periodic_if_more", "alone", "near")
PLANES = {"amplitudes": "real A_0 and B_0", "phases": "A_0 and the phase of B_0"}


def fates(study: xr.Dataset) -> dict:
    """Return shares of fates, and of runs that spread, from the long study of breathers."""
    shares = [(number(size), percent(study["share"].sel(size=size)))
              for size in study["size"].values]  # fmt: skip
    return {
        "end": number(study.attrs["end_time"]),
        "members": number(study.attrs["members"]),
        "points": number(study.attrs["points"]),
        "spread": ", ".join(f"{share} at {size}" for size, share in shares),
        "rows": [
            [number(omega), PLANES[str(plane)], *(
                share_with_limits(study.sel(plane=plane, omega=omega, fate_name=fate))
                for fate in ("disperses", "stays", "moves", "spreads"))]
            for plane in study["plane"].values for omega in study["omega"].values
        ],
        "periodic": [
            [number(omega), *(percent(one[name]) for name in PERIODIC)]
            for omega in study["omega"].values for one in [study.sel(omega=omega)]
            if np.isfinite(one["near"])
        ],
    }  # fmt: skip


def passages(study: xr.Dataset) -> dict:
    """Return which pendula go over the top in the long study, and how the angles grow then."""
    return {
        "end": number(study.attrs["end_time"]),
        "members": number(study.attrs["members"]),
        "rows": [_passage(study.sel(mu=mu)) for mu in study["mu"].values],
    }


def _passage(one: xr.Dataset) -> list[str]:
    median = float(one["passage_median"])
    return [
        number(one["mu"], 4),
        _with_limits(one, "passed", percent),
        number(median) if np.isfinite(median) else "later",
        _with_limits(one, "passage_rate", lambda rate: number(rate, 2)),
        number(one["turns"]),
    ]


def _with_limits(one: xr.Dataset, name: str, write) -> str:
    """Return a number with its confidence limits; a dash where it is not known."""
    values = [float(one[f"{name}{end}"]) for end in ("", "_low", "_high")]
    value, low, high = map(write, values)
    return "-" if np.isnan(values[0]) else f"{value} ({low} to {high})"


def proved(baseline: Baseline) -> dict:
    """Return the proven bounds of curves and states, and the bound of the short certificate."""
    lines, breathers = baseline["certified/lines"], baseline["certified/breathers"]
    cases = [str(case) for case in lines["case"].values]
    framed = {case for case in cases if (BASELINE / f"proofs/{case}.nc").exists()}
    curves = {case: baseline[f"{'proofs' if case in framed else 'certified'}/{case}"]
              for case in cases}  # fmt: skip
    whole = lines["contained_until"] == lines["run_end"]
    share = lines["largest_distance"] / lines["half_line"]
    short = json.loads((BASELINE / "proofs/short_case.json").read_text(encoding="utf-8"))
    return {
        "rows": [_curve(case, one) for case, one in curves.items() if case not in framed],
        "framed": [
            [*_curve(case, one), number(one["error_exponent"][-1])]
            for case, one in curves.items() if case in framed
        ],
        "count": str(len(curves)),
        "largest": _upward(max(one["bound"].max() for one in curves.values())),
        "until": number(min(float(one["tau"][-1]) for one in curves.values())),
        "contained": number(int(whole.sum())),
        "in_lines": _upward(share.where(whole & np.isfinite(share)).max()),
        "short_sites": number(len(short["initial"][0])),
        "short_steps": number(len(short["steps"])),
        "short_end": number(float(Fraction(short["end_time"]))),
        "short_bound": _upward(short["steps"][-1]["bound"] / 2 ** short["bound_bits"]),
        "states": str(breathers.sizes["proof"]),
        "radius": _upward(breathers["radius"].max()),
        "unique": number(float(breathers["unique_radius"].min()) / UPWARD, 2),
        "stable": str(int((breathers["stable"] == 1).sum())),
        "unstable": str(int((breathers["stable"] == 0).sum())),
        "constants_off": _upward(baseline["certified/constants"]["stored_error"].max()),
    }  # fmt: skip


UPWARD = 1.05
"""By so much a bound grows before two of its digits are printed: they are then no smaller."""


def _upward(bound) -> str:
    return number(UPWARD * float(bound), 2)


def _curve(case: str, curve: xr.Dataset) -> list[str]:
    last = curve.isel(tau=int(curve["bound"].argmax("tau")))
    part = last.isel(bound_part=int(last["bound_parts"].argmax("bound_part")))
    return [
        f"`{case}`",
        number(float(curve["tau"][-1])),
        _upward(last["bound"]),
        f"{part['bound_part'].item()}: {number(part['bound_parts'], 2)}",
        number(float(curve["reference_distance"].max()), 2),
    ]


def speeds(baseline: Baseline) -> dict:
    """Return the growth of the cost with the sites in µs, and peers on Newton's equations."""
    pendula, cost = baseline["speed/pendula"], baseline["speed/cost"]["seconds"]
    titles, ratios = pendula["title"].to_series(), pendula["ratio"].transpose("peer", "case")
    return {
        "processor": baseline["speed/work_precision"].attrs["processor"],
        "target": pendula.attrs["compared_at"],
        "peers": [
            [titles[str(one["peer"].values)], " and ".join(map(number, one.dropna("case").values))]
            for one in ratios if one.notnull().any()
        ],
        "sites": [
            [str(sites), *(number(1e6 * cost.sel(sites=sites, solver=one))
                           for one in ("dop853", "taylor"))]
            for sites in cost["sites"].values
        ],
    }  # fmt: skip


def full_run(measured: dict) -> dict:
    """Return the wall and processor time of whole runs in seconds, and their disk space in MB."""
    return {
        "processor": measured["machine"]["processor"],
        "cores": str(measured["machine"]["cores"]),
        "cold": f"{measured['runs']['cold']['wall']:.0f}",
        **{name: str(size) for name, size in measured["megabytes"].items()},
        "rows": [
            [reproduction.RUNS[name], f"{one['wall']:.0f}", f"{one['processor']:.0f}"]
            for name, one in measured["runs"].items()
        ],
    }


def mutation(kept: dict) -> dict[str, str]:
    """Return which part of the mutants of decisive modules the tests noticed, and when."""
    shares = {name: percent(kept[name], 3) for name in ("score", "low", "high", "confidence")}
    sizes = {name: f"{kept[name]:,}" for name in ("modules", "mutants", "sample")}
    return shares | sizes | {"date": kept["date"]}


def needs(needed: dict[str, dict], reached: dict[str, dict]) -> dict[str, dict[str, str]]:
    """Return the needed and the reached error of each part of a study, as two cells."""
    return {
        study: {
            part: f"{number(needed[study][part])} | {number(error, 2)}"
            for part, error in parts.items()
        }
        for study, parts in reached.items()
    }
