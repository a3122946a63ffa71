"""Newton's equations (1) as a model: against plain NumPy, Mathieu's equation, and symmetries."""

import numpy as np
import pytest
from flint import arb, ctx
from latticode.equations.ends import DIRICHLET
from on_pendula import TIGHT, final, pendula, slope, start, undriven_energy
from pendula.models.pendula import at_time, make_pendula
from scipy.integrate import solve_ivp

BOUNDARIES = ("dirichlet", "free", "periodic")


@pytest.mark.parametrize("t", [0.0, 3.7, 1234.5, 98765.4321, 1.28e6 + 1 / 3])
def test_the_phase_of_the_drive_is_as_exact_late_as_early(t):
    problem = pendula(mu=0.3, omega=8.0)
    driven = at_time(make_pendula(problem.constants, 0.3, (DIRICHLET, DIRICHLET)), t)
    with ctx.workprec(200):
        phase = 2 * (1 + 8 * arb(0.3) ** 2).sqrt() * arb(t)
        cosine, sine = float(phase.cos()), float(phase.sin())
    assert abs(driven.drive / driven.clock.strength - cosine) < 5e-16
    assert abs(driven.quadrature / driven.clock.strength - sine) < 5e-16


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_every_solver_agrees_with_plain_numpy(boundary):
    problem = pendula(boundary=boundary, mu=0.3, end_time=1.0)
    end = 2 * problem.end_time / problem.mu**2
    exact = solve_ivp(
        slope(problem), (0, end), start(problem).ravel(), "DOP853", rtol=1e-13, atol=1e-14
    )
    for solver in TIGHT:
        computed = final(problem, solver).ravel()
        np.testing.assert_allclose(computed, exact.y[:, -1], rtol=0, atol=2e-11, err_msg=solver)


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_pendula_that_are_not_driven_keep_their_energy(boundary):
    symmetric = {0: (2.0, 2.0), 1: (1j, 1j)}
    for changes in ({"initial": symmetric}, {"gamma": 0.0}):
        problem = pendula(boundary=boundary, mu=0.3, end_time=20.0, **changes)
        energies = [undriven_energy(problem, *state) for state in (start(problem), final(problem))]
        assert abs(energies[1] / energies[0] - 1) < 1e-13
    driven = pendula(boundary=boundary, mu=0.3, end_time=20.0)
    energies = [undriven_energy(driven, *state) for state in (start(driven), final(driven))]
    assert abs(energies[1] / energies[0] - 1) > 1e-2


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"mu": None}, "require a positive mu"),
        ({"mu": -0.1}, "require a positive mu"),
        ({"mu": 0.5, "omega": -4.0}, "must be positive"),
        ({"model": "amplitudes"}, "mu requires model: pendula"),
        ({"model": "springs"}, "unknown model 'springs'"),
    ],
)
def test_what_has_no_meaning_is_refused(changes, message):
    with pytest.raises(ValueError, match=message):
        pendula(**changes)
