"""The committed references, against solvers and integer arithmetic that know nothing of heyoka."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest
from helpers import chosen
from latticode.datasets.netcdf import read
from latticode.simulation.simulate import simulate
from oracle import CASES, hamiltonian
from pendula.studies.certified import fixed_point
from pendula.studies.reference.verified_run import LARGEST_DISCREPANCY
from problems import problem_of

FOLDER = Path(__file__).resolve().parents[2] / "baseline/reference"


@cache
def reference(name):
    return read(FOLDER / f"{name}.nc")


def amplitudes(name, tau):
    """Return the complex amplitudes (2, 61) of a snapshot."""
    data = reference(name)
    re, im = data["amplitude"].values[..., list(data["snapshot_tau"]).index(tau)]
    return re + 1j * im


@pytest.mark.parametrize("case", CASES)
def test_both_runs_agree_from_the_papers_data_and_the_energy_is_constant(case):
    data, (omega, pair) = reference(case), CASES[case]
    assert np.all(data["discrepancy"] < LARGEST_DISCREPANCY) and np.all(
        data["amplitude_discrepancy"] < LARGEST_DISCREPANCY
    )
    exact = hamiltonian(np.array(pair, complex)[:, None], (1, 1, omega), "dirichlet")
    for tau in data["snapshot_tau"].values:
        computed = hamiltonian(amplitudes(case, tau), (1, 1, omega), "dirichlet")
        assert computed == pytest.approx(exact, rel=1e-12)
    for norm in ("linf", "l2"):
        np.testing.assert_array_equal(data[norm][:, 0], pair)
    computed = [data.attrs[key] for key in ("epsilon", "gamma", "omega", "half_width", "boundary")]
    assert computed == [1, 1, omega, 30, "dirichlet"]
    runs = (data.attrs["solver_bits"], data.attrs["second_run_bits"])
    assert runs == chosen("reference").bits[case]
    assert data["tau"][-1] == (70 if case in ("fig2_large", "fig3_large") else 50)


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
    """To tau = 1 the sites 0..4 are those of a longer chain to 1e-22."""
    problem = problem_of(case, half_width=14)
    chain = fixed_point.make_half_chain(problem, 128)
    steps = fixed_point.generate_steps(fixed_point.round_initial_data(problem, chain)[0], chain, 32)
    last = [next(steps)[-1] for _ in problem.times[1:]][-1]
    exact = np.array(fixed_point.evaluate_end(last.terms), object) / 2**chain.bits
    re, im = exact.astype(float).reshape(2, 2, -1)
    np.testing.assert_array_equal((re + 1j * im)[:, :5], amplitudes(case, 1)[:, 30:35])
