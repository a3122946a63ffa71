"""ode45 and dop853: their coefficients, orders, error norms and interpolants."""

import numpy as np
import plain
import pytest
from latticode.integrators import dop853, ode45
from latticode.integrators.weighted_sums import STRIP, table, write_sum
from latticode.kernels.simd import LANES
from trees import defect

E = np.array([ode45.E1, 0.0, ode45.E3, ode45.E4, ode45.E5, ode45.E6, ode45.E7])


def matrix_of(method, stages):
    """Return the coefficients of all stages, read off the compiled code with unit slopes."""
    a = np.zeros((stages, stages))
    for stage in range(2, stages + 1):
        method.combine(stage, np.zeros(stages), 1.0, np.eye(stages), a[stage - 1])
    return a


OF_ODE45, OF_DOP853 = matrix_of(ode45, 7), matrix_of(dop853, 16)
FIFTH, THIRD = np.zeros((2, 16))
dop853.weigh_slopes(np.eye(16), dop853.FIFTH, FIFTH)
dop853.weigh_slopes(np.eye(16), dop853.THIRD, THIRD)


def unit_slopes(stages):
    """Return slopes of the stages, each alone in a column of its own."""
    k = np.zeros((stages, 2, stages + 2))
    k[:, 0, 1:-1] = np.eye(stages)
    return k


def interpolation_weights(method, fraction):
    """Return the weights of the interpolant, read off the compiled code with unit slopes."""
    k = unit_slopes(7 if method is ode45 else 16)
    y, w, out = np.zeros((3, *k.shape[1:]))
    c = np.zeros((7, *k.shape[1:]))
    if method is ode45:
        ode45.interpolate(fraction, y, 1.0, k, out)
    else:
        w[0, 1:-1] = OF_DOP853[12]
        dop853.prepare_interpolant(y, w, 1.0, k, c)
        dop853.interpolate(fraction, y, c, out)
    return out[0, 1:-1]


@pytest.mark.parametrize(("method", "matrix"), [(ode45, OF_ODE45), (dop853, OF_DOP853)])
def test_every_stage_stands_where_its_weights_say(method, matrix):
    np.testing.assert_allclose(method.NODES[2:], matrix.sum(axis=1)[1:], rtol=0, atol=2e-14)


@pytest.mark.parametrize(
    ("matrix", "weights", "order", "expected"),
    [
        (OF_ODE45, OF_ODE45[6], 5, 1.0),
        (OF_ODE45, E, 4, 0.0),
        (OF_DOP853, OF_DOP853[12], 8, 1.0),
        (OF_DOP853, FIFTH, 5, 0.0),
        (OF_DOP853, THIRD, 3, 0.0),
    ],
)
def test_solutions_and_error_estimates_have_their_orders(matrix, weights, order, expected):
    assert defect(matrix, weights, order, expected=expected) < 1e-13
    assert defect(matrix, weights, order + 1, expected=expected) > 1e-8


@pytest.mark.parametrize("fraction", [0.0, 0.1, 0.5, 0.9, 1.0])
def test_interpolants_have_their_order_everywhere(fraction):
    for method, matrix, order in ((ode45, OF_ODE45, 4), (dop853, OF_DOP853, 7)):
        weights = interpolation_weights(method, fraction)
        assert defect(matrix, weights, order, fraction) < 1e-13


def error_of(y, w, h, k, tolerances):
    """Return the error of a step of dop853, in units of the tolerance."""
    spare = np.zeros((2, *y.shape))
    estimates = dop853.error_estimates(y, w, k, *spare, tolerances, (1, y.shape[1] - 1))
    return dop853.step_error(h, *estimates)


@pytest.mark.parametrize("threshold", [1e-2, 1.5])
def test_errors_are_those_of_the_largest_complex_component(threshold):
    rng = np.random.default_rng(0)
    k, y, w = rng.normal(size=(16, 4, 5)), rng.normal(size=(4, 5)), rng.normal(size=(4, 5))
    z, new = (u[0::2, 1:-1] + 1j * u[1::2, 1:-1] for u in (y, w))
    slopes = k[:, 0::2, 1:-1] + 1j * k[:, 1::2, 1:-1]
    fifth, third, fourth = (
        np.abs(np.tensordot(weights, slopes[: len(weights)], 1)) for weights in (FIFTH, THIRD, E)
    )
    expected = np.max(fourth / np.maximum(plain.larger(z, new), threshold))
    error = ode45.relative_error(y, w, k[:7], threshold, np.zeros((4, 5)))
    assert error == pytest.approx(expected, rel=1e-13)
    scale = 0.3 + 0.2 * plain.larger(z, new)
    e5, e3 = np.max(fifth / scale), np.max(third / scale)
    expected = 0.7 * e5**2 / np.sqrt(e5**2 + 0.01 * e3**2)
    assert error_of(y, w, 0.7, k, (0.2, 0.3)) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("stage", [0, 5])
def test_a_nan_is_never_a_small_error(stage):
    k, y = np.zeros((16, 2, 4)), np.ones((2, 4))
    k[stage, 1, 2] = np.nan
    assert error_of(y, y, 0.1, k, (1e-6, 1e-6)) == np.inf
    assert not ode45.relative_error(y, y, k[:7], 0.01, np.zeros((2, 4))) < np.inf


@pytest.mark.parametrize(("x", "y"), [(1.0, 2.0), (np.inf, 1.0), (np.nan, 1.0)])
def test_the_worse_of_two_errors_is_the_larger_or_the_one_that_is_no_number(x, y):
    expected = np.maximum(x, y)
    np.testing.assert_equal([dop853.worse(x, y), dop853.worse(y, x)], [expected] * 2)


@pytest.mark.parametrize(
    ("t", "expected"), [(0.0, 2.0**-1070), (1.0, 2.0**-48), (-2.0, 2.0**-47), (1e-300, 2.0**-1045)]
)
def test_the_shortest_step_of_ode45_is_sixteen_spacings(t, expected):
    assert ode45.spacing(t) == expected


# --- Weighted sums of slopes --------------------------------------------------------------------

ROWS = table({0: {2: 0.3}, 2: {1: -0.7, 3: 1.1, 4: 1e-3}}, 3)
SIZES = [1, LANES - 1, LANES, LANES + 1, STRIP - 1, STRIP, STRIP + 1, 2 * STRIP + LANES + 3]


@pytest.mark.parametrize("size", SIZES)
def test_a_sum_has_the_bits_of_its_terms_in_their_order(size):
    rng = np.random.default_rng(size)
    y, k, out = rng.normal(size=size), rng.normal(size=(5, size)), np.full(size + 1, np.nan)
    write_sum(ROWS, 2, y, 0.9, k, out[:-1])
    np.testing.assert_array_equal(out[:-1], y + 0.9 * ((-0.7 * k[0] + 1.1 * k[2]) + 1e-3 * k[3]))
    assert np.isnan(out[-1])
    write_sum(ROWS, 0, y[:0], 0.9, k, out[:-1])
    np.testing.assert_array_equal(out[:-1], 0.9 * (0.3 * k[1]))
