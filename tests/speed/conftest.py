"""Contestants whose times and errors are known."""

import numpy as np
import pytest
from pendula.simulation.lattice import Reduction
from pendula.speed.contestants import Contestant
from pendula.speed.tasks import Task

EXACT = np.ones((2, 3), complex)


@pytest.fixture
def task():
    reduction = Reduction(even=False, synchronised=False)
    return Task("fig2_small", (1.0, 1.0, 8.0), "dirichlet", EXACT, reduction, 1.0, EXACT)


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

        made = Contestant("made up", np.array(accuracies), lambda task: solve)
        return made, calls

    return make
