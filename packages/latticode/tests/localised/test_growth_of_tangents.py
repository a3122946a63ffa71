"""Tangent vectors of any model against distances of solutions, exact rates and QR."""

import numpy as np
import pytest
from latticode.equations.model import Model, abs2, conj, lap, shift, sin
from latticode.localised.bundles import orthonormalise
from latticode.localised.tangents import grow, random_tangent
from latticode.simulation.lattice import FULL_CHAIN, pack
from latticode.simulation.problem import Problem
from latticode.simulation.simulate import IntegrationError, simulate
from latticode.simulation.traced import make_system

COUPLED = Model(
    fields=("A", "B"),
    parameters={"epsilon": 0.7, "gamma": 1.3, "omega": -2.1},
    i_dt=lambda p, a, b: [
        p.epsilon * lap(u) + p.omega * u + p.gamma * (conj(v) - conj(u)) + 0.5 * abs2(u) * u
        for u, v in ((a, b), (b, a))
    ],
)
FAR = Model(
    fields="u",
    parameters={"J": 0.3},
    i_dt=lambda p, u: lap(u) + p.J * (shift(u, 2) + shift(u, -2)) * abs2(u),
)
DISORDERED = Model(
    fields="u",
    parameters={"V": lambda n: np.cos(3.0 * n)},
    i_dt=lambda p, u: lap(u) + p.V * u - abs2(u) * u,
)
DRIVEN = Model(
    fields="x",
    parameters={},
    d2_dt2=lambda p, x, v: 0.4 * lap(x) - (1 + sin(3 * p.t)) * sin(x) - 0.1 * v,
)
each_model = pytest.mark.parametrize(
    "model", [COUPLED, FAR, DISORDERED, DRIVEN], ids=["coupled", "far", "disordered", "driven"]
)


def chain(model, half_width=4, boundary="dirichlet", end_time=1.3, even=False):
    """Return a problem with random data on the whole chain."""
    drawn = random_tangent(
        2 * half_width + 1, np.random.default_rng(1), even, fields=len(model.fields)
    )
    return Problem(
        model=model,
        half_width=half_width,
        boundary=boundary,
        initial=drawn,
        end_time=end_time,
        output_step=end_time,
        solver={"name": "dop853", "rtol": 1e-12, "atol": 1e-12},
    )


def state_of(problem, final):
    """Return the final state as real numbers: parts of complex fields, or values and rates."""
    return np.concatenate([*final]) if problem.model.second_order else final.view(float)


@each_model
@pytest.mark.parametrize("boundary", ["dirichlet", "free", "periodic"])
def test_a_vector_grows_like_the_distance_of_two_solutions(model, boundary):
    case, h = chain(model, boundary=boundary), 1e-6
    vector = random_tangent(case.sites, np.random.default_rng(2), fields=len(model.fields))
    vector /= np.linalg.norm(vector)
    ends = [
        state_of(case, simulate(case.changed(initial=case.initial + s * vector)).final)
        for s in (h, -h)
    ]
    computed = grow(case, vector[None], 1.3, step=0.1, tolerance=1e-11)
    distance = np.linalg.norm(ends[0] - ends[1]) / (2 * h)
    assert computed.log_growth[0, -1] == pytest.approx(np.log(distance), abs=1e-7)
    assert computed.size[-1] == pytest.approx(np.linalg.norm(ends[0] + ends[1]) / 2, rel=1e-8)


@pytest.mark.parametrize("model", [COUPLED, FAR], ids=["coupled", "far"])
def test_half_of_an_even_chain_gives_the_growth_of_the_whole(model):
    case = chain(model, half_width=9, even=True)
    rng = np.random.default_rng(3)
    vectors = [random_tangent(19, rng, even=True, fields=len(model.fields)) for _ in range(3)]
    full, half = (grow(case, np.array(vectors), 1.0, even=even) for even in (False, True))
    np.testing.assert_allclose(half.log_growth, full.log_growth, rtol=0, atol=1e-7)
    np.testing.assert_allclose(half.size, full.size, rtol=1e-9)


@pytest.mark.parametrize("gain", [0.4, -0.4])
def test_all_vectors_of_linear_equations_grow_at_the_exact_rate(gain):
    """i u' = lap u + i gain u turns orthonormal vectors into orthonormal ones, times e^(gain t)."""
    model = Model(fields="u", parameters={"g": gain}, i_dt=lambda p, u: lap(u) + 1j * p.g * u)
    rng = np.random.default_rng(4)
    vectors = np.array([random_tangent(5, rng, fields=1) for _ in range(4)])
    computed = grow(chain(model, half_width=2), vectors, 3.0, tolerance=1e-11)
    np.testing.assert_allclose(computed.log_growth, np.tile(gain * computed.tau, (4, 1)), atol=1e-8)


def test_orthonormalising_measures_what_a_qr_decomposition_does():
    case = chain(COUPLED, half_width=2)
    rng = np.random.default_rng(5)
    states = np.array([pack(random_tangent(5, rng), FULL_CHAIN) for _ in range(4)])
    bundle, lengths = np.concatenate(states), np.empty(3)
    orthonormalise(make_system(case, FULL_CHAIN), bundle, lengths)
    vectors = states[1:, :, 1:-1].reshape(3, -1).T
    expected = np.abs(np.diag(np.linalg.qr(vectors)[1]))
    np.testing.assert_allclose(lengths, expected, rtol=1e-12)
    after = bundle.reshape(4, 4, -1)[1:, :, 1:-1].reshape(3, -1)
    np.testing.assert_allclose(after @ after.T, np.eye(3), atol=1e-14)


def test_a_solution_that_cannot_be_followed_is_told():
    model = Model(fields="u", parameters={}, i_dt=lambda p, u: 1j * abs2(u) * u)
    with pytest.raises(IntegrationError, match="stopped while integrating tangent vectors"):
        grow(chain(model, half_width=1), np.ones((1, 1, 3)), 50.0)
