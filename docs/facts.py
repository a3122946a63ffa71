"""What the README and docs/ quote, as text.

These are the counts of the ledger, a long study, proofs rounded upward, and what was measured of
speed and of the tests. A function stands for a topic: a template says `{{ long.exponent }}`. No
number is typed here.
"""

import json
from pathlib import Path

import numpy as np
import xarray as xr
from latticode.datasets.json_files import load_json
from latticode.datasets.netcdf import read
from latticode.datasets.registry import SOLVER_NAMES
from pendula.article.values import counts, upward
from pendula.report.words import case_of, number, with_error

from benchmarks import reproduction
from benchmarks import scale as scale_of

BASELINE = Path(__file__).resolve().parents[1] / "tests/baseline"


class Baseline(dict):
    """The datasets below tests/baseline by their names, each read once."""

    def __missing__(self, name: str) -> xr.Dataset:
        self[name] = read(BASELINE / f"{name}.nc")
        return self[name]


def topics(baseline: Baseline) -> dict[str, dict]:
    """Return the facts of every topic."""
    return {
        "ledger": counts(load_json(BASELINE / "claims.json")["rows"]),
        "long": {"exponent": exponent(baseline["quoted/unbounded"])},
        "proved": proved(baseline),
        "captions": {
            name: baseline[f"figures/{name}"].attrs["caption"] for name in ("pendula_over_the_top",)
        },
        "hard_cases": hard_cases(baseline["checks/hard_cases"]),
        "speed": speed(baseline["speed/work_precision"]),
        "speeds": speeds(baseline),
        "scale": scale(json.loads(scale_of.WRITTEN.read_text(encoding="utf-8"))),
        "full_run": full_run(_kept("reproduction")),
    }


def _kept(name: str) -> dict:
    return json.loads((BASELINE / f"quoted/{name}.json").read_text(encoding="utf-8"))


def exponent(study: xr.Dataset) -> str:
    """Return the exponent with which the norm grows on the infinite chain."""
    one = study.sel(case="fig4_small")
    return with_error(float(one["exponent"]), float(one["exponent_error"]))


def proved(baseline: Baseline) -> dict:
    """Return the proven bounds of curves and states."""
    breathers = baseline["certified/breathers"]
    curves = [
        baseline[f"proofs/{path.stem}"] for path in sorted((BASELINE / "proofs").glob("*.nc"))
    ]
    return {
        "count": str(len(curves)),
        "largest": upward(max(one["bound"].max() for one in curves)),
        "until": number(min(float(one["tau"][-1]) for one in curves)),
        "states": str(breathers.sizes["proof"]),
        "radius": upward(breathers["radius"].max()),
        "bits": number(breathers.attrs["bits"]),
    }  # fmt: skip


def hard_cases(data: xr.Dataset) -> dict[str, str]:
    """Return how many runs there are, are rejected, and did not end as required."""
    counts = {"runs": data.sizes["row"], "refused": (data["refusal"] != "").sum(),
              "unexpected": (data["sound"] == 0).sum()}  # fmt: skip
    return {name: str(int(count)) for name, count in counts.items()}


def speed(data: xr.Dataset) -> dict:
    """Return our solvers' least times in ms at the required error, and peers' times over ours."""
    best = 1e3 * data["best_seconds"].dropna("solver", how="all").dropna("case", how="all")
    winners = [str(name) for name in best.idxmin("solver").values]
    fastest = max(dict.fromkeys(winners), key=winners.count)
    wins = f"in {winners.count(fastest)} of {len(winners)} cases"
    titles = dict(zip(data["contestant"].values, data["title"].values, strict=True))
    peers = sorted((data.sel(peer=peer) for peer in data["peer"].values),
                   key=lambda one: not one["reached_cases"])  # fmt: skip
    return {
        "fastest": f"{SOLVER_NAMES[fastest]} is the fastest solver here {wins}.",
        "head": ["case", "error", *(SOLVER_NAMES[str(name)] for name in best["solver"].values)],
        "least": [
            [case_of(data.sel(case=case)), number(data["target"].sel(case=case)),
             *(number(time) if np.isfinite(time) else "not reached"
               for time in best.sel(case=case).values)]
            for case in best["case"].values
        ],
        "peers": [
            [str(titles[str(one["peer"].values)]), number(ratio := float(one["mean_ratio"]))
             + (f" ({number(1 / ratio)} times faster)" if ratio < 1 else ""),
             number(one["reached_cases"])]
            for one in peers
        ],
    }  # fmt: skip


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


def scale(measured: dict) -> dict:
    """Return what a survey of many runs and a very long chain took."""
    survey, solvers = measured["survey"], ("dop853", "taylor")
    chains = [measured[name] for name in solvers]
    return {
        "processor": survey["machine"]["processor"],
        "runs": f"{survey['runs']:,}",
        "half_width": str(survey["half_width"]),
        "survey_end": number(survey["end_time"]),
        "milliseconds": number(survey["milliseconds_a_run"], 2),
        "minutes": number(survey["runs"] * survey["milliseconds_a_run"] / 6e4, 2),
        "megabytes": f"{survey['megabytes']:.0f}",
        "sites": f"{chains[0]['sites']:,}",
        "chain_end": number(chains[0]["end_time"]),
        "chains": [
            [SOLVER_NAMES[name], number(one["microseconds_a_site"], 2), f"{one['megabytes']:.0f}"]
            for name, one in zip(solvers, chains, strict=True)
        ],
    }


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
