"""An initial-value problem together with the equations that integrate it."""

from functools import cached_property
from typing import TYPE_CHECKING

from latticode.equations.initial_values import InitialValueProblem

if TYPE_CHECKING:
    from .equations import Equations


class Problem(InitialValueProblem):
    """One initial-value problem of a traced model.

    A program with specialised kernels defines a subclass with other `equations`.
    """

    @cached_property
    def equations(self) -> "Equations":
        """The equations that integrate the problem and name its results; nothing is compiled."""
        # imported here, because configurations create problems without kernels
        from .traced import TracedEquations

        return TracedEquations(self)
