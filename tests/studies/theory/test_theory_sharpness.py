"""What data reach of the bounds, by formulas; data of one energy; Picard's iterates."""

import numpy as np
import pytest
from pendula.models.bounds import theorem_3_bound
from pendula.problem import Constants
from pendula.studies.theory.equations import (
    BOUNDARIES,
    alternating,
    right_hand_side,
    total_energy,
)
from pendula.studies.theory.estimates import picard
from pendula.studies.theory.inequalities import energy_excess
from pendula.studies.theory.sharpness import least_constant, limit_constant, reached, shell_state
from pendula.studies.theory.worst_data import supremum

NEGATIVE = Constants(epsilon=1.0, gamma=1.0, omega=-4.0)
POSITIVE = Constants(epsilon=1.0, gamma=1.0, omega=8.0)
FORMS = {"theorem_1": (POSITIVE, "theorem_1"), "theorem_2": (NEGATIVE, "theorem_2_energy")}


@pytest.mark.parametrize("sites", [3, 11])
def test_a_tiny_wave_reaches_what_the_linear_equations_say(sites):
    for form, (constants, family) in FORMS.items():
        expected = supremum(family, constants, sites, "dirichlet")
        assert reached(form, constants, sites) == pytest.approx(expected, rel=1e-6)
    # supremum takes C_0 at delta_0, which is twice that for tiny data
    expected = 2.0 * supremum("theorem_2_ball", NEGATIVE, sites, "dirichlet")
    assert reached("theorem_2_ball", NEGATIVE, sites) == pytest.approx(expected, rel=1e-6)


def test_long_chains_reach_the_bounds_by_the_energy_and_not_c_0_delta():
    assert reached("theorem_1", POSITIVE, 201) == pytest.approx(1.0, abs=1e-3)
    assert reached("theorem_2_ball", NEGATIVE, 201) == pytest.approx(0.6, abs=2e-3)
    assert least_constant(NEGATIVE) == 3.0 and limit_constant(NEGATIVE) == 5.0


def test_the_lower_bound_in_theorem_3s_proof_is_the_energy_of_a_long_alternating_chain():
    """The other bounds on the energy are far from it there."""
    excess = energy_excess(POSITIVE, NEGATIVE, alternating(1001, 3.0), "dirichlet", 1.0)
    assert excess[3] == pytest.approx(0.0, abs=3e-3)
    assert max(*excess[:3], excess[4]) < -1.0


def test_states_of_one_energy_have_it_and_stay_below_theorem_3():
    state = shell_state(NEGATIVE, 11, -6.5)
    energy = total_energy(NEGATIVE, "dirichlet", state)
    assert energy == pytest.approx(-6.5, abs=1e-6)
    assert np.sum(np.abs(state) ** 2) < theorem_3_bound(energy, 11, NEGATIVE)
    assert shell_state(POSITIVE, 11, -1.0) is None


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_picards_first_iterate_is_one_step_of_euler(boundary):
    start = np.array([[1.0, 0.5j, 0.0], [0.2, 0.0, -1.0]], complex)
    found, _ = picard(NEGATIVE, boundary, start, 0.01, 1, start)
    expected = start + 0.01 * right_hand_side(NEGATIVE, boundary, start)
    np.testing.assert_allclose(found, expected, atol=1e-14)
