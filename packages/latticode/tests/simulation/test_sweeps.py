"""Sweeps: the statistics that the paper's figures and captions speak of."""

import numpy as np
import pytest
from dimers import chain
from latticode.equations.initial_values import on_sites
from latticode.simulation.simulate import simulate
from latticode.simulation.sweep import sweep

PROBLEM = chain(
    on_sites({0: (1.0, 0.1)}),
    solver={"name": "ode45", "rtol": 1e-7, "atol": 1e-9},
    half_width=30,
    end_time=3.0,
    output_step=0.025,
)
WINDOWS = [(1.0, 2.0), (0.0, 3.0)]


@pytest.fixture(scope="module")
def swept():
    return sweep(PROBLEM, [4, 7], WINDOWS)


@pytest.fixture(scope="module")
def run():
    return simulate(PROBLEM.changed(half_width=7))


@pytest.mark.parametrize(("window", "first", "last"), [(0, 40, 80), (1, 0, 120)])
def test_maxima_are_those_of_the_trajectory_over_the_whole_window(swept, run, window, first, last):
    inside = slice(first, last + 1)
    pair = np.hypot(run.l2[0], run.l2[1])[inside]
    np.testing.assert_allclose(
        swept["l2"][1, :, 0, window], [*run.l2[:, inside].max(axis=1), pair.max()], rtol=1e-14
    )
    np.testing.assert_allclose(
        swept["linf"][1, :, 0, window],
        [*run.linf[:, inside].max(axis=1), run.linf[:, inside].max()],
    )


def test_means_are_integrals_over_the_window(swept, run):
    inside = slice(40, 81)
    integral = np.trapezoid(run.l2[:, inside], run.tau[inside], axis=1)
    np.testing.assert_allclose(swept["l2"][1, :2, 1, 0], integral, rtol=1e-12)


def test_a_chain_that_nothing_crosses_stands_for_longer_ones(monkeypatch):
    followed = []

    def follow(problem, **options):
        followed.append(problem.half_width)
        return simulate(problem, **options)

    monkeypatch.setattr("latticode.simulation.sweep.simulate", follow)
    swept = sweep(PROBLEM, [8, 25, 40, 12, 30], WINDOWS)
    assert followed == [8, 25, 12]  # by tau = 3 the data have come to M = 12, and to M = 25 not
    for norms in (swept["l2"], swept["linf"]):
        np.testing.assert_array_equal(norms[2], norms[1])
        np.testing.assert_array_equal(norms[4], norms[1])
        assert (norms[3] != norms[1]).any()
    assert sweep(PROBLEM, [40], WINDOWS)["l2"].tolist() == swept["l2"][2:3].tolist()
