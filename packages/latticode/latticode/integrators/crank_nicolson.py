"""Crank-Nicolson schemes solved by fixed-point iteration: the trapezoidal rule, and a variant.

`build` is the trapezoidal rule, new = old + h/2 (F(old) + F(new)), by Crank and Nicolson (Proc.
Camb. Phil. Soc. 43 (1947) 50). It does not conserve the quartic energy (8).

`build_conserving` conserves the energy up to the tolerance of the iteration:
new = old + h G(old, new), where G is the mean right-hand side of Delfour, Fortin and Payre
(J. Comput. Phys. 44 (1981) 277). A comparison of both schemes separates the effects of energy drift
and phase error.

Both are of second order and symmetric in time.
"""
# ASSUME: the paper only writes "a Crank-Nicholson scheme with the fixed-point iteration method". We
# take the trapezoidal rule, the scheme of the paper by Crank and Nicolson.

from collections.abc import Callable
from typing import Any

import numpy as np

from latticode.kernels.compiled import uncached

from . import fixed_point
from .fixed_point import WORK as WORK

Array = np.ndarray


@uncached
def advance(old: Array, h: float, slope: Array, new: Array) -> None:
    """Set new = old + h slope, except in the ghost columns."""
    for row in range(old.shape[0]):
        for j in range(1, old.shape[1] - 1):
            new[row, j] = old[row, j] + h * slope[row, j]


@uncached
def reflect(old: Array, base: Array) -> None:
    """Set base = 2 old - base, except in the ghost columns."""
    for row in range(old.shape[0]):
        for j in range(1, old.shape[1] - 1):
            base[row, j] = 2.0 * old[row, j] - base[row, j]


def build(rates: Callable, observe: Callable) -> Callable:
    """Return the trapezoidal solver of y' = rates; the package describes its arguments."""

    @uncached
    def begin(system: Any, old: Array, h: float, follows: bool, base: Array) -> tuple:
        """Return base = old + h/2 F(old), the factor h/2, and the number of evaluations.

        After a step of the same length, the previous base satisfies old = base + h/2 F(old). The
        new base is then 2 old - base, without an evaluation.
        """
        if follows:
            reflect(old, base)
            return base, 0.5 * h, 0
        rates(system, old, base)
        advance(old, 0.5 * h, base, base)
        return base, 0.5 * h, 1

    @uncached
    def slope(system: Any, old: Array, new: Array, scratch: Array, dy: Array) -> None:
        rates(system, new, dy)

    return fixed_point.build(begin, slope, observe)


def build_conserving(mean_rates: Callable, observe: Callable) -> Callable:
    """Return the solver of y' = rates by the scheme of Delfour, Fortin and Payre.

    `mean_rates(system, old, new, middle, dy)` writes the mean of the rates over a step into `dy`;
    `middle` is scratch memory.
    """

    @uncached
    def begin(system: Any, old: Array, h: float, follows: bool, scratch: Array) -> tuple:
        return old, h, 0

    return fixed_point.build(begin, mean_rates, observe)
