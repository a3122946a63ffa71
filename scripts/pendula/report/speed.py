"""Speed against error, read from the dataset that `snakemake speed` makes."""

from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from .page import picture
from .results import ReportError, Results
from .words import SOLVERS, case_of, number


class Measured(NamedTuple):
    """Where the measurements are, as links of the page; `fresh` if this machine made them."""

    data: str
    table: str
    pictures: list[str]
    fresh: bool


def gather(results: Results, measured: Measured) -> dict[str, Any]:
    """Return the peers' times over ours and our solvers' least times at the error asked for."""
    source = measured.data.removesuffix(".nc")
    data = results[source]
    if "best_seconds" not in data:
        raise ReportError(f"{measured.data} holds no times of solvers: run `snakemake speed`")
    best = 1e3 * data["best_seconds"].dropna("solver", how="all").dropna("case", how="all")
    winners = [str(name) for name in best.idxmin("solver").values]
    fastest = max(dict.fromkeys(winners), key=winners.count)
    alt = _alt(best)
    return {
        "fresh": measured.fresh,
        **_peers(results, source),
        "head": ["case", "error", *(SOLVERS[str(name)] for name in best["solver"].values)],
        "rows": [_row(results, source, best.sel(case=case)) for case in best["case"].values],
        "fastest": SOLVERS[fastest],
        "wins": results.quote(source, winners.count(fastest)),
        "cases": results.quote(source, len(winners)),
        "pictures": [picture(results.path(link), alt, link) for link in measured.pictures],
        "table": measured.table,
    }


def _peers(results: Results, source: str) -> dict[str, list]:
    """Return the mean ratio of each peer that reached the error, and the names of the others."""
    data = results[source]
    titles = dict(zip(data["contestant"].values, data["title"].values, strict=True))
    reached, absent = [], []
    for peer in data["peer"].values if "peer" in data.dims else []:
        own = data.sel(peer=peer)
        if count := int(own["reached_cases"]):
            mean = f"{number(float(own['mean_ratio']))} ({count} cases)"
            reached.append([str(titles[peer]), results.say(source, mean)])
        else:
            absent.append(str(titles[peer]))
    return {"peers": reached, "absent": absent}


def _row(results: Results, source: str, times: xr.DataArray) -> list:
    cells = [
        results.quote(source, time) if np.isfinite(time) else "not reached" for time in times.values
    ]
    case = str(times["case"].values)
    target = float(results[source]["target"].sel(case=case))
    return [case_of(results["checks/cases"].sel(case=case)), number(target), *cells]


def _alt(times: xr.DataArray) -> str:
    least = times.min("case")
    told = "; ".join(
        f"{SOLVERS[str(name)]} {number(float(least.sel(solver=name)))}"
        for name in times["solver"].values
    )
    return f"Time against error, a line a solver. Least times in ms at the error asked for: {told}."
