"""A problem that knows how it is integrated: the values of `initial_values`, and its equations."""

from functools import cached_property

from latticode.equations.initial_values import InitialValueProblem


class Problem(InitialValueProblem):
    """One initial-value problem, integrated by what follows from the trace of its model.

    A program whose kernels know more than the trace has a subclass with other `equations`.
    """

    @cached_property
    def equations(self):
        """The `Equations` that integrate the problem and name its results; nothing is compiled."""
        from .traced import TracedEquations  # here: a configuration makes problems without kernels

        return TracedEquations(self)
