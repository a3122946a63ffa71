"""The variant of Crank-Nicolson that conserves the energy, solved by fixed-point iteration.

new = old + h G(old, new), where G is the mean right-hand side of Delfour, Fortin and Payre
(J. Comput. Phys. 44 (1981) 277): second order, symmetric in time, and the energy is conserved up
to the tolerance of the iteration. It shows what of the second solver's difference to the first is
the drift of its energy, and what is the error of its phase.
"""

from pendula.compiled import uncached

from . import fixed_point
from .fixed_point import WORK as WORK


def build(mean_rates, observe):
    """Return the solver of y' = rates, given their mean over a step; see the package.

    `mean_rates(system, old, new, middle, dy)` may use `middle` as it likes.
    """

    @uncached
    def begin(system, old, h, follows, scratch):
        return old, h, 0

    return fixed_point.build(begin, mean_rates, observe)
