"""Facts on chaos: until when a trajectory can be trusted, and what ensembles share."""

import numpy as np
import xarray as xr
from pendula.report.words import case_of, measured, number, percent, span, with_error
from pendula.studies.chaos.claims import END

from .baseline import Baseline
from .words import time_of_output, with_stored_error

LATE = 60
"""A half-width from which on a chain counts as long in Fig 6."""


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
                    parity: with_stored_error(growth.sel(case=case, parity=parity), "exponent")
                    for parity in ("even", "odd")
                },
                "uneven": time_of_output(even["rounded_time"].sel(case=case)),
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


def _limits(data: xr.Dataset, name: str, digits: int = 3) -> str:
    """Return confidence limits."""
    return " to ".join(measured(data[f"{name}_{end}"], digits) for end in ("low", "high"))


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
        "first_fast": number(fast["start_amplitude"].min()),
        "last_fast": number(fast["start_amplitude"].max()),
        "from": number(slow["start_amplitude"].min()),
        "members": str(int(lives.attrs["members"])),
        "of_paper": number(END),
        "end": number(lives["tau"].max()),
        "fast": span(fast.values, 2),
        "rows": [
            {
                "case": number(life["start_amplitude"]),
                "kept_of_paper": percent(life["surviving"].sel(tau=END)),
                "kept": percent(life["surviving"][-1]),
                "first": time_of_output(life["life"].min()),
                "rate": measured(life["rate"], 2),
                "limits": _limits(life, "rate", 2),
                "chance": _chance(life),
            }
            for life in (slow.isel(start_amplitude=i) for i in range(slow.sizes["start_amplitude"]))
        ],
        "coarse": number(coarse["choice_tolerance"]),
        "coarse_drift": number(coarse["choice_drift"], 1),
        "coarse_rate": number(coarse["choice_rate"], 2),
        "compared": number(lives["compared_amplitude"]),
    }
