"""Thresholds of the pendula: SciPy's Mathieu functions, multipliers, and runs."""

import numpy as np
import pytest
from latticode.simulation.simulate import simulate
from pendula.configuration.paper import paper
from pendula.problem import Constants, PaperProblem
from pendula.studies.newton import mathieu, threshold
from scipy.integrate import solve_ivp
from scipy.special import mathieu_a, mathieu_b


def test_tongues_are_those_of_scipy():
    """Where b_1 or a_1 is 1 + offset."""
    for curve, offset in ((mathieu_b, [-0.9, -0.5, -0.1, -1e-3]), (mathieu_a, [1e-3, 0.1, 0.5, 1])):
        computed = curve(1, mathieu.first_tongue(offset))
        np.testing.assert_allclose(computed, 1.0 + np.array(offset), rtol=0, atol=2e-15)


def test_only_a_drive_that_beats_the_strings_loses_pendula():
    """By Mathieu's equation: a <= 4 epsilon mu^2 / omega^2 is stable up to q = b_1(a)."""
    of_paper = [Constants.of(constants) for constants in paper()["cases"].values()]
    assert not any(
        mathieu.waves_on_strings_grow(constants, mu)
        for constants in of_paper
        for mu in (0.05, 0.15, 0.3)
    )
    constants_of_fig3 = {"epsilon": 1.0, "gamma": 1.0, "omega": -4.0}
    for changes in ({"gamma": 3.0}, {"epsilon": 2.0}, {"epsilon": -0.1, "gamma": 0.0}):
        assert mathieu.waves_on_strings_grow(Constants(**constants_of_fig3 | changes), 0.3)
    free = Constants(epsilon=0.0, gamma=1.0, omega=0.0)
    assert not mathieu.waves_on_strings_grow(
        free, np.sqrt(0.9 / 2.0)
    ) and mathieu.waves_on_strings_grow(free, np.sqrt(0.91 / 2.0))


# --- The thresholds of the chain ------------------------------------------------------------------


def multiplier(omega, mu, gamma, curvature, epsilon=1.0):
    """Return the largest multiplier over a period of the drive, by the linearised equation (1)."""
    frequency = np.sqrt(1.0 + mu * mu * omega)

    def rates(t, z):
        drive = 2.0 * gamma * mu * mu * np.cos(2.0 * frequency * t)
        return [z[1], -(1.0 + epsilon * mu * mu * curvature + 2.0 * drive) * z[0]]

    runs = [
        solve_ivp(rates, (0.0, np.pi / frequency), start, "DOP853", rtol=1e-13, atol=1e-14).y[:, -1]
        for start in ([1.0, 0.0], [0.0, 1.0])
    ]
    return abs(np.linalg.eigvals(np.transpose(runs))).max()


@pytest.mark.parametrize("mu", [0.05, 0.2])
@pytest.mark.parametrize(("omega", "curvature"), [(-4.0, 0.0), (8.0, 4.0)])
def test_the_edge_of_the_band_is_the_first_to_lose_stability(omega, curvature, mu):
    gamma_0 = float(threshold.pendula_threshold(omega, mu, 1.0))
    assert multiplier(omega, mu, gamma_0 * (1 + 1e-4), curvature) > 1.0 + 1e-5
    for stable_curvature in (0.0, 1.0, 2.0, 3.0, 4.0):
        assert multiplier(omega, mu, gamma_0 * (1 - 1e-4), stable_curvature) == pytest.approx(
            1.0, abs=1e-9
        )


@pytest.mark.parametrize(("factor", "grows"), [(0.98, False), (1.02, True)])
def test_simulated_pendula_leave_rest_above_the_threshold_at_its_rate(factor, grows):
    """Newton's equations with the sine, from tiny angles in the wave that is the first to grow."""
    sites, omega, mu = 5, 8.0, 0.2
    angle = np.pi * sites / (sites + 1)
    square, curvature = 1.0 / (mu * mu) + omega, 4.0 * np.sin(angle / 2) ** 2
    gamma = factor * 0.5 * square * float(mathieu.first_tongue((curvature - omega) / square))
    wave = {n - 2: 1e-12 * np.sin(angle * (n + 1)) for n in range(sites)}
    run = simulate(
        PaperProblem.of(
            {
                "epsilon": 1.0,
                "gamma": gamma,
                "omega": omega,
                "half_width": 2,
                "boundary": "dirichlet",
                "initial": {n: (a, -a) for n, a in wave.items()},
                "end_time": 30.0,
                "output_step": 0.01,
                "model": "pendula",
                "mu": mu,
                "solver": {"name": "taylor", "rtol": 1e-13, "atol": 1e-25},
            }
        )
    )
    late, later = (run.l2[0][1000 * i : 1000 * (i + 1)].max() for i in (1, 2))
    period = 0.5 * mu * mu * np.pi / np.sqrt(1.0 + mu * mu * omega)  # of the drive, in tau
    per_tau = np.log(multiplier(omega, mu, gamma, curvature)) / period
    assert (per_tau > 1e-3) == grows
    assert np.log(later / late) / 10.0 == pytest.approx(per_tau, abs=2e-3)
