"""The six cases of the paper: this project's solver against SciPy's RK45, at the same error.

Run as `python tests/benchmarks/solvers.py`. Two opponents: RK45 with the right-hand side in NumPy
as most people would write it, and RK45 calling this project's compiled right-hand side. For each
case and opponent the tolerances are chosen so that our measured error at tau = 5, before chaos
sets in, is not above the opponent's; then the two take turns over the same stretch of time. Errors
are the largest difference of a site's amplitude from SciPy's DOP853 at its tightest tolerance.
"""

import argparse
import sys
from functools import partial
from pathlib import Path
from time import perf_counter
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))

from pendula.chain import Chain, rates
from pendula.lattice import (
    Reduction,
    choose_ends,
    find_reduction,
    pack,
    place,
    unpack,
)
from pendula.simulation import integrate, output_times

EPSILON = GAMMA = 1.0
HALF_WIDTH = 30
CASES = {
    "fig2_small": (8.0, (1.0, 0.1)),
    "fig2_large": (8.0, (5.0, 1.0)),
    "fig3_small": (-4.0, (1.0, 0.1)),
    "fig3_large": (-4.0, (5.0, 1.0)),
    "fig4_small": (0.0, (1.0, 0.1)),
    "fig4_large": (0.0, (5.0, 1.0)),
}
WHOLE = Reduction(even=False, synchronised=False)
BEFORE_CHAOS = 5.0
OUTPUT_STEP = 0.025
LADDER = 10.0 ** -np.arange(13.0, 2.9, -0.25)  # our tolerances, tight to loose
OURS = "dop853"


class Row(NamedTuple):
    """One line of the table: errors at tau = 5, milliseconds per unit of tau, each pair's ratio."""

    case: str
    opponent: str
    their_error: float
    our_error: float
    their_time: float
    our_time: float
    ratios: np.ndarray


def plain_right_hand_side(tau, u, omega):
    """Equations (4) as most people would write them in NumPy."""
    n = len(u) // 2
    a, b = u[:n], u[n:]
    left_a, right_a = np.concatenate([[0], a[:-1]]), np.concatenate([a[1:], [0]])
    left_b, right_b = np.concatenate([[0], b[:-1]]), np.concatenate([b[1:], [0]])
    da = EPSILON * (right_a - 2 * a + left_a) + omega * a
    da = da + GAMMA * (np.conj(b) - np.conj(a)) + 0.5 * np.abs(a) ** 2 * a
    db = EPSILON * (right_b - 2 * b + left_b) + omega * b
    db = db + GAMMA * (np.conj(a) - np.conj(b)) + 0.5 * np.abs(b) ** 2 * b
    return -1j * np.concatenate([da, db])


def scipy_plain(omega, z, end, rtol):
    """Integrate with SciPy's RK45 and the plain right-hand side; return the final amplitudes."""
    run = solve_ivp(
        partial(plain_right_hand_side, omega=omega),
        (0.0, end),
        z.ravel(),
        t_eval=output_times(end, OUTPUT_STEP),
        rtol=rtol,
        atol=1e-2 * rtol,
    )
    return run.y[:, -1].reshape(z.shape)


def scipy_compiled(omega, z, end, rtol):
    """Integrate with SciPy's RK45 and this project's compiled right-hand side."""
    chain = Chain(EPSILON, GAMMA, omega, *choose_ends("dirichlet", WHOLE))
    start = pack(z, WHOLE)
    shape = start.shape

    def right_hand_side(_, u):
        slope = np.zeros(shape)
        rates(chain, u.reshape(shape), slope)
        return slope.ravel()

    run = solve_ivp(
        right_hand_side,
        (0.0, end),
        start.ravel(),
        t_eval=output_times(end, OUTPUT_STEP),
        rtol=rtol,
        atol=1e-2 * rtol,
    )
    return unpack(run.y[:, -1].reshape(shape), WHOLE)


def ours(omega, z, end, rtol):
    """Integrate with this project's solver: half a chain, with the norms and the energy."""
    solver = {"name": OURS, "rtol": rtol, "atol": rtol}
    times = output_times(end, OUTPUT_STEP)
    constants = (EPSILON, GAMMA, omega)
    return integrate(constants, "dirichlet", z, find_reduction(z), times, solver).final


def reference(omega, z):
    """Return the amplitudes at tau = 5 by SciPy's DOP853 at its tightest tolerance."""
    run = solve_ivp(
        partial(plain_right_hand_side, omega=omega),
        (0.0, BEFORE_CHAOS),
        z.ravel(),
        method="DOP853",
        rtol=3e-14,
        atol=1e-14,
    )
    return run.y[:, -1].reshape(z.shape)


def our_tolerance(omega, z, exact, error):
    """Return our loosest tolerance with no error above `error` from there on, and its error."""
    chosen = None
    for rtol in LADDER:
        achieved = np.abs(ours(omega, z, BEFORE_CHAOS, rtol) - exact).max()
        if achieved > error:
            break
        chosen = rtol, achieved
    if chosen is None:
        raise SystemExit(f"no tolerance of ours reaches an error of {error:.1e}")
    return chosen


def timed(run, repeat=1):
    start = perf_counter()
    for _ in range(repeat):
        run()
    return (perf_counter() - start) / repeat


def compare(case, name, opponent, rtol, horizon, pairs):
    """Match the errors at tau = 5, then take turns over the horizon."""
    omega, pair = CASES[case]
    z = place({0: pair}, HALF_WIDTH)
    exact = reference(omega, z)
    their_error = np.abs(opponent(omega, z, BEFORE_CHAOS, rtol) - exact).max()
    our_rtol, our_error = our_tolerance(omega, z, exact, their_error)
    turns = [
        (
            timed(lambda: opponent(omega, z, horizon, rtol)),
            timed(lambda: ours(omega, z, horizon, our_rtol), repeat=5),
        )
        for _ in range(pairs)
    ]
    theirs, mine = np.median(turns, axis=0) * 1e3 / horizon
    ratios = np.array([one / other for one, other in turns])
    return Row(case, name, their_error, our_error, theirs, mine, ratios)


def show(rows):
    """Print a table, times in milliseconds per unit of tau, and the mean of its ratios."""
    layout = "{:<12}{:<18}{:>10}{:>10}{:>12}{:>9}{:>8}   {}"
    errors, times = ("its error", "ours"), ("its ms/tau", "ours")
    print(layout.format("case", "RK45 with", *errors, *times, "ratio", "spread"))
    for row in rows:
        errors = f"{row.their_error:.1e}", f"{row.our_error:.1e}"
        times = f"{row.their_time:.2f}", f"{row.our_time:.4f}"
        ratio = f"{np.median(row.ratios):.0f}"
        spread = f"{row.ratios.min():.0f}..{row.ratios.max():.0f}"
        print(layout.format(row.case, row.opponent, *errors, *times, ratio, spread))
    medians = [np.median(row.ratios) for row in rows]
    print(f"geometric mean of the ratios: {np.exp(np.mean(np.log(medians))):.0f}", end="\n\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rtol", type=float, default=1e-7, help="RK45's relative tolerance")
    parser.add_argument("--horizon", type=float, default=50.0, help="tau of the compiled runs")
    parser.add_argument("--plain-horizon", type=float, default=25.0, help="tau of the NumPy runs")
    parser.add_argument("--pairs", type=int, default=5, help="timed pairs of each comparison")
    options = parser.parse_args()
    print(f"RK45 at rtol {options.rtol:g}, atol {options.rtol / 100:g}; ours: {OURS}, atol = rtol")
    for name, opponent, horizon in (
        ("NumPy", scipy_plain, options.plain_horizon),
        ("our compiled rhs", scipy_compiled, options.horizon),
    ):
        rows = [
            compare(case, name, opponent, options.rtol, horizon, options.pairs) for case in CASES
        ]
        show(rows)


if __name__ == "__main__":
    main()
