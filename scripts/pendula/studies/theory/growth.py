"""Lemma 2: the balance of the l2 norm, and the bound (19) on its growth.

P = |A|^2 + |B|^2 in l2. Its rate is at most 4 |gamma| P in either direction of time, so that
|log P(t) - log P(s)| <= 4 |gamma| |t - s| for any two times of any trajectory.
"""

import numpy as np

from pendula.datasets.checks import table, variable
from pendula.measures.readings import growth_margin

from .runs import BOUNDARIES, TIGHT, mean_spacing, random_amplitudes, right_hand_side, run


def norm_balance(amplitudes: np.ndarray, gamma: float) -> float:
    """Return the right-hand side of the balance equation of P, as Lemma 2 prints it."""
    a, b = amplitudes
    total = 2 * a * b - 2 * (a * b).conj() + (a**2).conj() + (b**2).conj() - a**2 - b**2
    return float((1j * gamma * np.sum(total)).real)


def norm_rate(constants, boundary: str, amplitudes: np.ndarray) -> float:
    """Return dP/dtau from the library's right-hand side."""
    rates = right_hand_side(constants, boundary, amplitudes)
    return float(2.0 * np.sum((amplitudes.conj() * rates).real))


def integrated_balance(
    constants, boundary: str, amplitudes, end_time: float, panels: int, solver: dict = TIGHT
):
    """Return the change of P along a trajectory and the integral of its balance (Gauss-Legendre).

    The state is carried from node to node, eight to a panel.
    """
    nodes, weights = np.polynomial.legendre.leggauss(8)
    half = 0.5 * end_time / panels
    times = np.concatenate([half * (2 * k + 1 + nodes) for k in range(panels)] + [[end_time]])
    state, now, integral = amplitudes, 0.0, 0.0
    for i, time in enumerate(times):
        state = run(constants, boundary, state, [0.0, time - now], solver).final
        now = time
        if i < len(times) - 1:
            integral += half * weights[i % 8] * norm_balance(state, constants[1])
    change = np.sum(np.abs(state) ** 2) - np.sum(np.abs(amplitudes) ** 2)
    return float(change), float(integral)


def check_balance(constants, sites: int, end_time: float, panels: int = 12, seed: int = 7) -> dict:
    """Test the balance equation at random states and integrated along a trajectory."""
    rng = np.random.default_rng(seed)
    pointwise, integrated = [], []
    for boundary in BOUNDARIES:
        errors = []
        for _ in range(10):
            state = random_amplitudes(rng, sites, 3.0)
            rate = norm_rate(constants, boundary, state)
            errors.append(abs(rate - norm_balance(state, constants[1])))
        pointwise.append(max(errors))
        start = random_amplitudes(rng, sites, 1.5)
        change, integral = integrated_balance(constants, boundary, start, end_time, panels)
        integrated.append(abs(change - integral))
    dims = ("boundary",)
    return table(
        "The balance equation of the l2 norm (Lemma 2)",
        {"boundary": list(BOUNDARIES)},
        pointwise=variable(pointwise, dims, "dP/dtau minus its balance", tolerance=1e-12),
        integrated=variable(integrated, dims, "change of P minus its integral", tolerance=1e-9),
    )


def check_growth(constants, sites: int, end_time: float, samples: int, seed: int = 8) -> dict:
    """Test (19) forwards and backwards on random data, and that 4 |gamma| cannot be lowered.

    Backwards means the conjugate data run forwards: conjugation reverses time, which is tested
    by returning to the start. The sharp case is one site with Omega = 2 epsilon, where kappa is
    zero and A = -B = x e^{i pi / 4} grows by e^{2 gamma tau} for as long as it is small.
    """
    rng = np.random.default_rng(seed)
    times = mean_spacing(100, end_time)
    margins = {"forwards": [], "backwards": [], "steepest": []}
    returns = []
    for sample in range(samples):
        boundary = BOUNDARIES[sample % len(BOUNDARIES)]
        start = random_amplitudes(rng, sites, 10.0 ** rng.uniform(-2.0, 0.7))
        forth = run(constants, boundary, start, times)
        back = run(constants, boundary, start.conj(), times)
        forwards = growth_margin(times, forth.l2, constants[1])
        backwards = growth_margin(times, back.l2, constants[1])
        margins["forwards"].append(forwards["from_start"])
        margins["backwards"].append(backwards["from_start"])
        margins["steepest"].append(max(forwards["steepest"], backwards["steepest"]))
        short = run(constants, boundary, start, [0.0, 1.0]).final
        again = run(constants, boundary, short.conj(), [0.0, 1.0]).final.conj()
        returns.append(np.abs(again - start).max() / np.abs(start).max())
    dims = ("sample",)
    limit = 1.0 + 1e-9
    return table(
        "The bound (19) on the growth of l2, forwards and backwards",
        {"sample": np.arange(samples)},
        forwards=variable(margins["forwards"], dims, "largest P over its bound", tolerance=limit),
        backwards=variable(margins["backwards"], dims, "the same backwards", tolerance=limit),
        steepest=variable(
            margins["steepest"], dims, "steepest log P over 4 gamma", tolerance=limit
        ),
        reversal=variable(returns, dims, "miss after there and back", tolerance=1e-8),
        sharpest=variable(sharpest_growth(), (), "the sharp case over its bound"),
    )


def sharpest_growth(gamma: float = 1.0, epsilon: float = 1.0, end_time: float = 4.0) -> float:
    """Return P(tau) over its bound (19) in the sharp case; one but for the tiny cubic term."""
    a = 1e-8 * np.exp(0.25j * np.pi)
    data = np.array([[a], [-a]])
    final = run((epsilon, gamma, 2.0 * epsilon), "dirichlet", data, [0.0, end_time]).final
    grown = np.sum(np.abs(final) ** 2) / np.sum(np.abs(data) ** 2)
    return float(grown / np.exp(4.0 * gamma * end_time))
