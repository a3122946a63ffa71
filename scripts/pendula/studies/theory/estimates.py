"""The estimates of Section 4: the balance of Lemma 2, its bound (19), and the inequalities.

P = |A|^2 + |B|^2 in l2. Its rate is at most 4 |gamma| P in either direction of time, so that
|log P(t) - log P(s)| <= 4 |gamma| |t - s| for any two times of any trajectory. The theorems rest
on the inequalities (17), (18), (22), (27) and on the coercivity bounds (21), (25).
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from pendula.datasets.checks import table, tabulate, variable
from pendula.measures.norms import growth_margin
from pendula.models.bounds import coercivity, extent, theorem_2_gap
from pendula.problem import Constants

from .equations import (
    BOUNDARIES,
    TIGHT,
    draw_shape,
    random_amplitudes,
    right_hand_side,
    run,
    total_energy,
)


def norm_balance(amplitudes: np.ndarray, gamma: float) -> float:
    """Return the right-hand side of the balance equation of P, as Lemma 2 prints it."""
    a, b = amplitudes
    total = 2 * a * b - 2 * (a * b).conj() + (a**2).conj() + (b**2).conj() - a**2 - b**2
    return float((1j * gamma * np.sum(total)).real)


def integrated_balance(
    constants: Constants,
    boundary: str,
    amplitudes,
    end_time: float,
    panels: int,
    solver: Mapping = TIGHT,
):
    """Return the change of P along a trajectory and the integral of its balance (Gauss-Legendre).

    The state is carried from node to node, eight to a panel.
    """
    nodes, weights = np.polynomial.legendre.leggauss(8)
    half = 0.5 * end_time / panels
    times = np.concatenate([half * (2 * k + 1 + nodes) for k in range(panels)] + [[end_time]])
    state, now, integral = amplitudes, 0.0, 0.0
    for i, time in enumerate(times):
        state = run(constants, boundary, state, time - now, solver=solver).final
        now = time
        if i < len(times) - 1:
            integral += half * weights[i % 8] * norm_balance(state, constants.gamma)
    change = np.sum(np.abs(state) ** 2) - np.sum(np.abs(amplitudes) ** 2)
    return float(change), float(integral)


def check_balance(
    constants: Constants, sites: int, end_time: float, panels: int, seed: int
) -> dict:
    """Test the balance equation at random states and integrated along a trajectory."""
    rng = np.random.default_rng(seed)
    rows = []
    for boundary in BOUNDARIES:
        errors = []
        for _ in range(10):
            state = random_amplitudes(rng, sites, 3.0)
            rates = right_hand_side(constants, boundary, state)
            rate = float(2.0 * np.sum((state.conj() * rates).real))
            errors.append(abs(rate - norm_balance(state, constants.gamma)))
        start = random_amplitudes(rng, sites, 1.5)
        change, integral = integrated_balance(constants, boundary, start, end_time, panels)
        rows.append({"pointwise": max(errors), "integrated": abs(change - integral)})
    return tabulate(
        "The balance equation of the l2 norm (Lemma 2)",
        {"boundary": BOUNDARIES},
        rows,
        {
            "pointwise": ("dP/dtau minus its balance", 1e-12),
            "integrated": ("change of P minus its integral", 1e-9),
        },
    )


def check_growth(
    constants: Constants, sites: int, end_time: float, samples: int, seed: int
) -> dict:
    """Test (19) forwards and backwards on random data, and that 4 |gamma| cannot be lowered.

    Backwards means the conjugate data run forwards: conjugation reverses time, which is tested
    by returning to the start. The sharp case is one site with Omega = 2 epsilon, where kappa is
    zero and A = -B = x e^{i pi / 4} grows by e^{2 gamma tau} for as long as it is small.
    """
    rng = np.random.default_rng(seed)
    rows = []
    for sample in range(samples):
        boundary = BOUNDARIES[sample % len(BOUNDARIES)]
        start = random_amplitudes(rng, sites, 10.0 ** rng.uniform(-2.0, 0.7))
        forth = run(constants, boundary, start, end_time, 100)
        back = run(constants, boundary, start.conj(), end_time, 100)
        forwards = growth_margin(forth.tau, forth.l2, constants.gamma)
        backwards = growth_margin(back.tau, back.l2, constants.gamma)
        short = run(constants, boundary, start, 1.0).final
        again = run(constants, boundary, short.conj(), 1.0).final.conj()
        rows.append(
            {
                "forwards": forwards["from_start"],
                "backwards": backwards["from_start"],
                "steepest": max(forwards["steepest"], backwards["steepest"]),
                "reversal": np.abs(again - start).max() / np.abs(start).max(),
            }
        )
    limit = 1.0 + 1e-9
    return tabulate(
        "The bound (19) on the growth of l2, forwards and backwards",
        {"sample": np.arange(samples)},
        rows,
        {
            "forwards": ("largest P over its bound, forwards", limit),
            "backwards": ("largest P over its bound, backwards", limit),
            "steepest": ("steepest log P over 4 gamma", limit),
            "reversal": ("miss after there and back", 1e-8),
        },
        sharpest=variable(sharpest_growth(), (), "the sharp case over its bound"),
    )


def sharpest_growth(gamma: float = 1.0, end_time: float = 4.0) -> float:
    """Return P(tau) over its bound (19) in the sharp case; one but for the tiny cubic term."""
    a = 1e-8 * np.exp(0.25j * np.pi)
    data = np.array([[a], [-a]])
    constants = Constants(epsilon=1.0, gamma=gamma, omega=2.0)
    final = run(constants, "dirichlet", data, end_time).final
    grown = np.sum(np.abs(final) ** 2) / np.sum(np.abs(data) ** 2)
    return float(grown / np.exp(4.0 * gamma * end_time))


def norm(a: np.ndarray, power: float = 2.0) -> float:
    """Return the l-p norm of a sequence."""
    return float(np.sum(np.abs(a) ** power) ** (1.0 / power))


def sequence_ratios(a: np.ndarray, b: np.ndarray) -> list[float]:
    """Return left over right side of (17), (18), (22) and (27), each at most one."""
    padded = np.concatenate([[0.0], a, [0.0]])
    bonds = np.sum(np.abs(np.diff(padded)) ** 2)
    return [
        bonds / (4.0 * norm(a) ** 2),
        norm(a * b) / (norm(a) * norm(b)),
        norm(a, 4.0) / norm(a),
        norm(a) / (len(a) ** 0.25 * norm(a, 4.0)),
    ]


def energy_ratios(rng: np.random.Generator, amplitudes: np.ndarray, boundary: str) -> list[float]:
    """Return (bound - energy) / P of (21), (25), its widened form, and the corrected (3.) bound."""
    epsilon, gamma = rng.uniform(0.2, 2.0), rng.uniform(0.0, 2.0)
    power, sites = norm(amplitudes) ** 2, amplitudes.shape[1]
    high, low = 2.0 * gamma + 4.0 * epsilon + 1.0, -2.0 * gamma - rng.uniform(0.1, 4.0)
    constants = Constants(epsilon=epsilon, gamma=gamma, omega=low)
    upper = total_energy(replace(constants, omega=high), boundary, amplitudes)
    energy = total_energy(constants, boundary, amplitudes)
    gap = theorem_2_gap(constants)
    widened = float(coercivity(power, constants)) if boundary == "dirichlet" else -np.inf
    finite = power**2 / (8.0 * sites) - extent(constants) * power
    return [
        power - upper,
        gap * power - power**2 / 4.0 + energy,
        widened + energy,
        finite - energy,
    ]


def check_inequalities(count: int, seed: int) -> dict:
    """Test every inequality of Section 4 on random states, and on those that make them sharp."""
    rng = np.random.default_rng(seed)
    ratios, excess = [], []
    for sample in range(count):
        sites = 2 * int(rng.integers(0, 7)) + 1
        amplitudes = rng.uniform(0.1, 6.0) * draw_shape(rng, sites)
        other = random_amplitudes(rng, sites, 1.0)
        ratios.append(sequence_ratios(amplitudes[0], other[0]))
        excess.append(energy_ratios(rng, amplitudes, BOUNDARIES[sample % 3]))
    wave = (-1.0) ** np.arange(1001)
    one, flat = np.eye(1, 5)[0], np.ones(7)
    sharp = [
        sequence_ratios(wave, wave)[0],
        sequence_ratios(one, one)[1],
        sequence_ratios(one, one)[2],
        sequence_ratios(flat, flat)[3],
    ]
    names, bounds = ["(17)", "(18)", "(22)", "(27)"], ["(21)", "(25)", "(25) widened", "Theorem 3"]
    return table(
        "The inequalities behind the theorems",
        {"inequality": names, "bound": bounds},
        left_over_right=variable(
            np.max(ratios, axis=0), ("inequality",), "largest left over right", tolerance=1 + 1e-12
        ),
        sharp=variable(sharp, ("inequality",), "the same for the sharpest sequence"),
        bound_excess=variable(
            np.max(excess, axis=0), ("bound",), "largest bound minus energy", tolerance=1e-10
        ),
    )
