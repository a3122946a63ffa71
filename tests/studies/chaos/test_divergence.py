"""Divergence times: growth known in closed form, and a chaotic case followed."""

import numpy as np
import pytest
from pendula.studies.chaos import lyapunov
from pendula.studies.chaos.lyapunov import follow_parity
from problems import problem_of

TAU = np.linspace(0.0, 20.0, 2001)


def test_errors_made_all_along_grow_to_their_integral():
    rate = 1.5
    log = lyapunov.amplification(TAU, rate * TAU, np.ones_like(TAU))
    np.testing.assert_allclose(log[10:], np.log(np.expm1(rate * TAU[10:]) / rate), atol=0.02)


def test_a_solution_that_grows_like_its_errors_keeps_their_relative_size():
    log = lyapunov.amplification(TAU, 1.5 * TAU, np.exp(1.5 * TAU))
    np.testing.assert_allclose(log[1:], np.log(TAU[1:]), atol=1e-9)


def test_a_thousandth_of_the_error_diverges_later_by_its_logarithm_over_the_rate():
    log = lyapunov.amplification(TAU, 2.0 * TAU, np.ones_like(TAU))
    early, late = (lyapunov.predict(TAU, log, error) for error in (1e-6, 1e-9))
    assert late - early == pytest.approx(np.log(1e3) / 2.0, abs=0.02)


def test_what_never_grows_never_diverges():
    log = lyapunov.amplification(TAU, np.zeros_like(TAU), np.ones_like(TAU))
    assert lyapunov.predict(TAU, log, 1e-6) == np.inf


def test_a_chaotic_run_diverges_when_predicted():
    problem = problem_of("fig4_small", half_width=15, end_time=16.0, output_step=0.125)
    growth = follow_parity(problem, "even", 16.0)
    log = lyapunov.amplification(growth.tau, growth.log_growth[0], growth.size)
    found = lyapunov.measure_divergence(problem, [1e-6])
    made = found.early[0] / np.exp(log[lyapunov.early_index(growth.tau)])
    assert found.time[0] == pytest.approx(lyapunov.predict(growth.tau, log, made), abs=3.0)
