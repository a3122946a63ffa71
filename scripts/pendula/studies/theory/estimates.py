"""Lemma 2: Picard's method, and how solutions depend on their initial conditions."""

from collections.abc import Callable
from functools import partial

import numpy as np
from latticode.datasets.checks import table, tabulate, variable
from latticode.measures.norms import power_of
from latticode.numerics import elementary
from latticode.numerics.elementary import modulus, square_modulus
from latticode.numerics.quadrature import integration_matrix

from pendula.models.bounds import lipschitz
from pendula.problem import Constants

from .equations import BOUNDARIES, random_amplitudes, right_hand_side, run

NODES = 12
"""Nodes in time: polynomials of that degree hold the solution over a short time to rounding."""


def picard(rates: Callable, start: np.ndarray, span: float, times: int, first: np.ndarray):
    """Return Picard's iterates at the end of `span`, and the largest changes of one to the next.

    `rates` takes and returns states (time, 2, N). The iterates begin with `first` at all times.
    """
    angles = np.pi * (np.arange(NODES - 1) + 0.5) / (NODES - 1)
    nodes = np.append(0.5 - 0.5 * elementary.cos(angles), 1.0)
    weights = span * integration_matrix(nodes)
    states, changes = np.repeat(first[None], NODES, axis=0), []
    for _ in range(times):
        new = start + np.sum(weights[:, :, None, None] * rates(states), axis=1)
        changes.append(np.sqrt(np.sum(square_modulus(new - states), axis=(1, 2))).max())
        states = new
    return states[-1], np.array(changes)


def contraction(changes: np.ndarray) -> float:
    """Return the largest change of an iterate over the one before; at 1e-10 rounding decides."""
    seen = changes[changes > 1e-10]
    return float((seen[1:] / seen[:-1]).max(initial=0.0))


def with_a_root(rates: Callable) -> Callable:
    """Return rates with the term A / |A|^(1/2), which is not Lipschitz where A = 0."""

    def rooted(states):
        size = np.sqrt(modulus(states))
        return rates(states) + np.where(size > 0.0, states / np.maximum(size, 1e-300), 0.0)

    return rooted


def check_picard(constants: Constants, sites: int, norm: float, longer: float, seed: int) -> dict:
    """Iterate (16) forwards and backwards on the interval that the contraction argument gives.

    In the ball of twice the norm of the data the Lipschitz constant is L; for times up to 1 / (2 L)
    each change is at most half of the one before, and the limit solves (4). Iterates that begin
    with the data and with something at a distance of `norm` come to one limit: the solution is
    unique. Neither holds without its condition: on an interval `longer` times as long, and for a
    rate that is not Lipschitz at rest, where the chain may stay or leave as tau^2.
    """
    rng, rows = np.random.default_rng(seed), []
    span = 1.0 / (2.0 * lipschitz(constants, 2.0 * norm))
    for boundary in BOUNDARIES:
        rates = partial(right_hand_side, constants, boundary)
        start = random_amplitudes(rng, sites, norm)
        off = random_amplitudes(np.random.default_rng([seed, 1]), sites, norm)
        long = contraction(picard(rates, start, longer * span, 24, start)[1])
        rooted, rest = with_a_root(rates), 0.0 * start
        ends = [picard(rooted, rest, span, 24, first)[0] for first in (rest, off)]
        for sign in (1.0, -1.0):
            limit, changes = picard(rates, start, sign * span, 24, start)
            other, _ = picard(rates, start, sign * span, 24, start + off)
            data = start if sign > 0 else start.conj()  # conjugation reverses time
            exact = run(constants, boundary, data, span).final
            row = {
                "contraction": contraction(changes),
                "picard_error": modulus(limit - (exact if sign > 0 else exact.conj())).max(),
                "limits_apart": modulus(other - limit).max(),
                "long_contraction": long,
                "rooted_limits_apart": modulus(ends[1] - ends[0]).max(),
            }
            rows.append(row)
    about = {
        "contraction": ("contraction: largest change of an iterate over the one before", 0.5),
        "picard_error": ("last iterate minus the solution", 1e-10),
        "limits_apart": ("difference of the limits of two first guesses", 1e-10),
        "long_contraction": "contraction on a longer interval",
        "rooted_limits_apart": "difference of the limits for a rate that is not Lipschitz",
    }
    coords = {"boundary": BOUNDARIES, "way": ["forwards", "backwards"]}
    title = "Picard's iterates of the integral equations (16)"
    return tabulate(title, coords, rows, about)


def check_dependence(
    constants: Constants, sites: int, end_time, distances, samples: int, seed: int
) -> dict:
    """Follow pairs of solutions whose data are `distances` apart in l2.

    The distance at the end must fall in proportion, and stay below Gronwall's bound: it grows at
    most as exp(2 |gamma| + M^2) per unit of tau, where M is the largest amplitude of both, since
    the Laplacian and Omega keep it, and the cubic terms add M^2 at most.
    """
    rng, distances = np.random.default_rng(seed), np.asarray(distances, float)
    shape, outputs = (samples, len(distances)), 20
    grown, allowed = np.empty(shape), np.empty(shape)
    for sample in range(samples):
        boundary = BOUNDARIES[sample % len(BOUNDARIES)]
        start, direction = (random_amplitudes(rng, sites, norm) for norm in (1.5, 1.0))
        base = run(constants, boundary, start, end_time, outputs)
        for i, distance in enumerate(distances):
            other = run(constants, boundary, start + distance * direction, end_time, outputs)
            largest = max(base.linf.max(), other.linf.max())
            grown[sample, i] = np.sqrt(power_of(other.final - base.final)) / distance
            rate = 2.0 * abs(constants.gamma) + largest * largest
            allowed[sample, i] = elementary.exp(rate * end_time)
    dims = ("sample", "distance")
    return table(
        "How far solutions part whose data are near each other",
        {"sample": np.arange(samples), "distance": distances},
        stretch=variable(grown, dims, "distance in l2 at the end over that of the data"),
        stretch_over_bound=variable(
            grown / allowed, dims, "the same over Gronwall's bound", tolerance=1.0
        ),
    )
