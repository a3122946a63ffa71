"""Fixtures of several tests, and how hypothesis draws: the same data every time, no time limit."""

from functools import cache

import numpy as np
import pytest
from hypothesis import settings
from oracle import CASES, slope
from scipy.integrate import solve_ivp

settings.register_profile("project", deadline=None, derandomize=True, database=None)
settings.load_profile("project")


@pytest.fixture(scope="session")
def scipy_solution():
    """Return a function: the amplitudes (2, 61) of a case of the paper at some tau, by SciPy."""

    @cache
    def solve(case, tau):
        omega, pair = CASES[case]
        start = np.zeros((2, 61), complex)
        start[:, 30] = pair

        def right_hand_side(_, z):
            return slope(z.reshape(2, 61), (1.0, 1.0, omega), "dirichlet").ravel()

        run = solve_ivp(
            right_hand_side, (0, tau), start.ravel(), method="DOP853", rtol=3e-14, atol=1e-14
        )
        return run.y[:, -1].reshape(2, 61)

    return solve
