"""The unknowns S and D: the same equations, and a second front that rounding errors do not seed."""

import numpy as np
import pytest
from oracle import random_chain
from pendula.models.amplitudes import EQUATIONS
from pendula.simulation.own_models import linearise
from pendula.studies.unbounded.active_sites import advance, begin, find_front, right_half, widen
from pendula.studies.unbounded.bulk import site_powers
from pendula.studies.unbounded.sums import in_sums, turned
from problems import problem_of
from scipy.integrate import solve_ivp

SOLVER = {"name": "dop853", "rtol": 1e-6, "atol": 1e-6}


def test_the_rates_are_those_of_the_equations_for_a_and_b():
    problem = problem_of("fig4_small", half_width=6, omega=0.7, gamma=0.6, epsilon=1.3)
    z = random_chain(6)
    own = in_sums(problem.changed(initial=z))
    plain = own.changed(model=EQUATIONS, initial=z)

    def rates(one):
        a, b = one.initial
        state = np.array([a.real, a.imag, b.real, b.imag]).ravel()
        return linearise(one, state)[0].reshape(4, -1)

    np.testing.assert_allclose(turned(rates(own)), rates(plain), atol=1e-12)
    np.testing.assert_allclose(turned(own.initial), z, rtol=1e-14)


def places(problem, piece=2.0):
    """Return where |A + B|^2 / 2 ends on the infinite chain, after each piece of a run."""
    state, rooms, found = begin(problem.initial), {}, []
    for i in range(round(problem.end_time / piece)):
        state = widen(state, None, 1e-20)
        advance(problem, state, piece * np.array([i, i + 0.5, i + 1]), rooms)
        sites = right_half(state, True)
        sums = sites[:2] if problem.model is not EQUATIONS else turned(sites)[:2]
        found.append(find_front(site_powers(sums)))
    return np.array(found)


def test_in_a_and_b_rounding_errors_seed_the_second_front():
    """At Omega = 1 they make it follow the first one, whose speed is 3.0, some time behind."""
    problem = problem_of("fig4_small", half_width=None, omega=1.0, end_time=240.0, solver=SOLVER)
    own = in_sums(problem)
    fronts = [places(own), places(own.changed(model=EQUATIONS, initial=problem.initial))]
    kept, seeded = ((front[-1] - front[len(front) // 2]) / 120.0 for front in fronts)
    assert kept < 2.5 < 2.7 < seeded
    assert abs(fronts[0][10] - fronts[1][10]) < 10.0  # before any of them has grown


@pytest.mark.parametrize("omega", [0.0, 3.0])
def test_the_second_front_is_where_another_solver_has_it(omega):
    """SciPy, which integrates S and D as they stand in the literature of waves, on half a chain."""
    problem = problem_of("fig4_small", half_width=None, omega=omega, end_time=12.0, solver=SOLVER)
    tight = in_sums(problem.changed(solver={"name": "dop853", "rtol": 1e-12, "atol": 1e-14}))
    found, count = places(tight), 100

    def rate(_, y):
        s, d = y[:count], y[count:]

        def lap(u):
            wide = np.concatenate([u[1:2], u, [0.0]])
            return wide[2:] - 2.0 * u + wide[:-2]

        both, product = np.abs(s) ** 2 + np.abs(d) ** 2, s * d.conj()
        of_s = lap(s) + omega * s + 0.25 * both * s + 0.25 * (product + product.conj()) * d
        of_d = lap(d) + omega * d + 0.25 * both * d + 0.25 * (product + product.conj()) * s
        return -1j * np.concatenate([of_s, of_d - 2.0 * d.conj()])

    start = np.zeros(2 * count, complex)
    start[[0, count]] = tight.initial[:, tight.initial.shape[1] // 2]
    end = solve_ivp(rate, (0.0, 12.0), start, "DOP853", rtol=1e-12, atol=1e-14).y[:, -1]
    assert find_front(np.abs(end[:count]) ** 2) == pytest.approx(found[-1], abs=0.01)
