"""What a model conserves at every output, against plain NumPy, and on half of a chain."""

import numpy as np
import pytest
from dimers import DIMERS, model
from latticode.datasets.trajectories import trajectory_contents
from latticode.equations.model import Model, abs2, cos, lap, shift
from latticode.simulation.lattice import FULL_CHAIN
from latticode.simulation.problem import Problem
from latticode.simulation.simulate import simulate


def bonds(p, u):
    """Return a density that looks two sites to the right, and reads a parameter of the site."""
    return {"P": abs2(u), "bonds": p.k * abs2(shift(u, 2) - u) + p.w * abs2(u)}


def run(model, initial, boundary, cut=None, every=0, end_time=2.0):
    problem = Problem(
        model=model,
        half_width=initial.shape[1] // 2,
        boundary=boundary,
        initial=initial,
        end_time=end_time,
        output_step=0.25,
        snapshot_every=every,
        solver={"name": "taylor", "rtol": 1e-13, "atol": 1e-13},
    )
    return problem, simulate(problem, cut)


def random(fields, sites, even=False):
    rng = np.random.default_rng(fields)
    z = rng.normal(size=(fields, sites)) + 1j * rng.normal(size=(fields, sites))
    return z + z[:, ::-1] if even else z


@pytest.mark.parametrize("sites", [7, 25])
@pytest.mark.parametrize("boundary", ["dirichlet", "free", "periodic", "antiperiodic"])
def test_sums_are_those_of_numpy_at_every_output(boundary, sites):
    weights = np.cos(np.arange(sites))
    model = Model(
        fields="u",
        parameters={"k": 0.3, "w": lambda n: np.cos(n + sites // 2)},
        i_dt=lambda p, u: lap(u) + p.w * u,
        conserved=bonds,
    )
    _, trajectory = run(model, random(1, sites), boundary, every=1)
    u = trajectory.state[0, 0] + 1j * trajectory.state[1, 0]  # (site, snapshot)
    mode = {"dirichlet": "constant", "free": "symmetric"}.get(boundary, "wrap")
    wide = np.pad(u, [(2, 2), (0, 0)], mode)
    if boundary == "antiperiodic":
        wide[:2] *= -1.0
        wide[-2:] *= -1.0
    first = 0 if boundary == "dirichlet" else 2  # bonds to the sites at rest to the left count
    far = np.abs(wide[2 + first :] - wide[first:-2]) ** 2
    expected = 0.3 * far.sum(axis=0) + weights @ np.abs(u) ** 2
    np.testing.assert_allclose(trajectory.conserved["bonds"], expected, rtol=1e-12)
    np.testing.assert_allclose(trajectory.conserved["P"], (np.abs(u) ** 2).sum(axis=0), rtol=1e-13)
    np.testing.assert_allclose(trajectory.conserved["P"], trajectory.conserved["P"][0], rtol=1e-11)


@pytest.mark.parametrize("boundary", ["dirichlet", "free", "periodic"])
def test_half_of_an_even_chain_gives_the_bits_of_the_whole(boundary):
    initial = random(2, 21, even=True)
    full, half = (run(DIMERS, initial, boundary, cut)[1] for cut in (FULL_CHAIN, None))
    assert half.conserved["H"].tobytes() == full.conserved["H"].tobytes()
    np.testing.assert_allclose(half.conserved["H"], half.conserved["H"][0], rtol=1e-10)


def test_the_energy_with_the_drive_of_the_other_sign_is_not_conserved():
    _, trajectory = run(model(sign=1), random(2, 9), "dirichlet")
    assert np.ptp(trajectory.conserved["H"]) > 1.0


def test_the_energy_of_real_fields_is_kept_with_their_velocities():
    model = Model(
        fields="x",
        parameters={},
        d2_dt2=lambda p, x: lap(x) - x * x * x,
        conserved=lambda p, x, v: {
            "H": 0.5 * v * v + 0.5 * (x.right - x) * (x.right - x) + 0.25 * x * x * x * x
        },
    )
    _, trajectory = run(model, random(1, 11).real.astype(complex), "free")
    np.testing.assert_allclose(trajectory.conserved["H"], trajectory.conserved["H"][0], rtol=1e-11)


def test_the_dataset_of_a_run_has_them_at_every_output_without_snapshots():
    model = Model(
        fields="u", parameters={}, i_dt=lambda p, u: lap(u), conserved=lambda p, u: {"P": abs2(u)}
    )
    problem, trajectory = run(model, random(1, 5), "free")
    conserved = trajectory_contents("one", problem, trajectory)[0]["conserved"]
    assert conserved.dimensions == ("conserved_quantity", "tau")
    np.testing.assert_array_equal(conserved.values, [trajectory.conserved["P"]])


def test_a_density_has_the_functions_of_the_kernels():
    model = Model(
        fields="x", parameters={}, d2_dt2=lambda p, x: -1 * x, conserved=lambda p, x: {"c": cos(x)}
    )
    _, trajectory = run(model, random(1, 9).real.astype(complex), "free", every=1)
    np.testing.assert_allclose(
        trajectory.conserved["c"], np.cos(trajectory.state[0, 0]).sum(axis=0), rtol=1e-13
    )
