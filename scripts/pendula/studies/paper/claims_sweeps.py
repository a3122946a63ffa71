"""Section 5, Figs 5 and 6: claims on norms in a time window as functions of the half-width M.

In a fixed window no norm can diverge with M. By (19) the norm on the infinite chain is finite. If
the front does not reach the ends within the window, a longer chain changes nothing.
"""

import numpy as np
import xarray as xr
from latticode.measures import levels
from latticode.measures.levels import levelling, relative_range
from latticode.measures.norms import total_power
from replication.ledger.changes import scale
from replication.ledger.claim import ClaimControl, claim
from replication.ledger.criterion import (
    Above,
    AllOf,
    AtMost,
    Below,
    Finding,
    UndecidableError,
    judge,
)
from replication.ledger.cutoff import Cutoff

from pendula.claims import CONSTANT, at_one_omega, checks, runs, sweeps, swept
from pendula.models.bounds import proven_region, theorem_2_constants
from pendula.problem import Constants

SECTION = 5

WINDOW = "[10, 50]"
"""Time window of Fig 5, in the text and in the caption."""
LEVEL = Cutoff(levels.LEVEL, '"approaches a level": within 0.5 %, the width of a line')
TEXT_6 = "[10, 70]"
"""Time window of Fig 6 in the text."""


def with_a_hump(sweep: xr.Dataset) -> xr.Dataset:
    """Return, as a control, l2 norms that are 30 % higher at the second to the fifth M."""
    return scale("l2", 1.3, half_width=sweep["half_width"][1:5])(sweep)


def falls_to_a_level(
    half_widths: np.ndarray, values: np.ndarray, fall: str
) -> tuple[dict[str, float], AllOf]:
    """Return measured numbers of `values`, and the criterion that they fall with M to a level."""
    measured = {
        fall: 1.0 - values[-1] / values[0],
        "largest_rise": np.max(values / np.minimum.accumulate(values)) - 1.0,
        "level_from": levelling(half_widths, values, LEVEL.value),
    }
    steady = Below(CONSTANT, "largest_rise", label="largest rise in between")
    level = Below(np.inf, "level_from", label="half-width where it levels off")
    return measured, AllOf(Above(CONSTANT, fall), steady, level)


@claim(
    "Section 5, Fig 5 left",
    "At Omega = -4 the l2 norm decreases in M towards a level.",
    sweeps("fig5_left"),
    controls=(
        ClaimControl("the sweep at Omega = 0, which grows", "fig5_right"),
        ClaimControl("norms 30 % higher at the second to the fifth M", with_a_hump),
    ),
)
def fig5_decreases(sweep: xr.Dataset) -> Finding:
    """Require that the maximum falls to a level as M grows, and does not rise in between."""
    m, highest = swept(sweep, "l2", "max", WINDOW)
    _, average = swept(sweep, "l2", "mean", WINDOW)
    measured, criterion = falls_to_a_level(m, highest, "fall_of_maximum")
    measured["fall_of_mean"] = 1.0 - average[-1] / average[0]
    caveat = ""
    if measured["fall_of_mean"] <= CONSTANT.value:
        caveat = "for the maximum (text of the paper); the average (caption) hardly changes"
    return judge(measured, criterion, caveat)


@claim(
    "Section 5, Fig 5 left",
    "For Omega < -2 gamma a small solution does not grow on the unbounded lattice, in agreement"
    " with Theorem 2.",
    (*runs("fig3_small"), *sweeps("fig5_left")),
    controls=(ClaimControl("the sweep of the large case", {"fig5_left": "fig6_right"}),),
)
def fig5_theorem_2(case: xr.Dataset, sweep: xr.Dataset) -> Finding:
    start, energy = float(total_power(case)[0]), float(case["energy"][0])
    parameters, boundary = Constants.of(case.attrs), str(case.attrs["boundary"])
    region = proven_region(energy, start, parameters, boundary)
    if region == "theorem 1":
        raise UndecidableError("Theorem 2 does not apply at this Omega")
    at_one_omega(case, sweep)
    swept = np.square(sweep["l2"].sel(quantity="pair").values).max()
    bound = theorem_2_constants(parameters)[1] * start
    measured = {"P_over_C0_delta": max(float(swept), total_power(case).max()) / bound}
    caveats = {
        "theorem 2 widened": "covered only if the proof of the theorem keeps the coupling energy",
        "none": "no theorem for the infinite chain covers the initial condition",
    }
    criterion = AtMost(1.0, "P_over_C0_delta", label="P over C_0 delta")
    return judge(measured, criterion, caveats.get(region, ""))


@claim(
    "Section 5, Fig 5",
    "A similar dependence (not shown) exists for Omega = 8.",
    checks("not_shown"),
    controls=(
        ClaimControl(
            "the sweep at Omega = 0, which grows",
            ("sweeps/fig5_right", lambda _, sweep: maxima_of(sweep)),
        ),
        ClaimControl("norms 30 % higher at the second to the fifth M", with_a_hump),
    ),
)
def fig5_not_shown(check: xr.Dataset) -> Finding:
    return judge(*falls_to_a_level(check["half_width"].values, check["l2"].values, "fall"))


def maxima_of(sweep: xr.Dataset) -> xr.Dataset:
    """Return the maxima of a sweep in the window of Fig 5, named as in the check at Omega = 8."""
    chosen = {"quantity": "pair", "statistic": "max", "window": WINDOW}
    return sweep[["l2"]].sel(chosen, drop=True)


@claim(
    "Section 5, Fig 6 left",
    "At Omega = 8 the maximal l2 norm does not change with N.",
    sweeps("fig6_left"),
    controls=(ClaimControl("the large case at Omega = -4, which grows", "fig6_right"),),
)
def fig6_constant(sweep: xr.Dataset) -> Finding:
    _, l2 = swept(sweep, "l2", "max", TEXT_6)
    criterion = Below(CONSTANT, "relative_range", label="range of the maxima over their mean")
    return judge({"relative_range": relative_range(l2)}, criterion)
