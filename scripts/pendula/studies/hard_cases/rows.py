"""Every hard case, with the solvers that it is put to and what is expected of them."""

import numpy as np

from . import against_exact as exact
from . import against_runs as runs
from .row import Row


def adaptive(*names: str, rtol: float = 1e-12, atol: float | None = None) -> tuple[dict, ...]:
    """Return solvers with these tolerances; `atol` is `rtol` unless given."""
    atol = rtol if atol is None else atol
    return tuple({"name": name, "rtol": rtol, "atol": atol} for name in names)


def splitting(step: float) -> dict:
    return {"name": "splitting", "step": step}


def crank_nicolson(step: float, tolerance: float = 1e-14) -> dict:
    return {"name": "crank_nicolson", "step": step, "tolerance": tolerance, "iterations": 50}


BEST = ("taylor", "dop853")
FLOW = "exact flow of the linear terms"
OTHER = "taylor at 1e-15 (for taylor: dop853 at 1e-14)"
FINEST = adaptive(*BEST)
EVERY = (*FINEST, *adaptive("ode45", rtol=1e-7), splitting(0.005), crank_nicolson(0.0025))
TINY = 1e-20


def tiny(size: float) -> tuple[dict, ...]:
    """Return solvers whose absolute tolerance lies as far below the data as their relative one."""
    return (*adaptive(*BEST, rtol=1e-12, atol=1e-12 * size), splitting(0.05))


THRESHOLD = [
    Row(
        f"gamma = gamma_0 ({sign}), Omega = {omega:g}", FLOW, exact.miss_near_threshold,
        tiny(TINY), 1e-9, {"omega": omega, "factor": factor, "size": TINY},
    )
    for omega in (-4.0, 8.0)
    for sign, factor in (("1 - 1e-6", 1.0 - 1e-6), ("1 + 1e-6", 1.0 + 1e-6))
]  # fmt: skip
EDGES = [
    Row(
        f"Omega = {omega:g}, at the edge of the band, tiny data", FLOW, exact.miss_of_linear_flow,
        tiny(TINY), 1e-9, {"omega": omega, "gamma": 1.0, "size": TINY},
    )
    for omega in (0.0, 4.0)
]  # fmt: skip
SMALL = [
    Row(
        f"amplitudes of {size:g}", FLOW, exact.miss_of_linear_flow, solvers, limit,
        {"omega": -4.0, "gamma": 1.0, "size": size},
    )
    for size, solvers, limit in (
        (1e-150, (tiny(1e-150)[0], splitting(0.05)), 1e-10),
        (1e-150, (crank_nicolson(0.0025),), 1e-2),
        (1e-130, tiny(1e-130), 1e-10),
        (1e-20, tiny(1e-20), 1e-10),
        (1e-150, adaptive("dop853", atol=1e-162), "absolute tolerance 1e-162 vanishes"),
        (1e-150, adaptive(*BEST), "smaller than the absolute tolerance"),
        (1e-170, tiny(1e-170), "so small"),
    )
]  # fmt: skip
LARGE = [
    *(
        Row(
            f"amplitudes of {size:g}, epsilon = gamma = 0", "exact rotation of each amplitude",
            exact.miss_of_rotation, FINEST, 1e-9, {"size": size, "turns": 10.0},
        )
        for size in (1.0, 1e2, 1e4)
    ),
    *(
        Row(
            f"amplitudes and constants scaled by 2^{power}", f"unscaled, {OTHER}",
            runs.miss_of_scaled, adaptive(*names, rtol=1e-12, atol=1e-12 * 2.0**power), expected,
            {"power": power},
        )
        for power, names, expected in (
            (13, BEST, 1e-9), (-40, ["dop853"], 1e-9), (40, ["dop853"], 1e-9),
            (-40, ["taylor"], "another unit of time"), (40, ["taylor"], "another unit of time"),
        )
    ),
]  # fmt: skip
SPECIAL = [
    Row("epsilon = 0", f"each pair alone, {OTHER}", runs.miss_of_single_pairs, FINEST, 1e-9),
    Row("gamma = 0", "the norms of A and B at the start", exact.drift_of_norms, FINEST, 1e-10,
        {"size": 1.0}),
    Row("gamma = 0", "the norms of A and B at the start", exact.drift_of_norms,
        (splitting(0.005), crank_nicolson(0.0025)), 1e-9, {"size": 1.0}),
    Row("data at rest to tau = 1e4", "rest", exact.motion_of_rest,
        (*EVERY[:3], splitting(1.0), crank_nicolson(1.0)), 0.0, {"tau": 1e4}),
    *(Row(f"N = {sites}", OTHER, runs.miss_of_other, solvers, limit, {"sites": sites})
      for sites in (1, 3) for solvers, limit in ((FINEST, 1e-9), (EVERY[2:], 1e-3))),
    Row("N = 100001", f"the same data on 61 sites, {OTHER}", runs.miss_of_short_chain,
        FINEST, 1e-10, {"half_width": 50_000}),
]  # fmt: skip
LONG = [
    Row("tau = 1e4, N = 3, Omega = -4", "the energy at the start", exact.drift_of_energy,
        (solver,), limit, {"tau": 1e4})
    for solver, limit in (
        (splitting(0.05), 1e-6), (crank_nicolson(0.02), 1e-9),
        *zip(adaptive("taylor", rtol=1e-14) + adaptive("taylor", rtol=1e-10)
             + adaptive("dop853", rtol=1e-13) + adaptive("dop853", rtol=1e-9)
             + adaptive("ode45", rtol=1e-7), (1e-10, 1e-5, 1e-8, 1e-3, 1.0), strict=True),
    )
]  # fmt: skip
TOLERANCES = [
    Row(f"rtol = {rtol:g}", OTHER, runs.miss_of_other, adaptive(*BEST, "ode45", rtol=rtol), limit,
        {"sites": 11})
    for rtol, limit in (
        (1e-2, 0.5), (1e-6, 1e-4), (1e-10, 1e-8), (1e-14, 1e-12),
        (1e-17, "below the rounding"), (0.0, "below the rounding"), (np.nan, "tolerances"),
    )
]  # fmt: skip
REFUSED = [
    *(Row(f"an amplitude of {value:g}", "-", runs.run_anyway, EVERY, words, {"amplitude": value})
      for value, words in (
          (1e155, "overflow"), (1e200, "overflow"), (1e308, "overflow"),
          (np.nan, "not finite"), (np.inf, "not finite"))),
    Row("Omega is not a number", "-", runs.run_anyway, EVERY, "not finite", {"omega": np.nan}),
    *(Row(f"a step of {step:g}", "-", runs.run_anyway, (splitting(step), crank_nicolson(step)),
          words)
      for step, words in ((1e-12, "1e+12 steps"), (1e-300, "steps"), (0.0, "must be positive"),
                          (np.nan, "must be positive"))),
    Row("amplitudes of 1e4 to tau = 50", "-", runs.run_anyway, EVERY, "radians",
        {"amplitude": 1e4, "tau": 50.0}),
    Row("an iteration that does not contract", "-", runs.run_anyway, (crank_nicolson(0.1),),
        "contract", {"amplitude": 1e5, "tau": 0.1}),
    Row("a step of 1000", "-", runs.run_anyway, (splitting(1e3),), "linear terms",
        {"tau": 1e4}),
    Row("a step too long", "-", runs.run_anyway, (splitting(0.1),), "too long",
        {"amplitude": 100.0}),
]  # fmt: skip
ROWS = [*THRESHOLD, *EDGES, *SMALL, *LARGE, *SPECIAL, *LONG, *TOLERANCES, *REFUSED]
