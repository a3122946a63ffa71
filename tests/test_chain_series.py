"""The power series of the chain against the equations themselves."""

import numpy as np
import pytest
from hypothesis import given, settings
from oracle import boundaries, chains, constants, power_series
from pendula.chain import Chain
from pendula.chain_series import next_coefficient
from pendula.integrators.taylor import WORK, lay_out
from pendula.lattice import Reduction, choose_ends, find_reduction, pack, unpack

ORDER = 7
WHOLE = Reduction(even=False, synchronised=False)


def coefficients(z, numbers, boundary, reduction):
    """Return the first coefficients (order + 1, 2, N) by the library, complex."""
    y = pack(z, reduction)
    series = lay_out(np.full((WORK, *y.shape), np.nan), y)
    series.c[0, :, : y.shape[1]] = y
    chain = Chain(*numbers, *choose_ends(boundary, reduction))
    for k in range(ORDER):
        next_coefficient(chain, series, k)
    return np.array([unpack(row, reduction) for row in series.c[: ORDER + 1, :, : y.shape[1]]])


@pytest.mark.parametrize(("even", "synchronised"), [(0, 0), (1, 0), (0, 1), (1, 1)])
def test_each_kind_of_half_continues_the_series(even, synchronised):
    @given(z=chains(even=even, synchronised=synchronised), numbers=constants, boundary=boundaries)
    @settings(max_examples=30)
    def check(z, numbers, boundary):
        expected = power_series(z, numbers, boundary, ORDER)
        for reduction in (WHOLE, find_reduction(z)):
            actual = coefficients(z, numbers, boundary, reduction)
            size = np.abs(expected).max(axis=(1, 2), keepdims=True)
            np.testing.assert_allclose(actual / (size + 1), expected / (size + 1), atol=1e-13)

    check()
