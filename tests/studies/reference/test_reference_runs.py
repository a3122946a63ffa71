"""How references are made: the equations once more, precision, and what goes wrong."""

import sys
from pathlib import Path

import numpy as np
import pytest
from helpers import chosen, package
from latticode.datasets.netcdf import as_xarray, read
from latticode.simulation.lattice import Reduction, pack
from oracle import random_chain, slope
from pendula.studies.reference import verified_run
from pendula.studies.reference.verified_run import HEYOKA, LARGEST_DISCREPANCY, UnverifiedError
from problems import problem_of

ROOT = Path(__file__).resolve().parents[3]
NUMBERS = (0.7, 1.3, -4.0)


def rows_of(z):
    """Return the state (row, site) of the right half of an even chain (2, N)."""
    return pack(z, Reduction(even=True, synchronised=False))[:, 1:-1]


@pytest.mark.parametrize("half_width", [0, 1, 7])
def test_norms_are_those_of_the_whole_chain(half_width):
    z = random_chain(half_width, even=True)
    linf, l2 = verified_run.compute_norms(rows_of(z)[None])
    np.testing.assert_allclose(linf[:, 0], np.abs(z).max(axis=1), rtol=1e-14)
    np.testing.assert_allclose(l2[:, 0], np.linalg.norm(z, axis=1), rtol=1e-14)


@pytest.mark.parametrize("shift", [2 * LARGEST_DISCREPANCY, np.nan])
def test_runs_that_part_are_refused_with_the_time(shift):
    times, series = np.array([0.0, 0.5, 1.0]), np.ones((2, 3))
    snapshots = (series, times[:1], np.ones((1, 4, 5)))
    run = verified_run.MultiprecisionRun(times, series, *snapshots, {"bits": 192})
    check = run._replace(l2=series + np.array([0.0, 0.0, shift]), controls={"bits": 176})
    with pytest.raises(UnverifiedError, match=r"fig9: runs of 192 and 176 bits.* tau = 1 on"):
        verified_run.measure_discrepancy("fig9", run, check)
    assert not np.any(verified_run.measure_discrepancy("fig9", run, run)[0])


def test_without_heyoka_the_message_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "heyoka", None)
    with pytest.raises(UnverifiedError, match=HEYOKA):
        verified_run.load_heyoka()


@pytest.mark.parametrize("half_width", [0, 1, 6])
def test_the_equations_are_those_of_the_oracle(half_width):
    heyoka = package("heyoka", HEYOKA)
    z, constants = random_chain(half_width, even=True), verified_run.RealConstants(*NUMBERS)
    pairs = verified_run.right_hand_side(heyoka, constants, half_width)
    variables, rates = zip(*pairs, strict=True)
    values = heyoka.cfunc(rates, variables, compact_mode=True)(rows_of(z).ravel())
    exact = rows_of(slope(z, NUMBERS, "dirichlet"))
    np.testing.assert_allclose(values.reshape(4, -1), exact, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("case", ["fig2_small", "fig4_small"])
def test_a_short_run_made_again_gives_the_same_doubles(case):
    heyoka = package("heyoka", HEYOKA)
    assert (
        verified_run.decimal_as_real(0.1, 200) == heyoka.real("0.1", 200) != heyoka.real(0.1, 200)
    )
    recomputed = as_xarray(
        *verified_run.make_reference(
            case, problem_of(case), [0.31, 1, 2], chosen("reference").bits[case]
        )
    )
    committed = read(ROOT / f"tests/baseline/reference/{case}.nc")
    np.testing.assert_array_equal(recomputed["snapshot_tau"], [1])
    np.testing.assert_array_equal(recomputed["amplitude"], committed["amplitude"][..., :1])
    for name in ("linf", "l2"):
        np.testing.assert_array_equal(recomputed[name], committed[name].sel(tau=slice(0, 1)))
    assert recomputed["discrepancy"].max() < 1e-30
