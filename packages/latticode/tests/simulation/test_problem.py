"""One initial-value problem: its data, its chain, its times, and its form of plain values."""

import dataclasses

import numpy as np
import pytest
from dimers import chain
from hypothesis import given
from hypothesis import strategies as st
from latticode.equations.initial_values import (
    by_site,
    on_sites,
    output_times,
    place,
    read_initial,
    write_initial,
)
from latticode.simulation.problem import Problem
from oracle import chains

PAIR = on_sites({0: (1.0, 0.1)})


def test_data_are_placed_on_their_sites():
    amplitudes = place(on_sites({-2: (1j, 2), 1: (3, -4j)}), 3)
    expected = [[0, 1j, 0, 0, 3, 0, 0], [0, 2, 0, 0, -4j, 0, 0]]
    np.testing.assert_array_equal(amplitudes, np.array(expected, complex))


@pytest.mark.parametrize("site", [-3, 3, 100])
def test_a_site_outside_the_chain_is_refused(site):
    with pytest.raises(ValueError, match=rf"site {abs(site)} .* -2\.\.2"):
        chain(on_sites({site: (1, 1)}), half_width=2)


def test_a_problem_cannot_be_changed_in_place():
    problem = chain(PAIR)
    with pytest.raises(dataclasses.FrozenInstanceError):
        problem.end_time = 2.0
    with pytest.raises(ValueError, match="read-only"):
        problem.initial[0, 0] = 2.0
    with pytest.raises(TypeError):
        problem.solver["rtol"] = 1.0


def test_a_change_leaves_the_rest_as_it_was():
    problem = chain(PAIR, numbers=(0.5, 0.7, 3.0))
    longer = problem.changed(omega=1.0, half_width=4, end_time=2.0)
    changed = {"parameters": problem.parameters | {"omega": 1.0}, "half_width": 4, "end_time": 2.0}
    assert longer.plain() == problem.plain() | changed
    assert longer.amplitudes.shape == (2, 9) and longer.sites == 9


@given(chains(widths=(0, 3)), st.sampled_from(["dirichlet", "free", "periodic"]))
def test_plain_values_make_the_same_problem(data, boundary):
    problem = chain(data, (0.3, -0.7, 2.0), boundary)
    restored = Problem.of(problem.plain())
    assert restored.plain() == problem.plain()
    np.testing.assert_array_equal(restored.amplitudes, problem.amplitudes)
    np.testing.assert_array_equal(restored.times, problem.times)


@given(chains(widths=(0, 3)))
def test_initial_data_can_be_read_as_they_were_written(data):
    by_sites = by_site(data)
    assert read_initial(write_initial(by_sites)) == by_sites


def test_initial_data_are_written_as_the_configuration_has_them():
    assert write_initial({0: (1 + 0j, 0.1 + 0j), -3: (0j, 2 - 1j)}) == (
        '{"0": [1.0, 0.1], "-3": [0.0, "2-1j"]}'
    )


def test_outputs_include_both_ends_and_exact_integers():
    times = output_times(70.0, 0.025)
    assert len(times) == 2801
    np.testing.assert_array_equal(times[::40], np.arange(71))
    np.testing.assert_allclose(np.diff(times), 0.025, rtol=1e-11)
    assert output_times(3.0, 1 / 49)[49] == 1.0  # although 49 * (1 / 49) is not 1
