"""Lemma 2: Picard's method, dependence on data, the balance of P, and the bound (19) on its growth.

P = |A|^2 + |B|^2 in l2. Its rate is at most 4 |gamma| P in either direction of time, so that
|log P(t) - log P(s)| <= 4 |gamma| |t - s| for any two times of any trajectory.
"""

import numpy as np

from pendula.datasets.checks import table, tabulate, variable
from pendula.measures.norms import growth_margin, power_of
from pendula.models.bounds import lipschitz
from pendula.numerics import elementary
from pendula.numerics.draws import uniform
from pendula.numerics.elementary import modulus, product, square_modulus
from pendula.numerics.quadrature import gauss_legendre, integration_matrix
from pendula.problem import Constants

from .equations import BOUNDARIES, TIGHT, misstated, random_amplitudes, right_hand_side, run

NODES = 12
"""Nodes in time: polynomials of that degree hold the solution over a short time to rounding."""


def picard(constants, boundary, start, span: float, times: int, first: np.ndarray, root=0.0):
    """Return Picard's iterates at the end of `span`, and the largest changes of one to the next.

    They begin with `first` at all times. The rates are those of (4) and `root` A / |A|^(1/2).
    """
    angles = np.pi * (np.arange(NODES - 1) + 0.5) / (NODES - 1)
    nodes = np.append(0.5 - 0.5 * elementary.cos(angles), 1.0)
    weights = span * integration_matrix(nodes)
    states, changes = np.repeat(first[None], NODES, axis=0), []
    for _ in range(times):
        rates = right_hand_side(constants, boundary, states)
        if root:
            size = np.sqrt(modulus(states))
            rates = rates + root * np.where(size > 0.0, states / np.maximum(size, 1e-300), 0.0)
        new = start + np.sum(weights[:, :, None, None] * rates, axis=1)
        changes.append(np.sqrt(np.sum(square_modulus(new - states), axis=(1, 2))).max())
        states = new
    return states[-1], np.array(changes)


def check_picard(
    constants: Constants, sites: int, norm: float, seed: int, span_times=1.0, root=0.0
) -> dict:
    """Iterate (16) forwards and backwards on the interval that the contraction argument gives.

    In the ball of twice the norm of the data the Lipschitz constant is L; for times up to 1 / (2 L)
    each change is at most half of the one before, and the limit solves (4). Iterates that begin
    with the data and with something at a distance of `norm` come to one limit: the solution is
    unique. One control takes an interval `span_times` as long. Another one adds `root` times
    A / |A|^(1/2) to the rates, which is not Lipschitz at rest, and starts there: the chain may stay
    at rest, or leave it as tau^2.
    """
    rng, rows = np.random.default_rng(seed), []
    span = span_times / (2.0 * lipschitz(constants, 2.0 * norm))
    for boundary in BOUNDARIES:
        start = random_amplitudes(rng, sites, norm)
        start = 0.0 * start if root else start
        away = start + random_amplitudes(np.random.default_rng([seed, 1]), sites, norm)
        row = {}
        for sign, name in ((1.0, "forwards"), (-1.0, "backwards")):
            at = (constants, boundary, start, sign * span, 24)
            limit, changes = picard(*at, start, root)
            other, _ = picard(*at, away, root)
            row[f"limits_apart_{name}"] = modulus(other - limit).max()
            seen = changes[changes > 1e-10]  # beyond, rounding decides
            row[f"contraction_{name}"] = (seen[1:] / seen[:-1]).max(initial=0.0)
            data = start if sign > 0 else start.conj()  # conjugation reverses time
            exact = run(constants, boundary, data, span).final
            missed = modulus(limit - (exact if sign > 0 else exact.conj()))
            row[f"picard_error_{name}"] = missed.max()
        rows.append(row)
    kinds = (
        ("contraction", "largest change of an iterate over the one before", 0.5),
        ("picard_error", "last iterate minus the solution", 1e-10),
        ("limits_apart", "difference of the limits of two first guesses", 1e-10),
    )
    about = {
        f"{name}_{way}": (f"{words}, {way}", tolerance)
        for way in ("forwards", "backwards")
        for name, words, tolerance in kinds
    }
    length = variable(span, (), "length of the interval in tau")
    title = "Picard's iterates of the integral equations (16)"
    return tabulate(title, {"boundary": BOUNDARIES}, rows, about, picard_span=length)


def check_dependence(
    constants: Constants, sites: int, end_time, distances, samples: int, seed: int, omega_off=0.0
) -> dict:
    """Follow pairs of solutions whose data are `distances` apart in l2.

    The distance at the end must fall in proportion, and stay below Gronwall's bound: it grows at
    most as exp(2 |gamma| + M^2) per unit of tau, where M is the largest amplitude of both, since
    the Laplacian and Omega keep it, and the cubic terms add M^2 at most. In a control one of both
    moves with another Omega, so that their distance does not go to zero.
    """
    rng, stated = np.random.default_rng(seed), misstated(constants, omega_off)
    distances = np.asarray(distances, float)
    shape, outputs = (samples, len(distances)), 20
    grown, allowed = np.empty(shape), np.empty(shape)
    for sample in range(samples):
        boundary = BOUNDARIES[sample % len(BOUNDARIES)]
        start, direction = (random_amplitudes(rng, sites, norm) for norm in (1.5, 1.0))
        base = run(constants, boundary, start, end_time, outputs)
        for i, distance in enumerate(distances):
            other = run(stated, boundary, start + distance * direction, end_time, outputs)
            largest = max(base.linf.max(), other.linf.max())
            grown[sample, i] = np.sqrt(power_of(other.final - base.final)) / distance
            rate = 2.0 * abs(constants.gamma) + largest * largest
            allowed[sample, i] = elementary.exp(rate * end_time)
    steps = elementary.log(distances[-2] / distances[-1])
    orders = 1.0 + elementary.log(grown[:, -2] / grown[:, -1]) / steps
    over, dims = grown / allowed, ("sample", "distance")
    order = "order of the distance at the end in that of the data"
    return table(
        "How far solutions part whose data are near each other",
        {"sample": np.arange(samples), "distance": distances},
        stretch=variable(grown, dims, "distance in l2 at the end over that of the data"),
        stretch_over_bound=variable(over, dims, "the same over Gronwall's bound", tolerance=1.0),
        distance_order=variable(orders, dims[:1], order),
    )


def norm_balance(amplitudes: np.ndarray, gamma: float) -> float:
    """Return the right-hand side of the balance equation of P, as Lemma 2 prints it."""
    a, b = amplitudes
    ab, aa, bb = product(a, b), product(a, a), product(b, b)
    total = 2 * ab - 2 * ab.conj() + aa.conj() + bb.conj() - aa - bb
    return -gamma * float(np.sum(total).imag)  # the real part of i gamma times the sum


def integrated_balance(
    constants, boundary: str, amplitudes, end_time: float, panels: int, gamma: float, solver=TIGHT
) -> tuple[float, float]:
    """Return the change of P along a trajectory and the integral of its balance (Gauss-Legendre).

    The balance has the `gamma` that is stated for it. The state is carried from node to node, eight
    to a panel.
    """
    nodes, weights = gauss_legendre(8)
    half = 0.5 * end_time / panels
    times = np.concatenate([half * (2 * k + 1 + nodes) for k in range(panels)] + [[end_time]])
    state, integral = amplitudes, 0.0
    for i, step in enumerate(np.diff(times, prepend=0.0)):
        state = run(constants, boundary, state, step, solver=solver).final
        if i < len(times) - 1:
            integral += half * weights[i % 8] * norm_balance(state, gamma)
    return power_of(state) - power_of(amplitudes), float(integral)


def check_balance(
    constants: Constants, sites: int, end_time: float, panels: int, seed: int, gamma_times=1.0
) -> dict:
    """Test the balance equation at random states and integrated along a trajectory."""
    rng, gamma, rows = np.random.default_rng(seed), gamma_times * constants.gamma, []
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
    about = {
        "pointwise": ("dP/dtau minus its balance", 1e-12),
        "integrated": ("change of P minus its integral", 1e-9),
    }
    title = "The balance equation of the l2 norm (Lemma 2)"
    return tabulate(title, {"boundary": BOUNDARIES}, rows, about)


def check_growth(
    constants: Constants, sites: int, end_time: float, samples: int, seed: int, gamma_times=1.0
) -> dict:
    """Test (19) forwards and backwards on random data, and that 4 |gamma| cannot be lowered.

    Backwards means the conjugate data run forwards: conjugation reverses time, which is tested
    by returning to the start.
    """
    rng, gamma, rows = np.random.default_rng(seed), gamma_times * constants.gamma, []
    for sample in range(samples):
        boundary = BOUNDARIES[sample % len(BOUNDARIES)]
        norm = float(elementary.power(10.0, uniform(rng, -2.0, 0.7)))
        start = random_amplitudes(rng, sites, norm)
        both = [run(constants, boundary, z, end_time, 100) for z in (start, start.conj())]
        forwards, backwards = (growth_margin(one.tau, one.l2, gamma) for one in both)
        short = run(constants, boundary, start, 1.0).final
        again = run(constants, boundary, short.conj(), 1.0).final.conj()
        row = {
            "forwards": forwards["from_start"],
            "backwards": backwards["from_start"],
            "steepest": max(forwards["steepest"], backwards["steepest"]),
            "reversal": modulus(again - start).max() / modulus(start).max(),
        }
        rows.append(row)
    limit = 1.0 + 1e-9
    about = {
        "forwards": ("largest P over its bound, forwards", limit),
        "backwards": ("largest P over its bound, backwards", limit),
        "steepest": ("steepest log P over 4 gamma", limit),
        "reversal": ("miss after there and back", 1e-8),
    }
    sharpest = variable(sharpest_growth(), (), "the sharp case over its bound")
    title = "The bound (19) on the growth of l2, forwards and backwards"
    return tabulate(title, {"sample": np.arange(samples)}, rows, about, sharpest=sharpest)


def sharpest_growth() -> float:
    """Return P(tau) over its bound (19) in the sharp case; one but for the tiny cubic term.

    That is one site with Omega = 2 epsilon, where kappa is zero and A = -B = x e^{i pi / 4} grows
    by e^{2 gamma tau} for as long as it is small.
    """
    gamma, end_time = 1.0, 4.0
    a = 1e-8 * elementary.turn(0.25 * np.pi)
    data = np.array([[a], [-a]])
    constants = Constants(epsilon=1.0, gamma=gamma, omega=2.0)
    final = run(constants, "dirichlet", data, end_time).final
    return float(power_of(final) / power_of(data) / elementary.exp(4.0 * gamma * end_time))
