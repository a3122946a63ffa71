"""(4) as the replication runs it: beside the same model in the library, and what it adds to that.

The library holds its own runs of the model to the laws of the equations. Runs here have the same
bits, but for `delfour_fortin_payre`, `ode45_real`, the energy (8), and one component where A = B.
"""

import itertools

import numpy as np
import plain
import pytest
from dimers import METHODS, chain
from hypothesis import given, settings
from latticode.simulation.lattice import FULL_CHAIN, Reduction, choose_ends, pack, unpack
from latticode.simulation.simulate import simulate
from oracle import (
    BOUNDARIES,
    SOLVERS,
    boundaries,
    chains,
    constants,
    hamiltonian,
    random_chain,
    slope,
)
from pendula.models.amplitudes import AmplitudeChain, energy, field, rates
from problems import PAPER, make_problem

CONSTANTS = (0.7, 1.3, -2.1)
REDUCTIONS = [Reduction(even, same) for even in (False, True) for same in (False, True)]
DRIFTS = {"ode45": 1e-3, "ode45_real": 1e-3, "delfour_fortin_payre": 1e-9}
each_boundary = pytest.mark.parametrize("boundary", BOUNDARIES)
some = settings(max_examples=20)


def run(name, z, numbers=PAPER, boundary="dirichlet", reduction=FULL_CHAIN, **changes):
    return simulate(
        make_problem(z, numbers, boundary, name, snapshot_every=1, **changes), reduction
    )


def assert_same_bits(run, expected, *names):
    for name in names:
        np.testing.assert_array_equal(getattr(run, name), getattr(expected, name), err_msg=name)


@each_boundary
@pytest.mark.parametrize("name", METHODS)
def test_runs_have_the_bits_of_the_same_model_in_the_library(name, boundary):
    """On a short chain, and on one that goes in tiles and waves."""
    for half_width, end in ((4, 1.0), (550, 0.05)):
        z, times = random_chain(half_width), {"end_time": end, "output_step": end}
        trajectory = run(name, z, CONSTANTS, boundary, **times)
        expected = simulate(chain(z, CONSTANTS, boundary, name, **times), FULL_CHAIN)
        assert_same_bits(trajectory, expected, "final", "linf", "l2", "outcome")


@each_boundary
def test_rates_and_energy_are_equations_4_and_8(boundary):
    cases = itertools.product([1, 2, 4, 7, 8], REDUCTIONS)
    for half_width, reduction in [(0, FULL_CHAIN), *cases]:
        z = random_chain(half_width, **reduction._asdict())
        numbers = AmplitudeChain(*CONSTANTS, *choose_ends(boundary, reduction))
        y = pack(z, reduction)
        dy = np.zeros_like(y)
        rates(numbers, y, dy)
        computed, where = unpack(dy, reduction), f"{half_width} {reduction}"
        np.testing.assert_allclose(
            computed, slope(z, CONSTANTS, boundary), 1e-13, 1e-13, err_msg=where
        )
        assert energy(numbers, y) == pytest.approx(hamiltonian(z, CONSTANTS, boundary), rel=1e-13)


@given(z=chains(), numbers=constants, boundary=boundaries)
@some
def test_energy_is_conserved_and_exchange_of_a_and_b_exchanges_the_bits(z, numbers, boundary):
    for name, drift in DRIFTS.items():
        straight, exchanged = (run(name, data, numbers, boundary) for data in (z, z[::-1]))
        energy = straight.conserved["energy"]
        assert np.abs(energy - energy[0]).max() < drift * max(1.0, np.abs(energy[0])), name
        np.testing.assert_array_equal(exchanged.final, straight.final[::-1], err_msg=name)


def test_the_function_of_the_field_takes_plain_numbers_and_is_equation_4():
    system, values = AmplitudeChain(*PAPER, 0, 0), np.random.default_rng(3).normal(size=(2, 2, 3))
    re, im = field(system, lambda component, part, by: values[component, part, 1 + by])
    a, b = values[:, 0] + 1j * values[:, 1]
    coupling = PAPER[0] * (a[2] - 2 * a[1] + a[0]) + PAPER[2] * a[1]
    drive = PAPER[1] * np.conj(b[1] - a[1])
    expected = coupling + drive + 0.5 * abs(a[1]) ** 2 * a[1]
    np.testing.assert_allclose([re, im], [expected.real, expected.imag], rtol=1e-13)


def test_ode45_of_real_unknowns_takes_the_published_steps():
    rtol, z, times, numbers = 1e-5, 2 * random_chain(3), np.linspace(0.0, 4.0, 3), (0.7, 1.3, -4.0)

    def rates_of_parts(x):
        u = slope(x[0] + 1j * x[1], numbers, "free")
        return np.stack([u.real, u.imag])

    components = np.stack([z.real, z.imag])
    final, steps, rejected = plain.ode45(rates_of_parts, components, times, rtol, 1e-2 * rtol)
    solver = {"name": "ode45_real", "rtol": rtol, "atol": 1e-2 * rtol}
    changes = {"end_time": 4.0, "output_step": 2.0}
    trajectory = run(solver, z, numbers, "free", **changes)
    assert (trajectory.outcome.steps, trajectory.outcome.rejected) == (steps, rejected)
    np.testing.assert_allclose(trajectory.final, final[0] + 1j * final[1], atol=1e-8)


def mean_slope(old, new, numbers, boundary):
    """Return the mean right-hand side of Delfour, Fortin and Payre over a step."""
    middle, mean_square = (old + new) / 2, (np.abs(old) ** 2 + np.abs(new) ** 2) / 2
    return slope(middle, numbers, boundary) + 0.5j * (np.abs(middle) ** 2 - mean_square) * middle


@each_boundary
def test_a_step_of_delfour_fortin_and_payre_solves_their_equation(boundary):
    z, h = random_chain(3), 0.05
    solver = SOLVERS["delfour_fortin_payre"] | {"step": h}
    new = run(solver, z, boundary=boundary, end_time=h, output_step=h).final
    np.testing.assert_allclose(new, z + h * mean_slope(z, new, PAPER, boundary), atol=1e-13)
