"""Crank-Nicolson, solved by fixed-point iteration: the paper's second solver, and a variant of it.

`build` is the trapezoidal rule, new = old + h/2 (F(old) + F(new)): Crank and Nicolson (Proc. Camb.
Phil. Soc. 43 (1947) 50) average the right-hand side over the two ends of a step. It does not keep
the quartic energy (8).

`build_conserving` is the variant that conserves the energy up to the tolerance of the iteration:
new = old + h G(old, new), where G is the mean right-hand side of Delfour, Fortin and Payre
(J. Comput. Phys. 44 (1981) 277). It shows what of the second solver's difference to the first is
the drift of its energy, and what is the error of its phase.

Both are of second order and symmetric in time.
"""
# ASSUME: the paper says "a Crank-Nicholson scheme with the fixed-point iteration method" and no
# more. It is read as the trapezoidal rule, the scheme of Crank and Nicolson's own paper.

from latticode.kernels.compiled import uncached

from . import fixed_point
from .fixed_point import WORK as WORK


@uncached
def advance(old, h, slope, new):
    """Set new = old + h slope, ghosts left alone."""
    for row in range(old.shape[0]):
        for j in range(1, old.shape[1] - 1):
            new[row, j] = old[row, j] + h * slope[row, j]


@uncached
def reflect(old, base):
    """Set base = 2 old - base, ghosts left alone."""
    for row in range(old.shape[0]):
        for j in range(1, old.shape[1] - 1):
            base[row, j] = 2.0 * old[row, j] - base[row, j]


def build(rates, observe):
    """Return the solver of y' = rates by the trapezoidal rule; see the package."""

    @uncached
    def begin(system, old, h, follows, base):
        """Half a step of the explicit Euler method; half a step of the implicit one remains.

        The step before ended where old = base + h/2 F(old) for its own base, so that the new one,
        old + h/2 F(old), needs no right-hand side.
        """
        if follows:
            reflect(old, base)
            return base, 0.5 * h, 0
        rates(system, old, base)
        advance(old, 0.5 * h, base, base)
        return base, 0.5 * h, 1

    @uncached
    def slope(system, old, new, scratch, dy):
        rates(system, new, dy)

    return fixed_point.build(begin, slope, observe)


def build_conserving(mean_rates, observe):
    """Return the solver of y' = rates by the scheme of Delfour, Fortin and Payre.

    `mean_rates(system, old, new, middle, dy)` writes the mean of the rates over a step into `dy`,
    and may use `middle` as it likes.
    """

    @uncached
    def begin(system, old, h, follows, scratch):
        return old, h, 0

    return fixed_point.build(begin, mean_rates, observe)
