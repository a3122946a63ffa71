"""The norms and moduli that a run keeps."""

import numpy as np
import pytest
from hypothesis import given
from oracle import boundaries, chains, random_chain
from pendula.models.amplitudes import Chain, energy
from pendula.simulation.lattice import Reduction, choose_ends, pack
from pendula.simulation.observables import blank_record, observe

WHOLE = Reduction(even=False, synchronised=False)
HALF = Reduction(even=True, synchronised=False)


def chain_for(boundary, reduction):
    return Chain(1.0, 1.0, -4.0, *choose_ends(boundary, reduction))


def norms(chain, y, row):
    """Return the l-infinity and l2 norms of the component whose rows begin at `row`."""
    record = blank_record(y.shape[0] // 2, y.shape[1] - 2, 1, 0)
    observe(chain, y, 0, record)
    return record.linf[row // 2, 0], record.l2[row // 2, 0]


@pytest.mark.parametrize("reduction", [WHOLE, HALF])
@pytest.mark.parametrize("half_width", [1, 2, 6])
def test_norms_are_those_of_the_whole_chain(half_width, reduction):
    z = random_chain(half_width, **reduction._asdict())
    y = pack(z, reduction)
    for component in (0, 1):
        linf, l2 = norms(chain_for("dirichlet", reduction), y, 2 * component)
        assert linf == pytest.approx(np.abs(z[component]).max(), rel=1e-14)
        assert l2 == pytest.approx(np.linalg.norm(z[component]), rel=1e-14)


@pytest.mark.parametrize("site", range(5))
def test_the_largest_site_is_found_anywhere(site):
    z = np.full((2, 5), 0.5 + 0.5j)
    z[1, site] = 3 - 4j
    assert norms(chain_for("free", WHOLE), pack(z, WHOLE), 2)[0] == 5.0


def test_norms_of_one_pair():
    z = np.array([[3 + 4j], [-6 + 8j]])
    assert norms(chain_for("periodic", WHOLE), pack(z, WHOLE), 2) == (10.0, 10.0)


@given(chains(widths=(1, 4), even=True), boundaries)
def test_half_of_an_even_chain_has_the_bits_of_the_whole(z, boundary):
    for row in (0, 2):
        half = norms(chain_for(boundary, HALF), pack(z, HALF), row)
        assert half == norms(chain_for(boundary, WHOLE), pack(z, WHOLE), row)


@pytest.mark.parametrize(
    ("times", "every", "snapshots"), [(11, 5, 3), (10, 5, 2), (11, 0, 0), (1, 7, 1)]
)
def test_a_record_has_room_for_every_snapshot(times, every, snapshots):
    record = blank_record(2, 7, times, every)
    assert record.modulus.shape == (2, 7, snapshots)
    assert record.linf.shape == record.l2.shape == (2, times)
    assert record.energy.shape == (times,)


def test_observing_an_output_writes_that_output_and_no_other():
    z = random_chain(2)
    chain, y = chain_for("dirichlet", WHOLE), pack(z, WHOLE)
    record = blank_record(2, 5, 7, 2)
    for values in record[:4]:
        values.fill(-1.0)
    observe(chain, y, 4, record)
    np.testing.assert_allclose(record.linf[:, 4], np.abs(z).max(axis=1), rtol=1e-14)
    np.testing.assert_allclose(record.l2[:, 4], np.linalg.norm(z, axis=1), rtol=1e-14)
    np.testing.assert_allclose(record.modulus[:, :, 2], np.abs(z), rtol=1e-14)
    assert record.energy[4] == energy(chain, y)
    assert [np.count_nonzero(values != -1.0) for values in record[:4]] == [2, 2, 1, 10]


def test_no_snapshot_is_taken_between_the_chosen_outputs():
    record = blank_record(2, 5, 7, 2)
    record.modulus.fill(-1.0)
    observe(chain_for("dirichlet", WHOLE), pack(random_chain(2), WHOLE), 3, record)
    assert np.all(record.modulus == -1.0)


def test_one_component_is_observed_once():
    synchronised = Reduction(even=False, synchronised=True)
    z = random_chain(2, synchronised=True)
    record = blank_record(1, 5, 1, 1)
    observe(chain_for("dirichlet", synchronised), pack(z, synchronised), 0, record)
    np.testing.assert_allclose(record.l2[:, 0], np.linalg.norm(z[0]), rtol=1e-14)
    np.testing.assert_allclose(record.modulus[0, :, 0], np.abs(z[0]), rtol=1e-14)


@pytest.mark.parametrize("reduction", [WHOLE, HALF])
def test_norms_do_not_look_at_ghosts(reduction):
    z = random_chain(3, **reduction._asdict())
    y = pack(z, reduction)
    y[:, [0, -1]] = 1e3
    linf, l2 = norms(chain_for("free", reduction), y, 0)
    assert (linf, l2) == pytest.approx((np.abs(z[0]).max(), np.linalg.norm(z[0])))


def test_a_record_without_moduli_keeps_none():
    record = blank_record(2, 5, 3, 0)
    observe(chain_for("dirichlet", WHOLE), pack(random_chain(2), WHOLE), 2, record)
    assert record.modulus.shape == (2, 5, 0)
    assert record.scratch.shape == (2, 7)  # of the columns of a state


def test_the_energy_is_left_out_where_nobody_asks_for_it():
    z = random_chain(2)
    chain, y = chain_for("dirichlet", WHOLE), pack(z, WHOLE)
    whole, norms_alone = blank_record(2, 5, 1, 0), blank_record(2, 5, 1, 0, energy=False)
    for record in (whole, norms_alone):
        observe(chain, y, 0, record)
    assert norms_alone.energy.size == 0
    assert (norms_alone.l2 == whole.l2).all() and (norms_alone.linf == whole.linf).all()
