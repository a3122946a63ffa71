"""Runs in lanes: each with the bits that it has alone, whatever its neighbours do."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from oracle import BOUNDARIES
from pendula.integrators.outcome import DONE, NOT_FINITE, STEP_TOO_SMALL
from pendula.models.amplitudes import ENDS, Chain
from pendula.simulation.batches import integrate_batch
from pendula.simulation.lattice import WHOLE, pack
from pendula.simulation.observables import blank_record
from pendula.simulation.simulate import aligned, integrate
from pendula.simulation.solvers import SOLVERS

TIMES = [0.0, 0.3, 0.31, 2.0]


def draw(rng, runs, sites):
    """Return constants (run, 3) and amplitudes (run, 2, N) of runs that take unlike steps."""
    constants = np.column_stack([*rng.uniform(0, 2, (2, runs)), rng.uniform(-6, 10, runs)])
    size = rng.choice([0.1, 1.0, 4.0], (runs, 1, 1))
    return constants, size * (rng.normal(size=(runs, 2, sites, 2)) @ (1.0, 1j))


def run_alone(constants, boundary, amplitudes, times, tolerances):
    """Return (outcome, record) of `taylor` on one of the runs; nothing is refused or raised."""
    ends = ENDS[boundary], ENDS[boundary]
    y, times = pack(amplitudes, WHOLE), np.asarray(times, float)
    record, solver = blank_record(2, y.shape[1] - 2, len(times), 0), SOLVERS["taylor"]
    work = aligned((solver.work, *y.shape))
    return solver.run(Chain(*constants, *ends), y, times, tolerances, work, record), record


@settings(max_examples=40)
@given(
    runs=st.integers(1, 11),
    half_width=st.integers(0, 4),
    boundary=st.sampled_from(BOUNDARIES),
    seed=st.integers(0, 2**32 - 1),
)
def test_each_run_has_the_bits_that_it_has_alone(runs, half_width, boundary, seed):
    constants, data = draw(np.random.default_rng(seed), runs, 2 * half_width + 1)
    batch = integrate_batch(constants, boundary, data, TIMES, 1e-9, 1e-12)
    solver = {"name": "taylor", "rtol": 1e-9, "atol": 1e-12}
    for i in range(runs):
        alone = integrate(constants[i], boundary, data[i], WHOLE, np.array(TIMES), solver)
        assert batch.ended[i].tolist() == alone.outcome[:3]
        np.testing.assert_array_equal(batch.final[i], alone.final)
        np.testing.assert_array_equal(batch.linf[:, i], alone.linf)
        np.testing.assert_array_equal(batch.l2[:, i], alone.l2)
        np.testing.assert_array_equal(batch.energy[i], alone.energy)


@pytest.mark.parametrize("place", range(6))
@pytest.mark.parametrize(("epsilon", "status"), [(4e9, STEP_TOO_SMALL), (1e300, NOT_FINITE)])
def test_a_run_that_cannot_go_on_leaves_the_others_alone(place, epsilon, status):
    constants, data = draw(np.random.default_rng(1), 6, 3)
    sound = integrate_batch(constants, "free", data, TIMES, 1e-9, 1e-12)
    constants[place, 0] = epsilon
    batch = integrate_batch(constants, "free", data, TIMES, 1e-9, 1e-12)
    outcome, record = run_alone(constants[place], "free", data[place], TIMES, (1e-9, 1e-12))
    assert outcome.status == status and batch.ended[place].tolist() == outcome[:3]
    np.testing.assert_array_equal(batch.l2[:, place, 0], record.l2[:, 0])
    others = np.arange(6) != place
    np.testing.assert_array_equal(batch.ended[others], sound.ended[others])
    np.testing.assert_array_equal(batch.l2[:, others], sound.l2[:, others])
    np.testing.assert_array_equal(batch.final[others], sound.final[others])


@pytest.mark.parametrize("times", [[0.0], [1.0, 1.5], np.linspace(0.0, 1.0, 400)])
def test_outputs_may_be_one_or_many_and_begin_anywhere(times):
    constants, data = draw(np.random.default_rng(2), 5, 3)
    batch = integrate_batch(constants, "periodic", data, times, 1e-6, 1e-6)
    assert (batch.ended["status"] == DONE).all()
    for i in range(5):
        outcome, record = run_alone(constants[i], "periodic", data[i], times, (1e-6, 1e-6))
        assert batch.ended["time"][i] == outcome.time
        np.testing.assert_array_equal(batch.energy[i], record.energy)


def test_data_at_rest_stay_at_rest_beside_data_that_move():
    constants, data = draw(np.random.default_rng(3), 4, 5)
    data[2] = 0.0
    batch = integrate_batch(constants, "dirichlet", data, TIMES, 1e-9, 1e-12)
    assert batch.ended["steps"].tolist()[2] == 1 < batch.ended["steps"][[0, 1, 3]].min()
    assert not batch.final[2].any() and batch.final[[0, 1, 3]].all()


def test_a_chain_without_a_site_in_its_middle_is_refused():
    with pytest.raises(ValueError, match="odd number of sites, not 4"):
        integrate_batch(np.ones((2, 3)), "free", np.ones((2, 2, 4)), TIMES, 1e-9, 1e-9)
