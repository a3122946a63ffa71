"""Facts on what solvers, other people's solvers and a full run cost."""

import numpy as np
import xarray as xr
from pendula.datasets.registry import SOLVER_NAMES
from pendula.report.words import number

from benchmarks import reproduction

from .baseline import Baseline

COMPARED = 1001, 100_001
"""Numbers of sites whose costs are compared."""


REGULAR_ERROR = 1e-10
"""The error at which solvers are compared."""


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
        "faster": "; ".join(titles[peer] for peer, ratio in ratios.items() if ratio < 1),
        "by_hand": _by_hand(baseline["speed/cost"], baseline["speed/cost_avx2"]),
        "taylor_error": number(float(errors.max()), 2),
        "sites": [
            {"sites": str(n), **_growth(1e6 * cost.sel(sites=n))} for n in cost["sites"].values
        ],
        "long_over_short": {"sites": f"{COMPARED[1]} over {COMPARED[0]}", **_growth(long / short)},
    }


def _by_hand(cost: xr.Dataset, older: xr.Dataset) -> dict:
    """Return the times of the method in C++ over those of `taylor` in a long run.

    `older` was measured by code for an older processor, which may lack a method: a dash.
    """
    end, measured = cost["end_time"][-1], {"ratio": cost, "older_ratio": older}

    def ratio(data: xr.Dataset, peer: str) -> str:
        found = float(data["by_hand_ratio"].sel(end_time=end, by_hand=peer))
        return "-" if np.isnan(found) else _ratio(found)

    return {
        "end": number(float(end)),
        "peers": [
            {"peer": peer, **{name: ratio(data, peer) for name, data in measured.items()}}
            for peer in map(str, cost["by_hand"].values)
        ],
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


def full_run(baseline: Baseline) -> dict:
    """Return what a full run takes, with and without kernels compiled before."""
    if not (measured := baseline.reproduction()):
        return {"runs": []}
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
    own, below = measured.sel(contestant=measured["solver"].values), None
    for error in 10.0 ** np.arange(-13, 0):
        least = own["seconds"].where(own["error"] <= error).min("point").dropna("case", how="all")
        if (least.idxmin("contestant") != solver).any():
            break
        below = error
    return below
