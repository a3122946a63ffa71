"""Active sites: the numbers are those of the whole chain, and S and D obey its equations."""

import numpy as np
import pytest
from latticode.simulation.active_sites import integrate_intervals
from latticode.simulation.lattice import FULL_CHAIN
from latticode.simulation.simulate import simulate
from oracle import random_chain
from pendula.studies.unbounded.active_sites import run_long
from pendula.studies.unbounded.bulk import find_front, region_means
from pendula.studies.unbounded.sums import in_sums, turned
from problems import problem_of

TIGHT = {"name": "dop853", "rtol": 1e-14, "atol": 1e-14}
REST_THRESHOLD = 1e-20
LOPSIDED = {-2: (1.0, 0.1), 0: (0.0, 0.5j)}


@pytest.mark.parametrize(
    "changes",
    [{}, {"initial": {0: (1.0, 1.0)}}, {"initial": LOPSIDED}],
    ids=["as in the paper", "A = B, and both components are kept", "not even"],
)
def test_the_norms_of_a_regular_case_are_those_of_a_long_chain(changes):
    settings = {"half_width": None, "end_time": 40.0, "output_step": 0.5, "solver": TIGHT}
    endless = problem_of("fig3_small", **settings | changes)
    full_chain = simulate(endless.changed(half_width=150), FULL_CHAIN)
    series = run_long(endless, REST_THRESHOLD)
    np.testing.assert_allclose(series["tau"], full_chain.tau, rtol=1e-14)
    np.testing.assert_allclose(series["l2"], np.hypot(*full_chain.l2), rtol=1e-12)
    np.testing.assert_allclose(series["linf"], full_chain.linf.max(axis=0), atol=1e-12)
    *_, (*_, sites) = integrate_intervals(in_sums(endless), REST_THRESHOLD)
    rows = turned(sites)
    amplitudes, right = rows[0::2] + 1j * rows[1::2], full_chain.final[:, 150:]
    shared = min(amplitudes.shape[1], right.shape[1])
    np.testing.assert_allclose(amplitudes[:, :shared], right[:, :shared], atol=1e-10)
    assert series["front"][-1] == find_front((np.abs(right) ** 2).sum(axis=0))
    assert series["second_front"][-1] == find_front(np.abs(right[0] + right[1]) ** 2 / 2.0)


@pytest.mark.parametrize(("end_time", "output_step"), [(25.0, 0.25), (3.0, 0.25), (20.1, 0.3)])
def test_a_run_ends_at_the_time_that_it_was_given(end_time, output_step):
    """Also where it is no whole number of pieces: outputs and looks at the fronts reach it."""
    times = {"end_time": end_time, "output_step": output_step}
    run = run_long(problem_of("fig3_small", half_width=None, solver=TIGHT, **times), REST_THRESHOLD)
    count = round(end_time / output_step)
    np.testing.assert_allclose(run["tau"], np.linspace(0.0, end_time, count + 1), rtol=1e-14)
    assert run["piece_tau"][-1] == run["tau"][-1] and np.diff(run["piece_tau"]).max() <= 2.0


def test_means_are_those_of_the_sites_well_behind_and_well_between_the_fronts():
    z = random_chain(120, even=True)
    a, b = z[:, 120:]
    sites = turned(np.array([a.real, a.imag, b.real, b.imag]))
    powers, sums = (np.abs(z[:, 120:]) ** 2).sum(axis=0), np.abs(a + b) ** 2 / 2.0
    behind, between = region_means(sites, 110.0, 20.0)
    assert behind == pytest.approx([powers[1:18].mean(), sums[1:18].mean()])
    assert between == pytest.approx([powers[30:70].mean(), sums[30:70].mean()])
    nothing, all_of_it = region_means(sites, 110.0, -1.0)
    assert np.isnan(nothing).all() and all_of_it[0] == pytest.approx(powers[1:70].mean())
    assert np.isnan(region_means(sites, 45.0, 40.0)[1]).all()


def test_several_levels_and_edges_are_looked_at_in_one_run():
    """The first of each are those of a run with these alone; a lower level lies further out."""
    problem = problem_of(
        "fig4_small", half_width=None, solver=TIGHT, end_time=40.0, output_step=2.0
    )
    single = run_long(problem, REST_THRESHOLD, levels=(1e-2,), edges=(5,))
    several = run_long(problem, REST_THRESHOLD, levels=(1e-2, 1e-6), edges=(5, 20))
    np.testing.assert_array_equal(several["second_front"][:, 0], single["second_front"])
    np.testing.assert_array_equal(several["means"][:, 0], single["means"])
    np.testing.assert_array_equal(several["front"], single["front"])
    assert (several["second_front"][-1, 1] > several["second_front"][-1, 0]).all()
    assert several["means"].shape == (20, 2, 2, 2)
    assert abs(several["means"][-1, 1] - several["means"][-1, 0]).max() > 0.0
