"""Growth of a small A + B: beside SciPy on plain NumPy, and from exponents made up by hand."""

import numpy as np
import pytest
from pendula.studies.unbounded import transverse
from pendula.studies.unbounded.front import linear_front
from problems import problem_of
from scipy.integrate import solve_ivp

TIGHT = {"name": "dop853", "rtol": 1e-12, "atol": 1e-12}
END, SITES = 16.0, 90
PROBLEM = problem_of(
    "fig4_small", half_width=None, end_time=END, output_step=2.0, omega=2.0, solver=TIGHT
)


def linear_rates(_, state):
    """Return the rates of D, on the chain with A = -B, and of S, to first order, on both halves."""
    d, s = state.view(complex).reshape(2, -1)
    epsilon, gamma, omega = PROBLEM.constants

    def coupled(z):
        return epsilon * (np.roll(z, 1) + np.roll(z, -1) - 2.0 * z) + omega * z

    power = 0.25 * np.abs(d) ** 2
    of_d = coupled(d) - 2.0 * gamma * d.conj() + power * d
    of_s = coupled(s) + power * s + 0.5 * (s * d.conj()).real * d
    return (-1j * np.concatenate([of_d, of_s])).view(float)


def test_exponents_are_those_of_the_linear_equation_by_another_solver():
    """The linear equation is integrated as it is, on a ring that the motion does not fill."""
    start = np.zeros((2, 2 * SITES + 1), complex)
    start[:, SITES] = (PROBLEM.initial[0, 0] - PROBLEM.initial[1, 0]) / np.sqrt(2.0)
    times = np.arange(0.0, END + 1.0, 2.0)
    controls = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-14, "t_eval": times}
    flat = start.ravel().view(float)
    states = solve_ivp(linear_rates, (0.0, END), flat, **controls).y.T.copy()
    s = states.view(complex).reshape(len(times), 2, -1)[:, 1, SITES:]
    sizes = np.maximum(np.abs(s.real), np.abs(s.imag))
    speed, late = linear_front(PROBLEM.constants).speed, times > 0.5 * END
    expected = []
    for velocity in transverse.velocities():
        places = (velocity * speed * times).astype(int)
        near = transverse.NEAR[0]
        largest = [sizes[n, max(0, at - near) : at + near + 1].max() for n, at in enumerate(places)]
        expected.append(np.polyfit(times[late], np.log(largest)[late], 1)[0])
    shape = (len(transverse.SHORTER), len(transverse.LATE), len(transverse.NEAR), -1)
    computed = transverse.exponents_of(PROBLEM, 1e-150)["exponents"].reshape(shape)
    np.testing.assert_allclose(computed[0, 0, 0], expected, atol=2e-3)
    assert max(expected) > 0.2 > 0.0 > min(expected)


def line(zero: float) -> np.ndarray:
    """Return exponents that fall in proportion to the velocity, and vanish at a part of v_1."""
    return 1.0 - transverse.velocities() / zero


def test_the_second_front_moves_where_the_exponent_vanishes():
    assert transverse.crossing_of(line(0.7)) == pytest.approx(0.7, abs=1e-12)
    assert transverse.crossing_of(-line(0.7) - 1.0) == 0.0
    assert transverse.crossing_of(line(2.0)) == 1.0
    lost = np.where(line(0.7) > -0.2, line(0.7), np.nan)  # far behind, |S| leaves the range
    assert transverse.crossing_of(lost) == pytest.approx(0.7, abs=1e-12)


def test_growth_behind_the_front_is_the_steepest_line_from_it():
    """If lambda = 1 - v / c with c < 1, the largest lambda / (1 - v) is that at v = 0."""
    assert transverse.largest_ratio(line(0.7)) == pytest.approx(1.0, abs=1e-12)
    bell = 0.1 - (transverse.velocities() - 0.5) ** 2
    assert transverse.largest_ratio(bell) == pytest.approx(1.0 - 2.0 * np.sqrt(0.15), rel=1e-3)


def test_no_second_front_is_predicted_where_nothing_grows():
    problems = [PROBLEM, PROBLEM]
    exponents = np.array([[line(0.5)] * 3, [1e-3 * line(0.5)] * 3])
    numbers = transverse.numbers_of(problems, exponents, np.array([0.01, 0.01]))
    speed, _ = numbers["predicted_second_speed"]
    assert speed[0] == pytest.approx(0.5 * linear_front(PROBLEM.constants).speed)
    assert np.isnan(speed[1])
