"""The thermal states exp(-beta H) of the infinite chain, solved by its transfer operator.

Nothing is sampled: an eigenvector of the operator (see `transfer`) gives the means of a site. Their
error is that of the grid, which a coarser and wider grid measures.

The energy needs no bond. The mean of y dH/dy is 4 / beta a site, and y dH/dy is 2 H plus twice the
quartic term: the energy a site is 2 / beta - <quartic>.

Bits: the states have the same bits on every machine. Densities need a Bessel function and products
of large matrices, whose last bits differ by some 4e-15: they are rounded to DECIMALS, so that one
in a million could come out otherwise. The rest is rounded to DIGITS: the grid gives no more.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from scipy.special import j1

from pendula.datasets.checks import rounded
from pendula.datasets.netcdf import Variable
from pendula.numerics.elementary import cos, exp, log, sin
from pendula.problem import Constants

from .bulk import LENGTH, POWER, TERMS, statistics_of
from .transfer import (
    Operator,
    applied,
    bonds_between,
    half_nodes,
    leading,
    make_operator,
    normalised,
    reach_of,
    smoothed,
)

HOT, COLD = 1e-3, 1e5
"""Inverse temperatures between which a state is looked for."""

REACH = 25.0
"""The first grid ends where the weight of a site is below exp(-REACH) of its largest value."""

DIGITS, DECIMALS = 7, 6
LAST_DIGIT = float(f"1e-{DIGITS}")
"""Significant digits of what is published, and the decimals of densities."""


class NoStateError(ValueError):
    """No thermal state between HOT and COLD has the energy."""


class ThermalState(NamedTuple):
    """A thermal state: means of a site of the infinite chain."""

    beta: float
    energy: float  # a site
    power: float  # <|A|^2 + |B|^2>
    power_error: float  # change from a coarser and wider grid, and the rounding
    operator: Operator
    vector: np.ndarray  # psi, the sum of its squares is one


def widest(constants: Constants, beta: float) -> np.ndarray:
    """Return a bound on the coordinates: beyond it a site has less than exp(-REACH) of the weight.

    The energy of a site is above P^2 / 8 - c P with c as below, and beta times that above its least
    value by REACH at the bound.
    """
    epsilon, gamma, omega = constants
    c = 4.0 * epsilon + 2.0 * gamma - omega
    least = 16.0 * min(c, 0.0) * min(c, 0.0)
    return np.full(4, np.sqrt(4.0 * c + np.sqrt(least + 8.0 * REACH / beta)))


def state_of_energy(constants: Constants, energy: float, nodes: int) -> ThermalState:
    """Return the thermal state with an energy per site, on `nodes` half-nodes a coordinate.

    Three grids follow each other: one with half of the nodes finds beta roughly and how far the
    distribution reaches, one with three quarters gives the error, the last gives the state.
    Raises NoStateError where no state between HOT and COLD has this energy.
    """
    few, some = nodes // 2, 3 * nodes // 4

    def rough(beta: float) -> float:
        grid = half_nodes(widest(constants, beta), few)
        return _excess(constants, beta, grid, energy)[0]

    try:
        beta = _bisected(rough)
    except NoStateError as error:
        raise NoStateError(f"{error}: {energy:g} at Omega = {constants.omega:g}") from None
    reach = widest(constants, beta)
    tried = []
    for count, wider in ((few, 1.0), (some, 1.1), (nodes, 1.0)):
        grid = half_nodes(wider * reach, count)
        beta, operator, vector = _refined(constants, beta, grid, energy)
        reach = reach_of(operator, vector)
        power = float(np.sum(vector * vector * operator.power))
        tried.append(power)
    error = abs(tried[-1] - tried[-2]) + 0.5 * LAST_DIGIT * tried[-1]
    return ThermalState(beta, energy, power, error, operator, vector)


def _excess(constants, beta, grid, energy, vector=None) -> tuple[float, Operator, np.ndarray]:
    """Return beta (energy - that of the state at beta), which rises with beta; operator, vector."""
    operator = make_operator(constants, beta, grid)
    vector = leading(operator, vector)
    quartic = float(np.sum(vector * vector * operator.quartic))
    return beta * (energy + quartic) - 2.0, operator, vector


def _bisected(function: Callable[[float], float], halvings: int = 7) -> float:
    hot, cold = HOT, COLD
    if function(hot) > 0.0 or function(cold) < 0.0:
        raise NoStateError("no thermal state between the temperatures tried has the energy")
    for _ in range(halvings):
        beta = float(np.sqrt(hot * cold))
        hot, cold = (beta, cold) if function(beta) < 0.0 else (hot, beta)
    return float(np.sqrt(hot * cold))


def _refined(constants, beta, grid, energy, steps: int = 12):
    """Return beta, operator and vector where the excess vanishes, by secants in log beta."""
    old, (excess, operator, vector) = beta, _excess(constants, beta, grid, energy)
    beta *= 1.01
    for _ in range(steps):
        before = excess
        excess, operator, vector = _excess(constants, beta, grid, energy, vector)
        if abs(excess) < 1e-8:
            return beta, operator, vector
        slope = (excess - before) / log(beta / old)
        old, beta = beta, beta * float(exp(np.clip(-excess / slope, -0.5, 0.5)))
    raise ArithmeticError("no temperature with this energy was found")


# --- What a state is like -------------------------------------------------------------------------


def terms_of(state: ThermalState) -> np.ndarray:
    """Return the means of the terms of (8) a site, in the order of `bulk.TERMS`."""
    operator = state.operator
    chance = (state.vector * state.vector).sum(axis=0)
    _, t, _, q = np.ix_(*operator.nodes)
    quartic = 2.0 / state.beta - state.energy
    detuning = operator.constants.omega * state.power
    drive = -2.0 * operator.constants.gamma * float(np.sum(chance * (t * t - q * q)))
    return np.array([quartic, detuning, drive, state.energy - quartic - detuning - drive])


def products_of(state: ThermalState, lags: int) -> np.ndarray:
    """Return the mean product of each coordinate and itself r sites on, (coordinate, r < lags).

    With v_j the operator's power j applied to a coordinate times psi, it is the product of v_j and
    v_k with j + k = r, times the (-1)^r of the change of signs. It is zero from where it is below
    1e-10 of the first.
    """
    parities = ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (1, 1, 1, 0))
    found = [_products(state, axis, parity, lags) for axis, parity in enumerate(parities)]
    return np.array(found) * np.where(np.arange(lags) % 2, -1.0, 1.0)


def _products(state: ThermalState, axis: int, parity: tuple, lags: int) -> np.ndarray:
    operator, psi = state.operator, state.vector
    scale = np.sum(psi * applied(operator, psi))  # the largest eigenvalue
    y = np.ix_(*operator.nodes)[axis]
    vector = psi * (np.array([y, -y]) if axis == 3 else y)
    found = np.zeros(lags)
    for lag in range(0, lags, 2):
        square = np.sum(vector * vector)
        if square < 1e-10 * found[0]:
            break
        following = applied(operator, vector, parity) / scale
        found[lag] = square
        found[lag + 1 : lag + 2] = np.sum(vector * following)
        vector = following
    return found


def correlation_length(products: np.ndarray) -> float:
    """Return the sites over which the slowest of the products falls by a factor of e."""
    ratios = []
    for even in products[:, 0::2]:
        last = np.flatnonzero(even).max()
        ratios.append(even[last] / even[last - 1])
    return float(-2.0 / log(max(ratios)))


def spectrum_of(products: np.ndarray) -> np.ndarray:
    """Return the spectrum of A, as `bulk.spectrum` takes it from pieces as long as the products."""
    lags = np.arange(products.shape[1])
    shares = (1.0 - lags / len(lags)) * 0.5 * products.sum(axis=0)
    waves = cos(2.0 * np.pi / len(lags) * (np.outer(lags, lags) % len(lags)))
    return 2.0 * (waves * shares).sum(axis=1) - shares[0]


def density_of(state: ThermalState, cells: np.ndarray, finer: int) -> np.ndarray:
    """Return the probability density of |A|, means between `cells`; that of |B| is the same.

    The integral over k of the mean of exp(i k A) times r J_1(k r) / (2 pi k) is the probability of
    a modulus below r. The operator itself interpolates psi to the `finer` nodes that this needs.
    """
    nodes = half_nodes(state.operator.nodes[:, -1], finer)
    k = _wave_numbers(nodes, float(cells[-1]))
    weights = _characteristic(nodes, _chances(state, nodes), k)
    size = np.sqrt(k[:, None] ** 2 + k**2)
    weights *= 4.0 * (k[1] - k[0]) * (k[1] - k[0]) / (2.0 * np.pi * size)
    below = np.array([r * np.sum(weights * j1(size * r)) for r in cells])
    return np.diff(below) / np.diff(cells)


def _wave_numbers(nodes: np.ndarray, highest: float) -> np.ndarray:
    """Return midpoints in k: so fine that images of A stay away, up to what the nodes resolve."""
    far = max(np.sqrt(2.0) * float(nodes.max()), highest)
    step, last = np.pi / far, np.pi / (2.0 * float(nodes[:, 0].max()))
    return step * (np.arange(int(last / step)) + 0.5)


def _chances(state: ThermalState, nodes: np.ndarray) -> np.ndarray:
    """Return the probability of each of some nodes of a state, (2, m, m, m, m)."""
    old = state.operator
    new = make_operator(old.constants, old.beta, nodes)
    bonds = bonds_between(old.beta, old.constants.epsilon, nodes, old.nodes)
    return normalised(new.roots * smoothed(bonds, old.roots * state.vector)) ** 2


def _characteristic(nodes: np.ndarray, chances: np.ndarray, k: np.ndarray) -> np.ndarray:
    """Return the mean of exp(i (k Re A + l Im A)) for all k, l; it is real and even in both.

    Over the signs of the coordinates it is the mean of products of cosines and of sines.
    """
    waves = np.multiply.outer(k, nodes / np.sqrt(2.0))  # (k, coordinate, node)
    both = chances.reshape(2, nodes.shape[1] ** 2, -1)
    found = np.zeros((len(k), len(k)))
    for wave, chance in ((cos(waves), both[0] + both[1]), (sin(waves), both[0] - both[1])):
        real = (wave[:, 0, :, None] * wave[:, 1, None]).reshape(len(k), -1)
        imaginary = (wave[:, 2, :, None] * wave[:, 3, None]).reshape(len(k), -1)
        found += real @ chance @ imaginary.T
    return found


# --- The dataset ----------------------------------------------------------------------------------

HIGHEST_MODULUS, CELLS = 12.0, 80


def thermal_variables(
    states: list[ThermalState], warm: list[ThermalState], density_nodes: int
) -> dict[str, Variable]:
    """Return the states of zero energy, one for each Omega, and the `warm` ones over the energy.

    `density_nodes` are the half-nodes a coordinate from which densities are summed.
    """
    cells, omega, energy = np.linspace(0.0, HIGHEST_MODULUS, CELLS + 1), "omega", "site_energy"
    # of 0 and -0 processors take either for the larger one, and a sum with zero has no sign
    densities = [
        np.maximum(0.0, density_of(one, cells, density_nodes).round(DECIMALS)) + 0.0
        for one in states
    ]
    products = [products_of(state, LENGTH) for state in states]
    spectra = [rounded(spectrum_of(one), DIGITS - 1) for one in products]
    lengths = [correlation_length(one) for one in products]
    words = "in the thermal state of a given energy a site"
    places = {"decimal_places": DECIMALS}
    statistics = statistics_of(spectra, densities, cells, (omega,))
    for name, said in (("spectrum", digits(DIGITS - 1)), ("density", places)):
        statistics[name] = statistics[name]._replace(attributes=said)
    return {
        "omega": Variable((omega,), [one.operator.constants.omega for one in states]),
        **_means(states, (omega,), "", "in the thermal state of no energy"),
        "correlation_length": Variable(
            (omega,),
            rounded(lengths, 4),
            "sites over which the slowest correlation falls by e",
            attributes=digits(4),
        ),
        **statistics,
        "site_energy": Variable((energy,), [one.energy for one in warm], "energy H a site"),
        **_means(warm, (energy,), "warm_", words),
    }


def digits(count: int = DIGITS) -> dict[str, int]:
    """Return the attribute of values that are rounded to so many digits."""
    return {"significant_digits": count}


def _means(states: list[ThermalState], along: tuple, prefix: str, words: str) -> dict:
    powers, errors = ([getattr(one, name) for one in states] for name in ("power", "power_error"))
    terms = [rounded(terms_of(one), DIGITS) for one in states]
    return {
        "term": Variable(("term",), list(TERMS), "term of the energy (8)"),
        f"{prefix}beta": Variable(
            along,
            rounded([one.beta for one in states], DIGITS),
            f"inverse temperature {words}",
            attributes=digits(),
        ),
        f"{prefix}power": Variable(
            along, rounded(powers, DIGITS), f"{POWER} {words}", attributes=digits()
        ),
        f"{prefix}power_error": Variable(
            along,
            rounded(errors, 2),
            f"error of the discretisation and rounding of that {POWER}",
            attributes=digits(2),
        ),
        f"{prefix}terms": Variable(
            (*along, "term"),
            np.reshape(terms, (-1, len(TERMS))),
            f"terms of H per site {words}",
            attributes=digits(),
        ),
    }
