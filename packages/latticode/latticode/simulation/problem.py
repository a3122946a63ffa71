"""An initial-value problem together with the equations that integrate it."""

from functools import cached_property

from latticode.equations.initial_values import InitialValueProblem


class Problem(InitialValueProblem):
    """One initial-value problem of a traced model.

    A program with specialised kernels defines a subclass with other `equations`.
    """

    @cached_property
    def equations(self):
        """The `Equations` that integrate the problem and name its results; nothing is compiled."""
        from .traced import (
            TracedEquations,
        )  # imported here: configurations make problems without kernels

        return TracedEquations(self)
