"""Lemma 2: Picard's method on the integral equations (16), and how solutions hang on their data."""

import numpy as np

from pendula.datasets.checks import table, tabulate, variable
from pendula.measures.norms import power_of
from pendula.models.bounds import lipschitz
from pendula.numerics import elementary
from pendula.numerics.elementary import modulus, square_modulus
from pendula.numerics.quadrature import integration_matrix
from pendula.problem import Constants

from .equations import BOUNDARIES, misstated, random_amplitudes, right_hand_side, run

NODES = 12
"""Nodes in time: polynomials of that degree hold the solution over a short time to rounding."""


def picard(
    constants: Constants,
    boundary: str,
    start: np.ndarray,
    span: float,
    times: int,
    first: np.ndarray,
    root: float = 0.0,
):
    """Return Picard's iterates at the end of `span`, and the largest changes of one to the next.

    They begin with `first` at all times. The rates are those of (4) and `root` A / |A|^(1/2).
    """
    nodes = np.append(
        0.5 - 0.5 * elementary.cos(np.pi * (np.arange(NODES - 1) + 0.5) / (NODES - 1)), 1.0
    )
    weights = span * integration_matrix(nodes)
    states = np.repeat(first[None], NODES, axis=0)
    changes = []
    for _ in range(times):
        rates = np.array([right_hand_side(constants, boundary, state) for state in states])
        if root:
            size = np.sqrt(modulus(states))
            rates = rates + root * np.where(size > 0.0, states / np.maximum(size, 1e-300), 0.0)
        new = start + np.sum(weights[:, :, None, None] * rates, axis=1)
        changes.append(np.sqrt(np.sum(square_modulus(new - states), axis=(1, 2))).max())
        states = new
    return states[-1], np.array(changes)


def check_picard(
    constants: Constants,
    sites: int,
    norm: float,
    seed: int,
    span_times: float = 1.0,
    root: float = 0.0,
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
    return tabulate(
        "Picard's iterates of the integral equations (16)",
        {"boundary": BOUNDARIES},
        rows,
        {
            f"{name}_{way}": (f"{words}, {way}", tolerance)
            for way in ("forwards", "backwards")
            for name, words, tolerance in (
                ("contraction", "largest change of an iterate over the one before", 0.5),
                ("picard_error", "last iterate minus the solution", 1e-10),
                ("limits_apart", "difference of the limits of two first guesses", 1e-10),
            )
        },
        picard_span=variable(span, (), "length of the interval in tau"),
    )


def spread_of(constants, stated, boundary, start, direction, distances, end_time: float):
    """Return distances of pairs of solutions at the end over those at the start, and Gronwall's.

    The distance grows at most as exp(2 |gamma| + M^2) per unit of tau, where M is the largest
    amplitude of both: the Laplacian and Omega keep it, and the cubic terms add M^2 at most.
    """
    outputs = 20
    base = run(constants, boundary, start, end_time, outputs)
    grown, allowed = [], []
    for distance in distances:
        other = run(stated, boundary, start + distance * direction, end_time, outputs)
        apart = np.sqrt(power_of(other.final - base.final))
        largest = max(base.linf.max(), other.linf.max())
        grown.append(apart / distance)
        rate = 2.0 * abs(constants.gamma) + largest * largest
        allowed.append(elementary.exp(rate * end_time))
    return np.array(grown), np.array(allowed)


def check_dependence(
    constants: Constants,
    sites: int,
    end_time: float,
    distances,
    samples: int,
    seed: int,
    omega_off: float = 0.0,
) -> dict:
    """Follow pairs of solutions whose data are `distances` apart in l2.

    The distance at the end must fall in proportion, and stay below Gronwall's bound. In a control
    one of both moves with another Omega, so that their distance does not go to zero.
    """
    rng, stated = np.random.default_rng(seed), misstated(constants, omega_off)
    rows, distances = [], np.asarray(distances, float)
    for sample in range(samples):
        boundary = BOUNDARIES[sample % len(BOUNDARIES)]
        start, direction = (random_amplitudes(rng, sites, norm) for norm in (1.5, 1.0))
        found = spread_of(constants, stated, boundary, start, direction, distances, end_time)
        rows.append(found)
    grown, allowed = np.array(rows).swapaxes(0, 1)
    steps = elementary.log(distances[-2] / distances[-1])
    orders = 1.0 + elementary.log(grown[:, -2] / grown[:, -1]) / steps
    dims = ("sample", "distance")
    return table(
        "How far solutions part whose data are near each other",
        {"sample": np.arange(samples), "distance": distances},
        stretch=variable(grown, dims, "distance in l2 at the end over that of the data"),
        stretch_over_bound=variable(
            grown / allowed, dims, "the same over Gronwall's bound", tolerance=1.0
        ),
        distance_order=variable(
            orders, dims[:1], "order of the distance at the end in that of the data"
        ),
    )
