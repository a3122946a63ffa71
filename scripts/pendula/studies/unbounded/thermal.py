"""The thermal states exp(-beta H) of the infinite chain, solved by its transfer operator.

Nothing is sampled: an eigenvector of the operator (see `transfer`) gives the means of a site. Their
error is that of the grid, which a coarser and wider grid measures.

The energy needs no bond. The mean of y dH/dy is f / beta a site with f coordinates, and y dH/dy is
2 H plus twice the quartic term: the energy a site is f / (2 beta) - <quartic>. Two fields have four
coordinates a site, and the chain with A = -B has two.

Bits: the states have the same bits on every machine. Densities need a Bessel function and products
of large matrices, whose last bits differ by some 4e-15: they are rounded to DECIMALS, so that one
in a million could come out otherwise. The rest is rounded to DIGITS: the grid gives no more.
"""

from typing import NamedTuple

import numpy as np
from scipy.special import j1

from pendula.datasets.checks import rounded
from pendula.datasets.netcdf import Variable
from pendula.datasets.trajectories import Contents
from pendula.numerics.elementary import cos, exp, log, sin
from pendula.problem import Constants

from . import transfer
from .bulk import POWER
from .extremes import law_of_maxima

HOT, COLD = 1e-3, 1e5
"""Inverse temperatures between which a state is looked for."""

HALVINGS, SECANTS = 7, 12
"""Steps to a rough beta on a coarse grid, and the most steps from there on a finer one."""

DIGITS, DECIMALS, PLACES = 7, 6, 10
LAST_DIGIT = float(f"1e-{DIGITS}")
"""Significant digits of what is published, the decimals of densities, and of the law of maxima."""

LAGS = 64
"""Sites over which products are correlated: as long are the pieces whose spectra they are."""


class NoStateError(ValueError):
    """No thermal state between HOT and COLD has the energy."""


class ThermalState(NamedTuple):
    """A thermal state: means of a site of the infinite chain."""

    beta: float
    energy: float  # a site
    power: float  # <|A|^2 + |B|^2>
    power_error: float  # change from a coarser and wider grid, and the rounding
    operator: transfer.Operator
    vector: np.ndarray  # psi, the sum of its squares is one


def state_of_energy(
    constants: Constants, energy: float, nodes: int, antisymmetric: bool = False
) -> ThermalState:
    """Return the thermal state with an energy per site, on `nodes` half-nodes a coordinate.

    It is that of both fields, or of the chain with A = -B.

    Three grids follow each other: one with half of the nodes finds beta roughly and how far the
    distribution reaches, one with three quarters gives the error, the last gives the state.
    Raises NoStateError where no state between HOT and COLD has this energy.
    """
    few, some = nodes // 2, 3 * nodes // 4

    def is_too_hot(beta: float) -> bool:
        grid = transfer.half_nodes(transfer.widest(constants, beta), few, antisymmetric)
        return _excess(constants, beta, grid, energy)[0] < 0.0

    if not is_too_hot(HOT) or is_too_hot(COLD):
        told = f"{energy:g} at Omega = {constants.omega:g}"
        raise NoStateError(f"no thermal state between the temperatures tried has the energy {told}")
    hot, cold = HOT, COLD
    for _ in range(HALVINGS):
        beta = float(np.sqrt(hot * cold))
        hot, cold = (beta, cold) if is_too_hot(beta) else (hot, beta)
    beta = float(np.sqrt(hot * cold))
    reach, powers = transfer.widest(constants, beta), []
    for count, wider in ((few, 1.0), (some, 1.1), (nodes, 1.0)):
        grid = transfer.half_nodes(wider * reach, count, antisymmetric)
        beta, operator, vector = _refined(constants, beta, grid, energy)
        reach = transfer.reach_of(operator, vector)
        powers.append(float(np.sum(vector * vector * operator.power)))
    error = abs(powers[-1] - powers[-2]) + 0.5 * LAST_DIGIT * powers[-1]
    return ThermalState(beta, energy, powers[-1], error, operator, vector)


def _excess(constants, beta, grid, energy, vector=None) -> tuple:
    """Return beta (energy - that of the state at beta), which rises with beta; operator, vector."""
    operator = transfer.make_operator(constants, beta, grid)
    vector = transfer.leading(operator, vector)
    quartic = float(np.sum(vector * vector * operator.quartic))
    return beta * (energy + quartic) - 0.5 * operator.freedom, operator, vector


def _refined(constants, beta, grid, energy) -> tuple:
    """Return beta, operator and vector where the excess vanishes, by secants in log beta."""
    old, (excess, operator, vector) = beta, _excess(constants, beta, grid, energy)
    beta *= 1.01
    for _ in range(SECANTS):
        before = excess
        excess, operator, vector = _excess(constants, beta, grid, energy, vector)
        if abs(excess) < 1e-8:
            return beta, operator, vector
        slope = (excess - before) / log(beta / old)
        old, beta = beta, beta * float(exp(np.clip(-excess / slope, -0.5, 0.5)))
    raise ArithmeticError("no temperature with this energy was found")


# --- Correlations, and the distribution of a modulus ----------------------------------------------

PARITIES = ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (1, 1, 1, 0))
"""Those of each coordinate times psi, see `transfer.EVEN`."""


def products_of(state: ThermalState, lags: int) -> np.ndarray:
    """Return the mean product of each coordinate and itself r sites on, (coordinate, r < lags).

    With v_j the operator's power j applied to a coordinate times psi, it is the product of v_j and
    v_k with j + k = r, times the (-1)^r of the change of signs. It is zero from where it is below
    1e-10 of the first.
    """
    operator, psi = state.operator, state.vector
    largest = np.sum(psi * transfer.applied(operator, psi))  # eigenvalue
    found = np.zeros((4, lags))
    for products, parity, y in zip(found, PARITIES, np.ix_(*operator.nodes), strict=True):
        vector = psi * (np.array([y, -y]) if parity == PARITIES[-1] else y)
        for lag in range(0, lags, 2):
            square = np.sum(vector * vector)
            if square < 1e-10 * products[0]:
                break
            following = transfer.applied(operator, vector, parity) / largest
            products[lag] = square
            products[lag + 1 : lag + 2] = np.sum(vector * following)
            vector = following
    return found * np.where(np.arange(lags) % 2, -1.0, 1.0)


def spectrum_of(products: np.ndarray) -> np.ndarray:
    """Return the spectrum of A.

    It is the mean of |A(k)|^2 over pieces of the chain that are as long as the products."""
    lags = np.arange(products.shape[1])
    shares = (1.0 - lags / len(lags)) * 0.5 * products.sum(axis=0)
    waves = cos(2.0 * np.pi / len(lags) * (np.outer(lags, lags) % len(lags)))
    return 2.0 * (waves * shares).sum(axis=1) - shares[0]


def density_of(state: ThermalState, cells: np.ndarray, finer: int) -> np.ndarray:
    """Return the probability density of |A|, means between `cells`; that of |B| is the same.

    The integral over k of the mean of exp(i k A) times r J_1(k r) / (2 pi k) is the probability of
    a modulus below r. The operator itself interpolates psi to the `finer` nodes that this needs.
    """
    old = state.operator
    nodes = transfer.half_nodes(np.array([one[-1] for one in old.nodes]), finer, False)
    new = transfer.make_operator(old.constants, old.beta, nodes)
    bonds = tuple(
        transfer.bonds_between(old.beta, old.constants.epsilon, to, start)
        for to, start in zip(nodes, old.nodes, strict=True)
    )
    psi = transfer.normalised(new.roots * transfer.smoothed(bonds, old.roots * state.vector))
    # midpoints in k: so fine that images of A stay away, up to what the nodes resolve
    nodes = np.array(nodes)
    step = np.pi / max(np.sqrt(2.0) * float(nodes.max()), float(cells[-1]))
    last = np.pi / (2.0 * float(nodes[:, 0].max()))
    k = step * (np.arange(int(last / step)) + 0.5)
    size = np.sqrt(k[:, None] ** 2 + k**2)
    weights = _characteristic(nodes, psi**2, k)
    weights *= 4.0 * (k[1] - k[0]) * (k[1] - k[0]) / (2.0 * np.pi * size)
    below = np.array([r * np.sum(weights * j1(size * r)) for r in cells])
    return np.diff(below) / np.diff(cells)


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

HIGHEST_MODULUS, CELLS, BOUNDS = 12.0, 80, 60
"""The end and the cells of a density, and the values of the bound whose law is solved."""


def solve_thermal(
    epsilon: float, gamma: float, omegas: list[float], bulk_omega: float, nodes: int,
    density_nodes: int,
) -> Contents:  # fmt: skip
    """Return the states without energy at all `omegas`, of both fields and of A = -B.

    Where one has no such state it is left out. The law of the largest modulus is that of the state
    whose Omega is nearest to `bulk_omega`.
    """
    both, alone = [], []
    for omega in omegas:
        constants = Constants(epsilon=epsilon, gamma=gamma, omega=omega)
        try:
            states = [state_of_energy(constants, 0.0, nodes, alike) for alike in (False, True)]
        except NoStateError as error:
            print(f"left out: {error}")
            continue
        both.append(states[0])
        alone.append(states[1])
    nearest = min(both, key=lambda one: abs(one.operator.constants.omega - bulk_omega))
    title = "Thermal states of the infinite chain, by its transfer operator"
    attributes = {
        "title": title, "epsilon": epsilon, "gamma": gamma, "nodes": 2 * nodes,
        "density_nodes": 2 * density_nodes,
    }  # fmt: skip
    return thermal_variables(both, alone, density_nodes) | maximum_variables(nearest), attributes


def thermal_variables(
    both: list[ThermalState], alone: list[ThermalState], density_nodes: int
) -> dict[str, Variable]:
    """Return the states of zero energy, one for each Omega, of both fields and of A = -B.

    `density_nodes` are the half-nodes a coordinate from which densities are summed.
    """
    omegas = [one.operator.constants.omega for one in both]
    cells = np.linspace(0.0, HIGHEST_MODULUS, CELLS + 1)
    waves = 2.0 * np.pi * np.arange(LAGS) / LAGS
    # of 0 and -0 processors take either for the larger one, and a sum with zero has no sign
    densities = [
        np.maximum(0.0, density_of(one, cells, density_nodes).round(DECIMALS)) + 0.0 for one in both
    ]
    spectra = rounded(np.array([spectrum_of(products_of(one, LAGS)) for one in both]), DIGITS - 1)
    return {
        "omega": Variable(("omega",), omegas),
        **_means(both, "", "in the thermal state of no energy"),
        **_means(alone, "antisymmetric_", "in that of the chain with A = -B"),
        "wave_number": Variable(("wave",), waves, "wave number k", "rad"),
        "spectrum": Variable(
            ("omega", "wave"), spectra, "mean |A(k)|^2 over pieces of the chain",
            attributes={"significant_digits": DIGITS - 1},
        ),
        "modulus": Variable(("modulus",), 0.5 * (cells[1:] + cells[:-1])),
        "density": Variable(
            ("omega", "modulus"), densities, "probability density of the modulus",
            attributes={"decimal_places": DECIMALS},
        ),
    }  # fmt: skip


def _means(states: list[ThermalState], prefix: str, words: str) -> dict[str, Variable]:
    of_error = f"error of the discretisation and rounding of that {POWER}"
    named = {
        "power": (DIGITS, f"{POWER} {words}"),
        "power_error": (2, of_error),
    }
    return {
        f"{prefix}{name}": Variable(
            ("omega",),
            rounded(np.array([getattr(one, name) for one in states]), digits),
            long_name,
            attributes={"significant_digits": digits},
        )
        for name, (digits, long_name) in named.items()
    }


def maximum_variables(state: ThermalState) -> dict[str, Variable]:
    """Return the law of the largest modulus in a thermal state, at BOUNDS values of m.

    The last of them is a bound on one modulus: at a given power that of one amplitude alone has
    twice the quartic energy of `widest`, so that it ends at a 2^(1/4) of that reach.
    """
    constants = state.operator.constants
    reach = float(transfer.widest(constants, state.beta)[0]) / np.sqrt(np.sqrt(2.0))
    bounds = reach * np.arange(1, BOUNDS + 1) / BOUNDS
    rates, overlaps = law_of_maxima(constants, state.beta, bounds)
    chance = "the chance c exp(-r (N - 1)) that no modulus on N neighbouring sites is above it"
    found = {
        "bound": (bounds, "bound on the moduli |A_n| and |B_n|"),
        "bound_rate": (rates, f"r in {chance}"),
        "bound_overlap": (overlaps, f"c in {chance}"),
    }
    said = {"decimal_places": PLACES}
    variables = {
        name: Variable(("bound",), values.round(PLACES) + 0.0, long_name, attributes=said)
        for name, (values, long_name) in found.items()
    }
    at = Variable((), constants.omega, "detuning Omega of this thermal state")
    return {**variables, "bound_omega": at}
