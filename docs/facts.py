"""What the README and docs/ quote, as text.

These are the counts of the ledger, a proof rounded upward, and what was measured of speed. A
function stands for a topic: a template says `{{ scale.minutes }}`. No number is typed here.
"""

import json
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from latticode.datasets.json_files import load_json
from latticode.datasets.registry import SOLVER_NAMES
from pendula.article.values import KEPT, counts, largest_bound
from pendula.report.results import Results
from pendula.report.words import case_of, number

from benchmarks import reproduction
from benchmarks import scale as scale_of

BASELINE = Path(__file__).resolve().parents[1] / "tests/baseline"


class Accepted(Results):
    """The accepted results, as pages read those of a run."""

    def __init__(self):
        super().__init__((), "")

    def __contains__(self, name: str) -> bool:
        return self.path(f"{name}.nc").exists()

    def path(self, link: str) -> Path:
        return BASELINE / link.removeprefix(f"{KEPT}/")


def topics(accepted: Results) -> dict[str, Any]:
    """Return the facts of every topic."""
    kept = BASELINE / "quoted/reproduction.json"
    return {
        "ledger": counts(load_json(BASELINE / "claims.json")["rows"]),
        "largest_bound": largest_bound(accepted),
        "speed": speed(accepted["speed/work_precision"]),
        "speeds": speeds(accepted),
        "scale": scale(json.loads(scale_of.WRITTEN.read_text(encoding="utf-8"))),
        "full_run": full_run(json.loads(kept.read_text(encoding="utf-8"))),
    }


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


def speeds(accepted: Results) -> dict:
    """Return the growth of the cost with the sites in µs, and peers on Newton's equations."""
    pendula, cost = accepted["speed/pendula"], accepted["speed/cost"]["seconds"]
    titles, ratios = pendula["title"].to_series(), pendula["ratio"].transpose("peer", "case")
    return {
        "processor": accepted["speed/work_precision"].attrs["processor"],
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
