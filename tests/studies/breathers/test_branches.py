"""Where families of steady states are born and turn stable."""

import pytest
from pendula.models.pairs import FAMILIES
from pendula.studies.breathers.branches import follow, pitchfork, thresholds, turning_point
from pendula.studies.breathers.steady import Chain, NotFoundError, continued

_, EQUAL, ASYMMETRIC, IMAGINARY, ASYMMETRIC_IMAGINARY = FAMILIES


@pytest.mark.parametrize(("parent", "omega"), [(EQUAL, -0.7), (IMAGINARY, -2.1)])
def test_the_pitchforks_of_one_pair_are_those_of_the_closed_form(parent, omega):
    """A = B bifurcates at -gamma, A = -B at -3 gamma."""
    pair = Chain(epsilon=0.0, gamma=0.7, omega=omega, half_width=1)
    assert pitchfork(pair, parent, 1.2 * omega, 0.9 * omega) == pytest.approx(omega, abs=1e-12)


@pytest.mark.parametrize(
    ("parent", "daughter"), [(EQUAL, ASYMMETRIC), (IMAGINARY, ASYMMETRIC_IMAGINARY)]
)
def test_a_daughter_turns_at_the_pitchfork(parent, daughter):
    chain = Chain(epsilon=0.3, gamma=1.0, omega=-5.0, half_width=8)
    state = continued(chain, daughter)
    turns = turning_point(follow(chain, daughter, state, stop=-5.0))
    assert pitchfork(chain, parent, turns - 0.05, turns + 0.05) == pytest.approx(turns, abs=1e-5)


def test_a_threshold_is_where_the_verdict_changes():
    chains = [Chain(1.0, 1.0, 0.0, half) for half in (8, 16)]
    found = thresholds(chains, EQUAL, -9.0, -5.0, 1e-2)
    assert found[0] == pytest.approx(found[1], abs=0.1)
    for low, high in ((found[0] + 0.1, -5.0), (-9.0, found[0] - 0.1)):
        with pytest.raises(NotFoundError, match="stable at"):
            thresholds(chains, EQUAL, low, high, 1e-2)
