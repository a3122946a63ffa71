"""Equations evaluated on polynomials over the rationals (python-flint), to prove identities.

The fields of a chain of SITES pairs and the constants are indeterminates. Only neighbours are
coupled, so a chain of three sites represents any longer one: it has two ends and a site between
them. States are arrays of polynomials, (component, Re or Im, site).
"""

from collections.abc import Iterable
from fractions import Fraction
from typing import Any

import numpy as np
from flint import fmpq, fmpq_mpoly, fmpq_mpoly_ctx
from latticode.equations.ends import DIRICHLET, FREE, PERIODIC, kind_of, neighbours
from latticode.equations.graph import Node, evaluate
from latticode.equations.model import Model

from pendula.models.equations import AMPLITUDE_MODEL

SITES = 3
CONSTANTS = ("epsilon", "gamma", "omega")
FURTHER_SYMBOLS = ("mu", "cosine", "sine", "kappa")
"""Indeterminates of some identities: mu of (2), cos and sin of omega t, and kappa of (14)."""
ROWS = tuple(
    f"{re_im} {field}{n}" for field in "ABab" for re_im in ("Re", "Im") for n in range(SITES)
)
CONTEXT = fmpq_mpoly_ctx.get((*CONSTANTS, *FURTHER_SYMBOLS, *ROWS), "degrevlex")
GENS = CONTEXT.gens()
EPSILON, GAMMA, OMEGA, MU, COSINE, SINE, KAPPA = GENS[:7]
ZERO = 0 * GAMMA

Residual = fmpq_mpoly | np.ndarray | list
"""One or more polynomials that vanish if a statement holds."""


def object_array(values: Iterable, shape: tuple[int, ...] = (2, 2, SITES)) -> np.ndarray:
    """Return an array of polynomials; `np.array` would read each as a sequence of terms."""
    array = np.empty(shape, object)
    for at, value in zip(np.ndindex(*shape), values, strict=True):
        array[at] = value
    return array


STATE, PERTURBATION = object_array(GENS[7:19]), object_array(GENS[19:])
"""A state, and the difference of another solution from it."""


def scaled(by: Any, values: np.ndarray) -> np.ndarray:
    """Return an array times a number or polynomial; NumPy would read the latter as a sequence."""
    return np.frompyfunc(lambda value: by * value, 1, 1)(values)


def rational(x: float) -> fmpq:
    """Return a double as an exact fraction."""
    exact = Fraction(x)
    return fmpq(exact.numerator, exact.denominator)


def rates(
    ends: str,
    state: np.ndarray = STATE,
    model: Model = AMPLITUDE_MODEL,
    functions: Any = None,
    **constants: Any,
) -> np.ndarray:
    """Return the rates of a state, of the same shape; `constants` replace their indeterminates.

    If the model has a sine, `functions` must have a `sin` for polynomials.
    """
    values = {"epsilon": EPSILON, "gamma": GAMMA, "omega": OMEGA} | constants
    shape, (right, left) = state.shape, neighbours(state, ends)
    seen = {0: state, 1: right, -1: left}

    def leaf(node: Node) -> Any:
        if node.operation == "number":
            return rational(node.operands[0])
        if node.operation in ("parameter", "clock"):
            return object_array([values[node.operands[0]]] * shape[-1], shape[-1:])
        component, re_im, by = node.operands
        return seen[by][component, re_im]

    rows = evaluate(model.rates, leaf, functions)
    return object_array((rate for row in rows for rate in row), shape)


def linear_rates(ends: str, state: np.ndarray = STATE, at: np.ndarray | None = None) -> np.ndarray:
    """Return the derivative of the rates of (4) along `state`, at zero or at the state `at`."""
    both = np.concatenate([0 * state if at is None else at, state])
    return rates(ends, both, AMPLITUDE_MODEL.tangent())[len(state) :]


def joined(ends: str, state: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the sites (..., bond) to the right and to the left of each bond of a chain.

    A Dirichlet end has a bond to a site at rest, and a free end has none.
    """
    none, at_rest = state[..., :0], 0 * state[..., :1]
    beyond = {DIRICHLET: (at_rest, at_rest), FREE: (none, none), PERIODIC: (state[..., -1:], none)}
    first, last = beyond[kind_of(ends)]
    padded = np.concatenate([first, state, last], axis=-1)
    return padded[..., 1:], padded[..., :-1]


def energy(ends: str, state: np.ndarray = STATE, omega: fmpq_mpoly = OMEGA) -> fmpq_mpoly:
    """Return H of (8) as a polynomial."""
    squares = densities(state)
    return (
        fmpq(1, 4) * (squares**2).sum()
        + omega * squares.sum()
        - EPSILON * bonds(ends, state)
        - GAMMA * drive(state)
    )


def densities(state: np.ndarray = STATE) -> np.ndarray:
    """Return |A_n|^2 and |B_n|^2, (component, site)."""
    return (state**2).sum(axis=1)


def bonds(ends: str, state: np.ndarray = STATE) -> fmpq_mpoly:
    """Return the sum of |A_{n+1} - A_n|^2 + |B_{n+1} - B_n|^2 over the bonds of a chain."""
    right, left = joined(ends, state)
    return ((right - left) ** 2).sum()


def drive(state: np.ndarray = STATE) -> fmpq_mpoly:
    """Return the real part of the sum of (A_n - B_n)^2; -H contains it times gamma."""
    x, y = state[0] - state[1]
    return (x**2 - y**2).sum()


def gradient(of: fmpq_mpoly) -> np.ndarray:
    """Return the derivatives of a polynomial with respect to the entries of STATE."""
    return object_array(of.derivative(GENS.index(symbol)) for symbol in STATE.ravel())


def times(re: Any, im: Any, state: np.ndarray) -> np.ndarray:
    """Return a state times the complex number re + i im."""
    return np.stack([re * state[:, 0] - im * state[:, 1], re * state[:, 1] + im * state[:, 0]], 1)


def conjugate(state: np.ndarray) -> np.ndarray:
    """Return the complex conjugate of a state."""
    return state * np.array([1, -1], object)[:, None]


def put(polynomial: fmpq_mpoly, state: np.ndarray) -> fmpq_mpoly:
    """Return a polynomial with `state` in place of STATE."""
    return polynomial.compose(*GENS[:7], *state.ravel(), *GENS[19:])


def terms_left(polynomial: Residual) -> int:
    """Return the number of terms of a polynomial, array or list: 0 if it vanishes."""
    if isinstance(polynomial, np.ndarray | list):
        return sum(map(terms_left, polynomial))
    return len(polynomial)
