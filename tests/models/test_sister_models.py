"""The examples of docs/own_models.md against what is published, or exact, of each of them."""

from pathlib import Path

import numpy as np
import pytest
from latticode.equations.model import Model
from latticode.localised.breathers import LocalisedState, exponents, find_state
from latticode.simulation.simulate import simulate
from pendula.problem import PaperProblem
from problems import constants_of

FOLDER = Path(__file__).parents[2] / "docs/models"


def problem(name, initial, boundary="dirichlet", half_width=10, end_time=5.0, **parameters):
    """Return the problem of an example from data {site: (field, ...)}."""
    return PaperProblem.of(
        {
            "model": Model.read(FOLDER / f"{name}.py"),
            "parameters": parameters,
            "half_width": half_width,
            "boundary": boundary,
            "initial": initial,
            "end_time": end_time,
            "output_step": 0.5,
            "snapshot_every": 1,
            "solver": {"name": "taylor", "rtol": 1e-13, "atol": 1e-13},
        }
    )


def growth(chain, state):
    """Return the largest rate of growth of a perturbation of a state."""
    return exponents(chain, state).real.max()


@pytest.mark.parametrize(("omega", "epsilon"), [(3.0, 0.1), (-2.0, 0.3)])
def test_rest_of_the_hamiltonian_chain_is_stable_below_the_published_threshold(omega, epsilon):
    """Chernyavsky and Pelinovsky, arXiv 1605.06455: the infinite chain's is the limit of these."""
    sines = np.sin(np.arange(1, 22) * np.pi / 44.0) ** 2
    threshold = np.abs(omega - 4.0 * epsilon * sines).min()
    at_rest = LocalisedState(np.zeros(84))
    for gamma, grows in ((0.999 * threshold, False), (1.001 * threshold, True)):
        numbers = {"omega": omega, "epsilon": epsilon, "gamma": gamma}
        chain = problem("chernyavsky_pelinovsky", {0: (0, 0)}, **numbers)
        assert (growth(chain, at_rest) > 1e-3) == grows


def soliton(epsilon, gamma):
    """Return the problem of the on-site soliton that continues sqrt(detuning + gamma), itself."""
    data = {0: (np.sqrt(1.0 + gamma),)}
    chain = problem("parametric", data, epsilon=epsilon, gamma=gamma)
    return chain, find_state(chain)


def test_on_site_soliton_under_parametric_drive_loses_stability_as_published():
    """Syafwan, Susanto and Cox, Phys. Rev. E 81 (2010) 026207: at a fifth of the detuning, as
    the coupling vanishes: its frequency 2 sqrt(gamma (1 + gamma)) then meets the waves."""
    low, high, epsilon = 0.1, 0.2, 0.005
    assert growth(*soliton(epsilon, low)) < 1e-6 < 1e-4 < growth(*soliton(epsilon, high))
    while high - low > 1e-3:
        middle = 0.5 * (low + high)
        grows = growth(*soliton(epsilon, middle)) > 1e-4
        low, high = (low, middle) if grows else (middle, high)
    assert abs(low - 0.2) < 0.01


def test_long_range_coupling_has_the_exact_waves_on_a_ring():
    ring = problem("disorder_and_long_range", {0: (0,)}, "periodic", disorder=0.0)
    frequencies = np.sort(exponents(ring, LocalisedState(np.zeros(42))).imag)
    angles = 2.0 * np.pi * np.arange(21) / 21.0
    waves = sum(2.0 * (np.cos(m * angles) - 1.0) / m**3 for m in range(1, 6))
    np.testing.assert_allclose(frequencies, np.sort([*waves, *-waves]), rtol=0, atol=1e-9)


@pytest.mark.parametrize("shift", [0.0, 0.7])
def test_pairs_of_another_frequency_are_a_chain_of_that_detuning(shift):
    """Disorder that is the same everywhere; the chain is the paper's."""
    data = {0: (1.0, 0.1), 1: (0.2j, 0.0)}
    run = simulate(problem("disordered_pairs", data, disorder=shift))
    chain = problem("disordered_pairs", data).changed(
        model="amplitudes", parameters={}, constants=constants_of((1.0, 1.0, shift - 4.0))
    )
    np.testing.assert_allclose(run.linf, simulate(chain).linf, rtol=1e-10)
