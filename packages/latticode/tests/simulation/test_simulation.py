"""Laws of the equations, kept by every solver at every end of the chain, and faults of a run."""

import numpy as np
import pytest
from dimers import PAPER, SOLVERS, chain
from hypothesis import given, settings
from latticode.equations.initial_values import on_sites
from latticode.simulation.lattice import FULL_CHAIN, Reduction
from latticode.simulation.simulate import IntegrationError, simulate
from oracle import BOUNDARIES, boundaries, chains, constants, random_chain

CLOSE = {"ode45": 1e-4, "dop853": 1e-8, "taylor": 1e-8, "crank_nicolson": 1e-8}
"""How close runs are over a unit of time, worst case."""
TOLERANCES = CLOSE | {"crank_nicolson": 5e-2}
"""How well norms are kept that the equations keep: the trapezoidal rule keeps them nearly only."""
DRIFTS = {"ode45": 1e-3, "dop853": 1e-9, "taylor": 1e-9}
"""How well the energy is kept, relative to it where it is above one."""
EVEN = Reduction(even=True, synchronised=False)
each_solver = pytest.mark.parametrize("name", SOLVERS)
each_boundary = pytest.mark.parametrize("boundary", BOUNDARIES)
some = settings(max_examples=20)


def run(name, z, numbers=PAPER, boundary="dirichlet", reduction=FULL_CHAIN, **times):
    """Integrate z with the named solver and keep every output's moduli."""
    return simulate(chain(z, numbers, boundary, name, snapshot_every=1, **times), reduction)


def energy_of(trajectory):
    return trajectory.conserved["H"]


def assert_same_bits(name, run, expected_run):
    for field in ("final", "linf", "l2", "modulus"):
        values, expected = getattr(run, field), getattr(expected_run, field)
        np.testing.assert_array_equal(values, expected, err_msg=f"{name}: {field}")
    np.testing.assert_array_equal(energy_of(run), energy_of(expected_run), err_msg=name)


@given(z=chains(widths=(1, 4), even=True), numbers=constants, boundary=boundaries)
@some
def test_half_of_an_even_chain_has_the_bits_of_the_whole(z, numbers, boundary):
    for name in SOLVERS:
        half, full = (run(name, z, numbers, boundary, cut) for cut in (EVEN, FULL_CHAIN))
        assert_same_bits(name, half, full)
        assert half.outcome == full.outcome


@given(z=chains(synchronised=True), numbers=constants, boundary=boundaries)
@some
def test_where_a_equals_b_they_stay_so_and_keep_their_norm(z, numbers, boundary):
    for name in SOLVERS:
        trajectory = run(name, z, numbers, boundary)
        np.testing.assert_array_equal(trajectory.final[0], trajectory.final[1], err_msg=name)
        assert_norms_are_kept(name, trajectory.l2)


def assert_norms_are_kept(name, l2):
    np.testing.assert_allclose(l2 - l2[:, :1], 0.0, atol=TOLERANCES[name], err_msg=name)


@each_solver
@each_boundary
def test_chaos_breaks_no_symmetry(name, boundary):
    """Neither evenness, nor A = B where the difference of A and B is unstable."""
    times = {"end_time": 30.0, "output_step": 1.0}
    even = run(name, random_chain(6, even=True), (1.0, 1.0, 0.0), boundary, **times).final
    np.testing.assert_array_equal(even, even[:, ::-1])
    same = run(name, random_chain(6, synchronised=True), (1.0, 3.0, 0.0), boundary, **times).final
    np.testing.assert_array_equal(same[0], same[1])


@given(z=chains(), numbers=constants, boundary=boundaries)
@some
def test_exchange_of_a_and_b_exchanges_the_bits(z, numbers, boundary):
    for name in SOLVERS:
        straight, exchanged = (run(name, data, numbers, boundary) for data in (z, z[::-1]))
        np.testing.assert_array_equal(exchanged.final, straight.final[::-1], err_msg=name)
        np.testing.assert_array_equal(exchanged.l2, straight.l2[::-1], err_msg=name)


@given(z=chains(widths=(0, 2)), numbers=constants, boundary=boundaries)
@some
def test_conjugation_reverses_time(z, numbers, boundary):
    for name in SOLVERS:
        final = run(name, z, numbers, boundary).final
        back = np.conj(run(name, np.conj(final), numbers, boundary).final)
        np.testing.assert_allclose(back, z, atol=CLOSE[name], err_msg=name)


@given(z=chains(), numbers=constants, boundary=boundaries)
@some
def test_without_drive_both_norms_are_conserved(z, numbers, boundary):
    for name in SOLVERS:
        assert_norms_are_kept(name, run(name, z, (numbers[0], 0.0, numbers[2]), boundary).l2)


@given(z=chains(), numbers=constants, boundary=boundaries)
@some
def test_energy_is_conserved(z, numbers, boundary):
    for name, drift in DRIFTS.items():
        energy = energy_of(run(name, z, numbers, boundary))
        assert np.abs(energy - energy[0]).max() < drift * max(1.0, np.abs(energy[0])), name


@each_solver
def test_even_data_cannot_tell_free_ends_from_a_ring(name):
    z = random_chain(4, even=True)
    free, ring = (run(name, z, boundary=boundary) for boundary in ("free", "periodic"))
    np.testing.assert_array_equal(free.final, ring.final)
    np.testing.assert_allclose(energy_of(free), energy_of(ring), rtol=1e-12)


@pytest.mark.parametrize(("boundary", "bonds"), [("dirichlet", 2), ("free", 0), ("periodic", 0)])
@pytest.mark.parametrize(("half_width", "epsilon"), [(0, 0.7), (3, 0.0)])
def test_undriven_pairs_without_bonds_rotate_at_known_rates(half_width, epsilon, boundary, bonds):
    z, omega = random_chain(half_width), -2.1
    rate = omega - bonds * epsilon + 0.5 * np.abs(z) ** 2
    final = run("dop853", z, (epsilon, 0.0, omega), boundary).final
    np.testing.assert_allclose(final, z * np.exp(-1j * rate), rtol=1e-9)


def test_simulate_gives_components_sites_and_times():
    data = on_sites({0: (1, 0.5j), 1: (0, 2)})
    trajectory = simulate(chain(data, boundary="free", half_width=2, snapshot_every=2))
    np.testing.assert_array_equal(trajectory.tau, [0, 0.25, 0.5, 0.75, 1])
    assert trajectory.linf.shape == trajectory.l2.shape == (2, 5)
    assert trajectory.modulus.shape == (2, 5, 3)
    np.testing.assert_array_equal(trajectory.modulus[:, :, 0], [[0, 0, 1, 0, 0], [0, 0, 0.5, 2, 0]])
    np.testing.assert_allclose(trajectory.modulus[:, :, -1], np.abs(trajectory.final), rtol=1e-12)
    np.testing.assert_allclose(trajectory.linf[:, 0], [1, 2], rtol=1e-15)


@each_solver
def test_data_that_cannot_be_integrated_end_in_an_error(name):
    for value in (np.nan, np.inf, complex(0, np.nan), 1e100, 1e200):
        z = random_chain(2)
        z[1, 3] = value
        with pytest.raises(IntegrationError, match=rf"^{name} stopped at t = 0: the "):
            run(name, z)


@each_solver
@pytest.mark.parametrize(("half_width", "end"), [(3, 1.0), (550, 0.05)])
def test_a_ring_has_no_first_site(name, half_width, end):
    """On a long one, ends that are open would show where a chain is divided for the cache."""
    z, times = random_chain(half_width), {"end_time": end, "output_step": end}
    straight, turned = (
        run(name, data, boundary="periodic", **times).final for data in (z, np.roll(z, 2, axis=1))
    )
    np.testing.assert_array_equal(turned, np.roll(straight, 2, axis=1))
