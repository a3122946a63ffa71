"""The estimates of Lemma 2: the balance of the l2 norm, and the bound (19) on its growth.

P = |A|^2 + |B|^2 in l2. Its rate is at most 4 |gamma| P in either direction of time, so that
|log P(t) - log P(s)| <= 4 |gamma| |t - s| for any two times of any trajectory.
"""

from collections.abc import Mapping

import numpy as np

from pendula.datasets.checks import tabulate, variable
from pendula.measures.norms import growth_margin, power_of
from pendula.numerics import elementary
from pendula.numerics.draws import uniform
from pendula.numerics.elementary import modulus, product
from pendula.numerics.quadrature import gauss_legendre
from pendula.problem import Constants

from .equations import BOUNDARIES, TIGHT, random_amplitudes, right_hand_side, run


def norm_balance(amplitudes: np.ndarray, gamma: float) -> float:
    """Return the right-hand side of the balance equation of P, as Lemma 2 prints it."""
    a, b = amplitudes
    ab, aa, bb = product(a, b), product(a, a), product(b, b)
    total = 2 * ab - 2 * ab.conj() + aa.conj() + bb.conj() - aa - bb
    return -gamma * float(np.sum(total).imag)  # the real part of i gamma times the sum


def integrated_balance(
    constants: Constants,
    boundary: str,
    amplitudes,
    end_time: float,
    panels: int,
    gamma: float,
    solver: Mapping = TIGHT,
):
    """Return the change of P along a trajectory and the integral of its balance (Gauss-Legendre).

    The balance has the `gamma` that is stated for it.

    The state is carried from node to node, eight to a panel.
    """
    nodes, weights = gauss_legendre(8)
    half = 0.5 * end_time / panels
    times = np.concatenate([half * (2 * k + 1 + nodes) for k in range(panels)] + [[end_time]])
    state, now, integral = amplitudes, 0.0, 0.0
    for i, time in enumerate(times):
        state = run(constants, boundary, state, time - now, solver=solver).final
        now = time
        if i < len(times) - 1:
            integral += half * weights[i % 8] * norm_balance(state, gamma)
    return power_of(state) - power_of(amplitudes), float(integral)


def check_balance(
    constants: Constants,
    sites: int,
    end_time: float,
    panels: int,
    seed: int,
    gamma_times: float = 1.0,
) -> dict:
    """Test the balance equation at random states and integrated along a trajectory."""
    rng, gamma = np.random.default_rng(seed), gamma_times * constants.gamma
    rows = []
    for boundary in BOUNDARIES:
        errors = []
        for _ in range(10):
            state = random_amplitudes(rng, sites, 3.0)
            rates = right_hand_side(constants, boundary, state)
            rate = float(2.0 * np.sum(product(state.conj(), rates).real))
            errors.append(abs(rate - norm_balance(state, gamma)))
        start = random_amplitudes(rng, sites, 1.5)
        change, integral = integrated_balance(constants, boundary, start, end_time, panels, gamma)
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
    constants: Constants,
    sites: int,
    end_time: float,
    samples: int,
    seed: int,
    gamma_times: float = 1.0,
) -> dict:
    """Test (19) forwards and backwards on random data, and that 4 |gamma| cannot be lowered.

    Backwards means the conjugate data run forwards: conjugation reverses time, which is tested
    by returning to the start. The sharp case is one site with Omega = 2 epsilon, where kappa is
    zero and A = -B = x e^{i pi / 4} grows by e^{2 gamma tau} for as long as it is small.
    """
    rng, gamma = np.random.default_rng(seed), gamma_times * constants.gamma
    rows = []
    for sample in range(samples):
        boundary = BOUNDARIES[sample % len(BOUNDARIES)]
        norm = float(elementary.power(10.0, uniform(rng, -2.0, 0.7)))
        start = random_amplitudes(rng, sites, norm)
        forth = run(constants, boundary, start, end_time, 100)
        back = run(constants, boundary, start.conj(), end_time, 100)
        forwards = growth_margin(forth.tau, forth.l2, gamma)
        backwards = growth_margin(back.tau, back.l2, gamma)
        short = run(constants, boundary, start, 1.0).final
        again = run(constants, boundary, short.conj(), 1.0).final.conj()
        rows.append(
            {
                "forwards": forwards["from_start"],
                "backwards": backwards["from_start"],
                "steepest": max(forwards["steepest"], backwards["steepest"]),
                "reversal": modulus(again - start).max() / modulus(start).max(),
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
    a = 1e-8 * elementary.turn(0.25 * np.pi)
    data = np.array([[a], [-a]])
    constants = Constants(epsilon=1.0, gamma=gamma, omega=2.0)
    final = run(constants, "dirichlet", data, end_time).final
    grown = power_of(final) / power_of(data)
    return float(grown / elementary.exp(4.0 * gamma * end_time))
