"""A long state taken in tiles: each site owned once, and the bits those of one piece."""

import numpy as np
import pytest
from dimers import Pairs, rates
from hypothesis import given
from hypothesis import strategies as st
from latticode.equations.ends import DIRICHLET
from latticode.generation.chain import can_be_tiled
from latticode.integrators import DONE, dop853, tiles
from latticode.kernels.compiled import kernel
from latticode.simulation.lattice import Reduction, choose_ends, pack
from latticode.simulation.observables import blank_record, observe_moduli

TIMES = np.linspace(0.0, 4.0, 81)  # enough steps that some pass narrowly


@kernel
def observe(pairs, y, i, record):
    observe_moduli(pairs, y, i, record)


@kernel
def pairs_of_tile(pairs, is_first, is_last):
    """Return the pairs as a tile sees them: at rest beyond its margins."""
    left = pairs.left if is_first else DIRICHLET
    right = pairs.right if is_last else DIRICHLET
    return Pairs(pairs.epsilon, pairs.gamma, pairs.omega, left, right)


solve_in_one = dop853.build(rates, observe)
solve_in_tiles = dop853.build(rates, observe, can_be_tiled, pairs_of_tile)


@kernel
def run_in_one(pairs, y, times, controls, work, record, stop):
    return solve_in_one(pairs, y, times, controls, work, record, stop)


@kernel
def run_in_tiles(pairs, y, times, controls, work, record, stop):
    return solve_in_tiles(pairs, y, times, controls, work, record, stop)


def run(method, z, boundary, even, times=TIMES, every=20):
    """Return all that a run makes of data (2, N), as arrays and counts."""
    reduction = Reduction(even=even, synchronised=False)
    pairs = Pairs(1.0, 1.0, -4.0, *choose_ends(boundary, reduction))
    y = pack(z, reduction)
    record = blank_record(2, y.shape[1] - 2, times.size, every)
    work = np.zeros((dop853.WORK, *y.shape))
    outcome = method(pairs, y, times, (1e-9, 1e-9), work, record, np.zeros(1, np.bool_))
    assert outcome.status == DONE
    return (y[:, 1:-1], record.l2, record.linf, record.snapshots), outcome


def compared(*arguments):
    """Compare a run in tiles with one in one piece; return what is kept of it, and its counts."""
    tiled, counts = run(run_in_tiles, *arguments)
    in_one, expected = run(run_in_one, *arguments)
    assert counts == expected
    for left, right in zip(tiled, in_one, strict=True):
        np.testing.assert_array_equal(left, right)
    return in_one[-1], counts


# A ring must be taken in one piece: in tiles it would lose the neighbours across its seam. Half of
# an even ring has the ends of half of a free chain.
CHAINS = [(boundary, False) for boundary in ("dirichlet", "free", "periodic")]
CHAINS += [(boundary, True) for boundary in ("dirichlet", "free")]


@pytest.mark.parametrize("strength", [(2.0, 2.0), (0.0, 3.0)], ids=["level", "rising"])
@pytest.mark.parametrize(("boundary", "even"), CHAINS)
def test_tiles_give_the_bits_of_one_piece(boundary, even, strength):
    half = 2 * tiles.LONGEST // (1 if even else 2)  # three tiles
    rng = np.random.default_rng(5)
    right = rng.normal(size=(2, half + 1)) + 1j * rng.normal(size=(2, half + 1))
    right *= np.linspace(*strength, half + 1)
    amplitudes = np.concatenate([right[:, :0:-1], right], axis=1)
    assert compared(amplitudes, boundary, even)[1].rejected > 0


@pytest.mark.parametrize("distance", [15, 16])
def test_a_site_at_the_end_of_the_margin_is_felt_by_the_last_stage(distance):
    """Of data on one site a stage carries a trace to the next one, however small.

    The interpolant at the last site of a tile sees as far as all 16 stages look, which is what the
    margin is for; data everywhere would hide the trace in their rounding. The tile is the second
    of three, for those at the ends of a chain have both margins on one side.
    """
    first, last = tiles.LONGEST, 2 * tiles.LONGEST - 1
    amplitudes = np.zeros((2, 3 * tiles.LONGEST), complex)
    amplitudes[:, last + distance] = 1.0, 0.5j
    amplitudes[:, first - distance] = 0.3j, -1.0
    moduli, _ = compared(amplitudes, "dirichlet", False, np.linspace(0.0, 0.2, 41), 1)
    assert (moduli[:, [first, last], 1:] > 0.0).all()


def test_tiles_at_rest_give_the_bits_of_one_piece():
    amplitudes = np.zeros((2, 5 * tiles.LONGEST), complex)
    amplitudes[:, tiles.LONGEST - 40] = 1.0, 0.5j
    moduli, counts = compared(amplitudes, "dirichlet", False)
    assert counts.steps > 20
    moving = np.flatnonzero(moduli[..., -1].any(axis=0))
    assert moving[-1] > tiles.LONGEST  # it entered a tile that was at rest
    assert moving[-1] < 3 * tiles.LONGEST


@given(sites=st.integers(1, 5 * tiles.LONGEST))
def test_every_site_is_owned_once_and_well_inside(sites):
    count = tiles.count_tiles(sites)
    held, owner = tiles.tile_length(sites, count), np.zeros(sites, int)
    for tile in range(count):
        left, first, stop = tiles.tile_place(tile, count, sites)
        assert stop - first <= tiles.LONGEST
        assert left == 0 or first - left >= tiles.MARGIN
        assert left + held == sites or left + held - stop >= tiles.MARGIN
        owner[first:stop] += 1
    np.testing.assert_array_equal(owner, 1)
