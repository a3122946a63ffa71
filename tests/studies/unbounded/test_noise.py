"""Noise in A + B: without it the fronts are those of other runs, with more the second is nearer."""

import numpy as np
from pendula.studies.unbounded.active_sites import run_long
from pendula.studies.unbounded.noise import LEVELS, ROUNDING, places_of
from problems import problem_of

FAST = {"name": "dop853", "rtol": 1e-8, "atol": 1e-8}
REST_THRESHOLD = 1e-150


def chain(end_time: float):
    times = {"end_time": end_time, "output_step": 2.0}
    return problem_of("fig4_small", half_width=None, omega=2.0, solver=FAST, **times)


def test_without_noise_the_fronts_are_those_of_long_runs():
    tau, fronts, seconds = places_of(chain(40.0), 0.0, REST_THRESHOLD, 1)
    run = run_long(chain(40.0), REST_THRESHOLD, levels=LEVELS)
    np.testing.assert_array_equal(tau, run["piece_tau"])
    np.testing.assert_array_equal(fronts, run["front"])
    np.testing.assert_array_equal(seconds, run["second_front"])


def test_the_more_noise_the_nearer_is_the_second_front():
    """At Omega = 2 the fronts without noise are apart by one site per unit of tau."""
    distances = {}
    for noise in (0.0, 1e-16, 1e-4, ROUNDING):
        tau, fronts, seconds = places_of(chain(160.0), noise, REST_THRESHOLD, 1)
        distances[noise] = (fronts - seconds[:, 0])[tau > 120.0].mean()
    assert distances[1e-4] < 0.5 * distances[1e-16] < 0.5 * distances[0.0]
    assert abs(distances[ROUNDING] - distances[1e-16]) < 0.5 * distances[1e-16]
