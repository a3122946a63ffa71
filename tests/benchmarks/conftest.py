"""Contestants whose times and errors are known."""

import numpy as np
import pytest
from pendula.problem import Constants, Problem

from benchmarks.contestants import Contestant

EXACT = np.ones((2, 3), complex)


@pytest.fixture
def exact():
    return EXACT


@pytest.fixture
def problem():
    return Problem(
        constants=Constants(epsilon=1.0, gamma=1.0, omega=8.0),
        half_width=1,
        boundary="dirichlet",
        initial=EXACT,
        end_time=1.0,
        output_step=1.0,
        solver={"name": "taylor", "rtol": 1e-12, "atol": 1e-12},
    )


@pytest.fixture
def contestant():
    """Return a maker of contestants that err by what is asked for, in the seconds given by it."""

    def make(seconds, accuracies=(1e-4, 1e-6, 1e-8, 1e-10, 1e-12), faults=(), blanks=()):
        calls = []

        def solve(accuracy):
            calls.append(accuracy)
            if accuracy in faults:
                raise RuntimeError("gave up")
            final = EXACT + (np.nan if accuracy in blanks else accuracy)
            return final, seconds(accuracy)

        made = Contestant("made up", np.array(accuracies), lambda problem: solve)
        return made, calls

    return make
