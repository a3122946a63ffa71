"""A ring that changes the sign: as half of a ring of twice its length, and by its plane waves."""

import numpy as np
import pytest
from dimers import DIMERS, dimers
from latticode import Model, abs2, lap
from latticode.equations.ends import ENDS, kind_of
from latticode.simulation.lattice import FULL_CHAIN
from latticode.simulation.problem import Problem
from latticode.simulation.simulate import simulate

SOLVERS = {
    "taylor": {"name": "taylor", "rtol": 1e-14, "atol": 1e-14},
    "dop853": {"name": "dop853", "rtol": 1e-13, "atol": 1e-13},
    "ode45": {"name": "ode45", "rtol": 1e-12, "atol": 1e-12},
}
DATA = {0: (1.0, 0.1), 7: (0.3j, 0.5), -8: (0.2, -0.4)}


def far(p, u):
    return p.c * (u.right.right + u.left.left - 2.0 * u) + abs2(u) * u


LONG = Model(fields="u", parameters={"c": 0.7}, i_dt=far, conserved=lambda p, u: {"P": abs2(u)})


def on_a_ring(model, z, boundary, solver="taylor"):
    return simulate(
        Problem(
            model=model,
            half_width=z.shape[1] // 2,
            boundary=boundary,
            initial=z,
            end_time=3.0,
            output_step=1.0,
            solver=SOLVERS[solver],
            snapshot_every=1,
        )
    )


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("model", [DIMERS, LONG])
def test_it_is_half_of_a_ring_whose_second_half_has_the_other_sign(model, solver):
    rng = np.random.default_rng(1)
    z = rng.normal(size=(len(model.fields), 9)) + 1j * rng.normal(size=(len(model.fields), 9))
    # nine and nine sites make an even number; three copies make an odd one with the same signs
    both = np.concatenate([z, -z, z], axis=1)
    once = on_a_ring(model, z, "antiperiodic", solver).final
    thrice = on_a_ring(model, both, "antiperiodic", solver).final
    np.testing.assert_allclose(thrice[:, :9], once, rtol=0, atol=1e-9)
    np.testing.assert_allclose(thrice[:, 9:18], -once, rtol=0, atol=1e-9)
    assert np.abs(on_a_ring(model, z, "periodic", solver).final - once).max() > 1e-3


def test_a_plane_wave_turns_at_its_frequency():
    """A wave of 2k + 1 half turns keeps its modulus and turns by lambda = 2 cos q - 2 + |u|^2."""
    model = Model(fields="u", parameters={}, i_dt=lambda p, u: lap(u) + abs2(u) * u)
    q = 3.0 * np.pi / 11
    wave = 0.6 * np.exp(1j * q * np.arange(11))
    turned = np.exp(-1j * (2.0 * np.cos(q) - 2.0 + 0.36) * 3.0)
    final = on_a_ring(model, wave[None], "antiperiodic").final[0]
    np.testing.assert_allclose(final, turned * wave, rtol=0, atol=1e-13)


def test_a_long_ring_goes_order_by_order_as_a_short_one_does():
    """Beyond 64 blocks a chain goes in waves, and a ring has no side to start from."""
    z = np.zeros((1, 1201), complex)
    z[0, [0, 1, -1]] = 1.0, 0.5j, -0.3
    final = on_a_ring(LONG, z, "antiperiodic").final
    expected = on_a_ring(LONG, z, "antiperiodic", "dop853").final
    np.testing.assert_allclose(final, expected, rtol=0, atol=1e-11)


def test_the_power_is_conserved_across_the_ends():
    z = np.zeros((1, 9), complex)
    z[0, [0, -1]] = 1.0, 0.7j
    power = on_a_ring(LONG, z, "antiperiodic").conserved["P"]
    assert np.abs(power / power[0] - 1.0).max() < 1e-13


def test_an_even_state_is_not_halved():
    problem = dimers(boundary="antiperiodic", half_width=4)
    np.testing.assert_array_equal(simulate(problem).final, simulate(problem, FULL_CHAIN).final)


def test_a_factor_that_nothing_was_taught_is_refused(monkeypatch):
    monkeypatch.setitem(ENDS, "fading", ENDS["periodic"]._replace(factor=0.5))
    with pytest.raises(ValueError, match=r"no kernel .* see the sites \(-1, 0\), times 0.5"):
        kind_of("fading")
