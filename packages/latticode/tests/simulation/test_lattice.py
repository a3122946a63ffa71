"""From amplitudes to the state of a run and back, and what a run keeps of its states."""

from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from latticode.kernels.compiled import kernel
from latticode.simulation.lattice import (
    FULL_CHAIN,
    Reduction,
    choose_ends,
    find_reduction,
    pack,
    unpack,
)
from latticode.simulation.observables import blank_record, observe_moduli
from oracle import chains, random_chain

REDUCTIONS = [Reduction(even, same) for even in (False, True) for same in (False, True)]
each_reduction = pytest.mark.parametrize("reduction", REDUCTIONS)


# --- Symmetries ---------------------------------------------------------------------------------


@each_reduction
def test_symmetries_are_found(reduction):
    assert find_reduction(random_chain(3, **reduction._asdict())) == reduction
    assert not find_reduction(random_chain(0)).even


@given(st.integers(0, 6), st.integers(0, 1), st.booleans())
def test_the_last_bit_of_any_part_breaks_a_symmetry(site, component, imaginary):
    z = random_chain(3, even=True, synchronised=True)
    values = z.imag if imaginary else z.real
    values[component, site] = np.nextafter(values[component, site], np.inf)
    centre = site == 3  # a change at the centre leaves the data even
    assert find_reduction(z) == Reduction(even=centre, synchronised=False)


# --- The state ----------------------------------------------------------------------------------


@given(st.data(), st.sampled_from(REDUCTIONS))
def test_a_state_is_as_small_as_the_symmetries_allow_and_gives_the_amplitudes_back(data, reduction):
    z = data.draw(chains(widths=(1, 4), **reduction._asdict()))
    y = pack(z, reduction)
    sites = z.shape[1] // 2 + 1 if reduction.even else z.shape[1]
    assert y.shape == (2 if reduction.synchronised else 4, sites + 2)
    np.testing.assert_array_equal(unpack(y, reduction), z)


# --- What is kept of a state --------------------------------------------------------------------


class Ends(NamedTuple):
    left: int
    right: int


@kernel
def observe(ends, y, i, record):
    observe_moduli(ends, y, i, record)


def observed(z, reduction=FULL_CHAIN, times=1, i=0, every=1):
    """Return the record of an output; all other outputs of the record are -1."""
    y = pack(z, reduction)
    record = blank_record(y.shape[0] // 2, y.shape[1] - 2, times, every)
    for values in (record.linf, record.l2, record.snapshots):
        values.fill(-1.0)
    observe(Ends(*choose_ends("dirichlet", reduction)), y, i, record)
    return record


@each_reduction
@pytest.mark.parametrize("half_width", [1, 2, 6])
def test_norms_and_moduli_are_those_of_the_whole_chain(half_width, reduction):
    z = random_chain(half_width, **reduction._asdict())
    record = observed(z, reduction)
    stored = z[: len(record.l2)]
    np.testing.assert_allclose(record.linf[:, 0], np.abs(stored).max(axis=1), rtol=1e-14)
    np.testing.assert_allclose(record.l2[:, 0], np.linalg.norm(stored, axis=1), rtol=1e-14)
    sites = slice(half_width if reduction.even else 0, None)
    np.testing.assert_allclose(record.snapshots[:, :, 0], np.abs(stored)[:, sites], rtol=1e-14)


def test_an_output_is_written_in_its_place_and_the_moduli_at_chosen_outputs_only():
    z = random_chain(2)
    record = observed(z, times=7, i=4, every=2)
    written = [np.count_nonzero(a != -1.0) for a in (record.linf, record.l2, record.snapshots)]
    assert written == [2, 2, 10]
    np.testing.assert_allclose(record.snapshots[:, :, 2], np.abs(z), rtol=1e-14)
    assert np.all(observed(z, times=7, i=3, every=2).snapshots == -1.0)
    assert observed(z, every=0).snapshots.shape == (2, 5, 0)
