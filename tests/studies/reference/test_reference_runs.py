"""How references are made: the equations once more, decimals, precision, and what goes wrong."""

import sys
from pathlib import Path

import numpy as np
import pytest
from helpers import chosen, package
from latticode.datasets.netcdf import as_xarray, read
from latticode.simulation.lattice import Reduction, pack
from oracle import hamiltonian, random_chain, slope
from pendula.studies.reference import multiprecision
from pendula.studies.reference.multiprecision import HEYOKA, HeyokaMissingError, Numbers
from pendula.studies.reference.verified_run import (
    LIMIT,
    Run,
    UnverifiedError,
    compare,
    reference_contents,
    require_agreement,
)
from problems import problem_of

ROOT = Path(__file__).resolve().parents[3]
HALF = Reduction(even=True, synchronised=False)
NUMBERS = (0.7, 1.3, -4.0)


def rows_of(z):
    """Return the state (row, site) of the right half of an even chain (2, N)."""
    return pack(z, HALF)[:, 1:-1]


def made_up(bits, shift=0.0):
    """Return a run in doubles whose l2 norm is off by `shift` at the last of three times."""
    series, state = np.ones((2, 3)), np.ones((1, 4, 5))
    l2 = series + np.array([0.0, 0.0, shift])
    times = np.array([0.0, 0.5, 1.0])
    return Run(times, series, l2, times, times[:1], state, bits, 40, 2.0**-bits, 7)


@pytest.mark.parametrize("half_width", [0, 1, 2, 7])
def test_norms_and_energy_are_those_of_the_whole_chain(half_width):
    chains = [random_chain(half_width, even=True, seed=seed) for seed in range(3)]
    states = np.array([rows_of(z) for z in chains])
    linf, l2 = multiprecision.norms(states)
    np.testing.assert_allclose(linf.T, [np.abs(z).max(axis=1) for z in chains], rtol=1e-14)
    np.testing.assert_allclose(l2.T, [np.linalg.norm(z, axis=1) for z in chains], rtol=1e-14)
    energies = multiprecision.energy(multiprecision.RealConstants(*NUMBERS), states)
    exact = [hamiltonian(z, NUMBERS, "dirichlet") for z in chains]
    np.testing.assert_allclose(energies, exact, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("shift", [2 * LIMIT, np.nan])
def test_runs_that_part_are_refused_with_the_time(shift):
    run, check = made_up(192), made_up(176, shift)
    with pytest.raises(UnverifiedError, match=r"fig9: runs of 192 and 176 bits.* tau = 1 on"):
        require_agreement("fig9", run, check, compare(run, check))
    require_agreement("fig9", run, run, compare(run, run))


def test_without_heyoka_the_message_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "heyoka", None)
    with pytest.raises(HeyokaMissingError, match=HEYOKA):
        reference_contents("x", problem_of(), [1], (64, 80), True)


def test_a_parameter_is_the_decimal_that_is_printed():
    heyoka = package("heyoka", HEYOKA)
    tenth = Numbers(200).given(0.1)
    assert tenth * 10 == 1 and tenth == heyoka.real("0.1", 200)
    assert Numbers(200, decimal=False).given(0.1) == heyoka.real(0.1, 200) != tenth


@pytest.mark.parametrize("half_width", [0, 1, 6])
def test_the_equations_are_those_of_the_oracle(half_width):
    heyoka = package("heyoka", HEYOKA)
    z, constants = random_chain(half_width, even=True), multiprecision.RealConstants(*NUMBERS)
    pairs = multiprecision.right_hand_side(heyoka, constants, half_width)
    variables, rates = zip(*pairs, strict=True)
    values = heyoka.cfunc(rates, variables, compact_mode=True)(rows_of(z).ravel())
    exact = rows_of(slope(z, NUMBERS, "dirichlet"))
    np.testing.assert_allclose(values.reshape(4, -1), exact, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("case", ["fig2_small", "fig4_small"])
def test_a_short_run_made_again_gives_the_same_doubles(case):
    package("heyoka", HEYOKA)
    given = [0.31, 1, 2], chosen("reference").bits[case], True
    again = as_xarray(*reference_contents(case, problem_of(case), *given))
    kept = read(ROOT / f"tests/baseline/reference/{case}.nc")
    np.testing.assert_array_equal(again["snapshot_tau"], [1])
    np.testing.assert_array_equal(again["amplitude"], kept["amplitude"][..., :1])
    for name in ("linf", "l2", "energy"):
        np.testing.assert_array_equal(again[name], kept[name].sel(tau=slice(0, 1)))
    assert again["discrepancy"].max() < 1e-30
