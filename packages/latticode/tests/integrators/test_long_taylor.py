"""long_taylor: a long chain has the series, the outputs and the accuracy of a short one."""

import numpy as np
import pytest
from dimers import DIMERS, PAPER, chain, integrate
from latticode import Case, Model, abs2, cos, lap, shift
from latticode.integrators import long_taylor, taylor
from latticode.kernels.simd import LANES
from latticode.simulation.lattice import FULL_CHAIN, find_reduction, pack
from latticode.simulation.simulate import IntegrationError, simulate
from oracle import random_chain

TAYLOR = {"name": "taylor", "rtol": 1e-12, "atol": 1e-12}
OUTPUTS = long_taylor.OUTPUTS


@pytest.fixture
def for_all(monkeypatch):
    """Return a function that lets all chains, or none of them, count as long."""
    return lambda long: monkeypatch.setattr(long_taylor, "LONGER_THAN", 0 if long else 10**9)


@pytest.fixture
def both(for_all):
    """Return a function that makes a run as a long chain and as a short one."""

    def make(run):
        runs = []
        for long in (True, False):
            for_all(long)
            runs.append(run())
        return runs

    return make


def assert_same_bits(first, second):
    for name in ("final", "linf", "l2", "modulus"):
        np.testing.assert_array_equal(getattr(first, name), getattr(second, name))


@pytest.mark.parametrize("boundary", ["dirichlet", "free"])
@pytest.mark.parametrize("half_width", [0, 3, 20, 131, 400])
def test_a_step_and_its_outputs_have_the_bits_of_a_short_chain(both, half_width, boundary):
    z = random_chain(half_width, even=True)
    for reduction in (FULL_CHAIN, find_reduction(z)):
        long, short = both(
            lambda cut=reduction: integrate(
                z, TAYLOR, 1e-3, OUTPUTS, cut, boundary=boundary, snapshot_every=1
            )
        )
        assert (long.outcome.steps, short.outcome.steps) == (1, 1)
        assert_same_bits(long, short)


def test_many_steps_follow_another_solver_and_none_is_longer_than_allowed(for_all):
    """Where an allowed step is much shorter than the one before, the step is repeated."""
    z = random_chain(60)
    for_all(long=True)
    long = integrate(z, TAYLOR, 3.0)
    other = integrate(z, {"name": "dop853", "rtol": 1e-13, "atol": 1e-13}, 3.0)
    np.testing.assert_allclose(long.final, other.final, atol=1e-10)
    assert long.outcome.rejected > 1
    for_all(long=False)
    assert integrate(z, TAYLOR, 3.0).outcome.steps <= long.outcome.steps


@pytest.mark.parametrize("outputs", [OUTPUTS + 1, 50 * OUTPUTS])
def test_a_step_with_many_outputs_is_divided(both, outputs):
    z = random_chain(9)
    long, short = both(lambda: integrate(z, TAYLOR, 0.3, outputs))
    np.testing.assert_allclose(long.linf, short.linf, rtol=1e-11)
    np.testing.assert_allclose(long.final, short.final, atol=1e-11)
    assert long.outcome.steps >= outputs / OUTPUTS


def test_a_ring_is_integrated_as_a_short_chain(both):
    z = random_chain(20)
    assert_same_bits(*both(lambda: integrate(z, TAYLOR, boundary="periodic")))


# --- Blocks at rest -------------------------------------------------------------------------------

EQUATIONS = {
    "nearest neighbours": lambda p, u: lap(u) + 0.5 * abs2(u) * u,
    "far neighbours": lambda p, u: shift(u, 5) + shift(u, -1) + 0.5 * shift(u, -3) * abs2(u.right),
    "functions": lambda p, u: lap(u) + cos(u.real) * u + abs2(u) / (1 + abs2(u.left)) * u,
    "driven": lambda p, u: lap(u) + cos(3 * p.t) * abs2(u) * u,
    "disordered": lambda p, u: lap(u) + p.V * u + 0.5 * abs2(u) * u,
}


def case_of(name, half_width=300, end_time=0.8, **initial):
    parameters = {"V": lambda n: 0.1 * (n % 3)} if name == "disordered" else {}
    model = Model(fields="u", parameters=parameters, i_dt=EQUATIONS[name])
    case = Case(
        model=model,
        half_width=half_width,
        initial=initial or {-170: [1.0], -165: [0.3 - 0.4j]},
        end_time=end_time,
        solver=TAYLOR,
    )
    return case.kind.of(case.problem())


@pytest.mark.parametrize("name", EQUATIONS)
def test_the_window_changes_no_bit(for_all, name):
    """A window that lags behind the motion would cut off tails, which are far below its norms."""
    for_all(long=True)
    within = simulate(case_of(name))
    problem = case_of(name)
    assert problem.model.stays_at_rest
    problem.model.__dict__["stays_at_rest"] = False  # the window is then the whole chain
    everywhere = simulate(problem)
    assert_same_bits(within, everywhere)
    assert within.outcome == everywhere.outcome
    assert within.outcome.steps > 3
    sizes = np.abs(within.final[within.final != 0])
    assert sizes.min() < 1e-100, "the motion reaches no tail"
    assert sizes.size < within.final.size / 2, "no block is at rest"


@pytest.mark.parametrize("name", EQUATIONS)
def test_every_kind_of_model_has_the_solution_of_a_short_chain(both, name):
    long, short = both(lambda: simulate(case_of(name)))
    np.testing.assert_allclose(long.final, short.final, atol=1e-11)


def test_blocks_at_rest_are_not_computed(for_all):
    """If all blocks of this chain were computed, a run would take 300 times as long."""
    for_all(long=True)
    problem = case_of("nearest neighbours", 100_000)
    state = pack(problem.amplitudes, FULL_CHAIN)
    blocks = -(-(state.shape[1] - 2) // LANES)
    first, stop = long_taylor.window_of(state, 0, blocks, 2)
    assert first == (100_000 - 170) // LANES - 2
    assert stop == (100_000 - 165) // LANES + 3


def test_a_window_has_margins_within_the_chain():
    y = np.zeros((2, 5 * LANES + 2))
    y[1, 1 + 2 * LANES] = 1.0
    assert long_taylor.window_of(y, 0, 5, 1) == (1, 4)
    assert long_taylor.window_of(y, 0, 5, 7) == (0, 5)
    first, stop = long_taylor.window_of(np.zeros_like(y), 0, 5, 2)
    assert 0 <= first < stop <= 5


@pytest.mark.parametrize(
    ("rule", "rests"),
    [
        (lambda p, u: lap(u) + cos(p.t) * abs2(u) * u, True),
        (lambda p, u: lap(u) + (1 - cos(u.real)), True),
        (lambda p, u: lap(u) + p.force, False),
        (lambda p, u: lap(u) + cos(p.t), False),
        (lambda p, u: lap(u) + cos(u.real), False),
    ],
)
def test_a_model_tells_whether_a_chain_at_rest_stays_so(rule, rests):
    model = Model(fields="u", parameters={"force": 0.3}, i_dt=rule)
    assert model.stays_at_rest == rests


def test_a_chain_that_does_not_stay_at_rest_moves_everywhere(both):
    model = Model(fields="u", parameters={}, i_dt=lambda p, u: lap(u) + 0.3)
    case = Case(model=model, half_width=200, initial={0: [1.0]}, end_time=1, solver=TAYLOR)
    long, short = both(lambda: simulate(case.kind.of(case.problem())).final)
    np.testing.assert_allclose(long, short, atol=1e-11)
    assert (np.abs(long) > 0.1).all()


# --- Limits ---------------------------------------------------------------------------------------


def test_a_run_that_leaves_the_numbers_stops(both):
    model = Model(fields="x", parameters={}, dt=lambda p, x: x * x)
    case = Case(model=model, half_width=3, initial={0: [1.0]}, end_time=2.0, solver=TAYLOR)
    problem = case.kind.of(case.problem())

    def message():
        with pytest.raises(IntegrationError) as error:
            simulate(problem)
        return str(error.value)

    long, short = both(message)
    assert long.partition(":")[2] == short.partition(":")[2]


def test_a_long_chain_needs_a_tenth_of_the_memory(for_all):
    z = np.ones((2, 2 * 10_000 + 1), complex)
    problem = chain(z, PAPER, solver=TAYLOR)
    compiled = problem.equations.compiled("taylor")
    system, y = problem.equations.system(FULL_CHAIN), pack(z, FULL_CHAIN)
    for_all(long=True)
    assert len(compiled.work_for(system, y)) < taylor.WORK / 9
    for_all(long=False)
    assert len(compiled.work_for(system, y)) == taylor.WORK


def test_only_a_chain_longer_than_the_cache_is_long():
    equations = chain(np.ones((2, 3), complex), PAPER, solver=TAYLOR).equations
    compiled, system = equations.compiled("taylor"), equations.system(FULL_CHAIN)
    for sites in (long_taylor.LONGER_THAN, long_taylor.LONGER_THAN + 1):
        is_long = sites > long_taylor.LONGER_THAN
        assert compiled.is_long(system, np.zeros((4, sites + 2))) == is_long
    assert not equations.compiled("dop853").is_long(system, np.zeros((4, 10**5)))
    assert DIMERS.stays_at_rest
