"""The committed references, against solvers and integer arithmetic that know nothing of heyoka."""

import json
from functools import cache
from pathlib import Path

import fixed_point
import numpy as np
import pytest
from helpers import chosen
from latticode.datasets.netcdf import read
from latticode.simulation.simulate import simulate
from oracle import CASES, hamiltonian
from pendula.studies.reference.verified_run import LIMIT
from problems import problem_of

FOLDER = Path(__file__).resolve().parents[2] / "baseline/reference"
NAMES = [*CASES, "fig4_small.double"]


@cache
def reference(name):
    return read(FOLDER / f"{name}.nc")


def amplitudes(name, tau):
    """Return the complex amplitudes (2, 61) of a snapshot."""
    data = reference(name)
    re, im = data["amplitude"].values[..., list(data["snapshot_tau"]).index(tau)]
    return re + 1j * im


@pytest.mark.parametrize("name", NAMES)
def test_both_runs_agree_and_the_energy_is_constant(name):
    data, case = reference(name), name.removesuffix(".double")
    assert np.all(data["discrepancy"] < LIMIT)
    assert data.attrs["largest_discrepancy"] == data["discrepancy"].values.max()
    assert np.all(data["amplitude_discrepancy"] < LIMIT)
    assert np.all(data["energy"] == data["energy"][0])
    assert data.attrs["energy_drift"] < LIMIT
    omega, pair = CASES[case]
    exact = hamiltonian(np.array(pair, complex)[:, None], (1, 1, omega), "dirichlet")
    assert data["energy"][0] == pytest.approx(exact, rel=4e-16)


@pytest.mark.parametrize("name", NAMES)
def test_the_data_start_as_the_paper_says_in_runs_of_the_declared_bits(name):
    data, case = reference(name), name.removesuffix(".double")
    omega, pair = CASES[case]
    for norm in ("linf", "l2"):
        np.testing.assert_array_equal(data[norm][:, 0], pair)
    assert json.loads(data.attrs["initial"]) == {"0": list(pair)}
    found = [data.attrs[key] for key in ("epsilon", "gamma", "omega", "half_width", "boundary")]
    assert found == [1, 1, omega, 30, "dirichlet"]
    runs = (data.attrs["solver_bits"], data.attrs["second_run_bits"])
    assert runs == chosen("reference").bits[case]
    assert data["tau"][-1] == (70 if case in ("fig2_large", "fig3_large") else 50)


@pytest.mark.parametrize("name", NAMES)
def test_snapshots_have_the_norms_of_their_time(name):
    data = reference(name)
    np.testing.assert_array_equal(data["amplitude"], data["amplitude"][:, :, ::-1])
    for tau in data["snapshot_tau"].values:
        moduli, there = np.abs(amplitudes(name, tau)), data.sel(tau=tau)
        np.testing.assert_allclose(moduli.max(axis=1), there["linf"], rtol=1e-15)
        np.testing.assert_allclose(np.sqrt((moduli**2).sum(axis=1)), there["l2"], rtol=1e-15)


@pytest.mark.parametrize("solver", ["taylor", "dop853"])
@pytest.mark.parametrize("case", CASES)
def test_our_solvers_agree_while_doubles_suffice(case, solver):
    tight = {"name": solver, "rtol": 1e-14, "atol": 1e-14}
    run = simulate(problem_of(case, end_time=5.0, solver=tight))
    data = reference(case).sel(tau=slice(0, 5))
    np.testing.assert_allclose(data["linf"], run.linf, rtol=0, atol=1e-9)
    np.testing.assert_allclose(data["l2"], run.l2, rtol=0, atol=1e-9)
    np.testing.assert_allclose(amplitudes(case, 5), run.final, rtol=0, atol=1e-9)


@pytest.mark.parametrize("case", CASES)
def test_integer_arithmetic_gives_the_same_doubles(case):
    small = case.endswith("small")
    pair = ("1", "0.1") if small else ("5", "1")
    fine = {"steps_per_unit": 20, "order": 24} if small else {"steps_per_unit": 40, "order": 32}
    z = fixed_point.integrate(pair, int(CASES[case][0]), 1, **fine)
    np.testing.assert_array_equal(z[:, 10:19], amplitudes(case, 1)[:, 26:35])
    there = reference(case).sel(tau=1)
    np.testing.assert_allclose(np.linalg.norm(z, axis=1), there["l2"], rtol=1e-15)
    np.testing.assert_allclose(np.abs(z).max(axis=1), there["linf"], rtol=1e-15)


def test_one_tenth_and_the_double_beside_it_part_after_tau_26():
    """They start 5.6e-18 apart; the norms differ by 1e-12 at tau = 11, by one at tau = 29."""
    decimal, double = reference("fig4_small"), reference("fig4_small.double")
    apart = np.abs(decimal["l2"] - double["l2"]).max("component")
    assert np.all(apart.sel(tau=slice(0, 5)) < 1e-12)
    first = float(apart["tau"][apart > 1e-2][0])
    assert 26 < first < 27
    assert apart.sel(tau=slice(30, 50)).max() > 1
