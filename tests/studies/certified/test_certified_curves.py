"""The proven distance of curves: against references, exact flows, dense matrices, wrong curves."""

import numpy as np
import pytest
from helpers import ROOT
from latticode.datasets.netcdf import read
from oracle import laplacian
from pendula.models.linear_chain import flow
from pendula.problem import Constants
from pendula.studies.certified import norm, regular
from pendula.studies.certified.norm import (
    NotDefiniteError,
    bands,
    crude_rates,
    find_form,
    find_rates,
)
from pendula.studies.certified.polynomials import Curve, find_curve, linear
from pendula.studies.certified.regular import norms_at, prove
from problems import make_problem, problem_of


def problem(omega=-4.0, boundary="dirichlet", scale=1.0, epsilon=1.0, gamma=1.0, **changes):
    data = scale * np.array([[0.2, 1.0, 0.1j], [0.0, 0.1, 0.0]])
    given = {"half_width": 4, "end_time": 2.0, "output_step": 0.025} | changes
    return make_problem(data, (epsilon, gamma, omega), boundary, **given)


def certify(given, curve=None):
    return norms_at(prove(given, curve or find_curve(given)), given.times)


def dense(band, state):
    size, width = band.shape[:2]
    matrix = np.zeros((size, size))
    for j in range(size):
        for k in range(min(width, size - j)):
            matrix[j + k, j] = matrix[j, j + k] = band[j, k, state]
    return matrix


@pytest.mark.parametrize("boundary", ["dirichlet", "free"])
@pytest.mark.parametrize(("omega", "epsilon"), [(8.0, 1.0), (-4.0, 1.0), (-4.0, -0.6), (8.0, -0.6)])
def test_the_bands_are_the_forms(omega, epsilon, boundary):
    given = problem(omega, boundary=boundary, epsilon=epsilon, gamma=0.7)
    form, draws = find_form(given.constants), np.random.default_rng(1)
    state, e = draws.normal(size=(2, 1, 2, 2, 9))
    quadratic, change = bands(state, given, form)
    flat = np.stack([e[0, 0, 0], e[0, 1, 0], e[0, 0, 1], e[0, 1, 1]], axis=1).ravel()
    field, a, b = linear(e[0], given), state[0, 0] + 1j * state[0, 1], e[0, 0] + 1j * e[0, 1]
    turned = -1j * (np.abs(a) ** 2 * b + 0.5 * a * a * b.conj())
    q = form.sign * np.sum(field * e[0])
    t = form.sign * np.sum((field[0] + 1j * field[1]).conj() * turned).real
    assert flat @ dense(quadratic, 0) @ flat == pytest.approx(q, rel=1e-12)
    assert flat @ dense(change, 0) @ flat == pytest.approx(t, rel=1e-12)
    values = np.linalg.eigvalsh(dense(quadratic, 0))
    assert form.m1 <= values[0] + 1e-12 and values[-1] <= form.m2 + 1e-12


def test_a_sharp_rate_is_just_above_the_largest_eigenvalue():
    given = problem()
    form, states = find_form(given.constants), np.random.default_rng(2).normal(size=(3, 2, 2, 9))
    rates, crude = find_rates(states, given, form), crude_rates(states, form)
    quadratic, change = bands(states, given, form)
    factor = np.linalg.inv(np.linalg.cholesky(dense(quadratic, 0)))
    for i in range(3):
        largest = np.linalg.eigvalsh(factor @ dense(change, i) @ factor.T)[-1]
        assert largest <= rates[i] <= largest + crude[i] / 63


def test_a_matrix_is_proven_only_above_the_margin_of_rounding():
    """Least eigenvalues of half, once and twice the margin, of one entry and of a band."""
    margin = 2.0**-30
    single = margin * np.array([[[0.5, 1.0, 2.0]]])
    assert norm._is_positive(single, np.float64(margin)).tolist() == [False, False, True]
    band = np.zeros((7, norm.BAND + 1, 3))
    band[:, 0], band[:-1, 1] = 2.0, -1.0
    least = 2.0 - 2.0 * np.cos(np.pi / 8.0)  # of the second differences on seven sites
    band[:, 0] += margin * np.array([0.5, 0.99, 1.01]) - least
    assert norm._is_positive(band, np.float64(margin)).tolist() == [False, False, True]


def test_inside_the_interval_there_is_no_norm():
    for omega in (-2.0, 0.0, 6.0):
        with pytest.raises(NotDefiniteError, match=r"lies in \[-2, 6\]"):
            find_form(Constants(epsilon=1.0, gamma=1.0, omega=omega))
    find_form(Constants(epsilon=1.0, gamma=1.0, omega=6.1))


@pytest.mark.parametrize("boundary", ["dirichlet", "free", "periodic"])
def test_without_the_cubic_term_the_exact_flow_lies_within_the_bound(boundary):
    given = problem(boundary=boundary, scale=1e-9, end_time=1.0)
    found = certify(given)
    exact = flow(given.amplitudes, 1.0, 1.0, 1.0, -4.0, boundary)
    apart = found.states[-1, 0] + 1j * found.states[-1, 1] - exact
    assert np.linalg.norm(apart) < found.bound[-1] + 1e-23 < 2e-22


@pytest.mark.parametrize("case", ["fig2_small", "fig3_small"])
def test_no_output_is_further_from_the_reference_than_its_bound(case):
    known = read(ROOT / f"tests/baseline/reference/{case}.nc")
    given = problem_of(case, end_time=10.0)
    found = certify(given)
    assert found.bound[-1] < 1e-11
    for name in ("linf", "l2"):
        apart = np.abs(getattr(found, name) - known[name].values[:, : len(found.tau)])
        assert (apart <= found.bound).all()
    for i, tau in enumerate(known["snapshot_tau"].values[:4]):  # 1, 2, 5 and 10
        output = int(np.searchsorted(found.tau, tau))
        state = known["amplitude"].values[..., i]
        assert np.linalg.norm(found.states[output] - state) <= found.bound[output]


WRONG = {
    "a constant": lambda one, given: find_curve(given.changed(gamma=1.0 + 1e-9)),
    "the ends": lambda one, given: find_curve(given.changed(boundary="free")),
    "a coefficient": lambda one, given: one._replace(terms=_added(one.terms, (3, 7, 0, 1, 4))),
    "a step": lambda one, given: one._replace(terms=np.delete(one.terms, 5, axis=1)),
    "the data": lambda one, given: find_curve(given.changed(initial=1.000000001 * given.initial)),
}


def _added(terms, place, by=1e-11):
    changed = terms.copy()
    changed[place] += by
    return changed


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_curve_is_found_out(name):
    given = problem(end_time=1.0)
    right = find_curve(given)
    wrong = WRONG[name](right, given)
    if name == "a step":
        given = given.changed(end_time=0.9)
    assert certify(given, wrong).bound[-1] > 30.0 * certify(given, right).bound[-1]


# --- Each part of the bound against exact sums --------------------------------------------------

DRIVEN = {"epsilon": 0.5, "gamma": 0.25, "omega": -2.0}


def short_curve(order=3, seed=5, sites=3, steps=2, step=0.125):
    """Return polynomials of small whole numbers, which solve nothing, and their problem."""
    drawn = np.random.default_rng(seed).integers(1, 4, size=(order + 1, steps, 2, 2, sites))
    curve = Curve(step, drawn / 8.0 ** np.arange(1, order + 2)[:, None, None, None, None])
    return curve, problem(half_width=sites // 2, end_time=steps * step, **DRIVEN)


def exact_defect(curve, given):
    """Return the coefficients of h d of each step, (order, step, component, site), as they are."""
    z = (curve.terms[:, :, 0] + 1j * curve.terms[:, :, 1]).astype(np.clongdouble)
    count, (epsilon, gamma, omega) = len(z), given.constants
    cubic = np.zeros((3 * count - 2, *z.shape[1:]), np.clongdouble)
    for i, j, k in np.ndindex(count, count, count):
        cubic[i + j + k] += 0.5 * z[i] * z[j].conj() * z[k]
    field = curve.step * cubic
    matrix = laplacian(z.shape[-1], "dirichlet")
    drive = gamma * (z[:, :, ::-1].conj() - z.conj())
    field[:count] += curve.step * (epsilon * z @ matrix.T + omega * z + drive)
    missed = -field
    missed[: count - 1] += 1j * np.arange(1, count)[:, None, None, None] * z[1:]
    return missed


def integral(coefficients, first):
    shares = 1.0 / np.arange(first + 1, first + 1 + len(coefficients))
    return (np.sqrt((np.abs(coefficients) ** 2).sum(axis=(2, 3))) * shares[:, None]).sum(axis=0)


def test_what_a_polynomial_leaves_out_is_below_its_bound_and_near_it_where_all_terms_add_up():
    curve, given = short_curve()
    found = regular._left_out(regular._sizes(curve), given, curve.step)
    exact = integral(exact_defect(curve, given)[3:], 3)
    assert (exact <= found).all() and (found < 4.0 * exact).all()
    one = curve.terms * 0.0
    one[0, :, 0, 0, 1], one[3, :, 0, 0, 1] = 2.0, 0.5  # on one site, real: nothing cancels
    alone, still = Curve(curve.step, one), given.changed(epsilon=0.0, gamma=0.0, omega=2.0)
    found = regular._left_out(regular._sizes(alone), still, curve.step)
    assert found == pytest.approx(integral(exact_defect(alone, still)[3:], 3), rel=1e-8)


def test_the_linear_part_is_as_strong_as_its_bound_on_the_shortest_wave():
    """Of a long chain whose sites and components alternate in sign, where the drive adds to it."""
    given = problem(half_width=200, epsilon=-0.7, gamma=0.3, omega=1.9)
    wave = (-1.0) ** np.arange(401) * np.sin(np.pi * (np.arange(401) + 1) / 402)
    real, none = np.array([wave, -wave]), np.zeros((2, 401))
    strongest = max(
        np.linalg.norm(linear(np.array(parts), given)) / np.linalg.norm(real)
        for parts in ((real, none), (none, real))
    )
    assert 0.999 < strongest / regular._strength(given) <= 1.0


@pytest.mark.parametrize("x", [0.0, 1e-9, 1e-3, 0.1, 0.5, 1.0])
def test_the_factor_of_growth_is_an_upper_bound_to_third_order(x):
    assert np.exp(np.longdouble(x)) <= regular.exponential(x) <= np.exp(x) + x**3 / 8 + 1e-14
    assert np.isinf(regular.exponential(x + 1.0 + 1e-12)) and np.isinf(regular.exponential(np.nan))


def test_the_rate_between_two_times_counts_how_far_squares_bend():
    curve, given = short_curve()
    form, sizes = find_form(given.constants), regular._sizes(curve)
    states = regular.sample(curve)
    delta, rates = curve.step / regular.SAMPLES, find_rates(states, given, form)
    growth = regular._growth(curve, given, form, sizes)
    extra = growth / delta - 0.5 * (rates[:-1] + rates[1:])
    # by differences in each interval: how far squares are from their linear interpolation
    for step in range(2):
        z = curve.terms[:, step, 0] + 1j * curve.terms[:, step, 1]
        for i in range(regular.SAMPLES):
            theta = (i + np.linspace(0.0, 1.0, 21)) / regular.SAMPLES
            values = np.array([sum(z[k] * t**k for k in range(len(z))) for t in theta])
            off = 0.0
            for square in (np.abs(values) ** 2, values**2):
                line = np.linspace(0.0, 1.0, 21)[:, None, None]
                off = off + np.abs(square - square[0] - line * (square[-1] - square[0]))
            assert 1.5 * form.condition * 0.5 * off.max() <= extra[step * regular.SAMPLES + i]


def test_what_is_quadratic_in_the_error_is_that_of_the_cubic_term():
    """(3 a y + y^2) y / 2 where the error y and the amplitude a are of one size."""
    curve, given = short_curve(steps=1)
    form, still = find_form(given.constants), 1e-3 * curve.terms
    still[1:] = 0.0
    sizes = regular._sizes(Curve(curve.step, still))
    inputs = dict.fromkeys(regular.GROWING[:-1], np.zeros(1)) | {"start": np.full(1, 1e-3)}
    errors = regular._accumulate(inputs, np.zeros(regular.SAMPLES), sizes, form, curve.step)
    low, high = np.sqrt(float(form.m1)), np.sqrt(float(form.m2))
    start, quadratic = errors[0, 1, 0], errors[0, 1, -1]
    assert start == pytest.approx(1e-3 * high, rel=1e-6)
    y, a, time = start / low, sizes.largest[0, 0], curve.step / regular.SAMPLES
    exact = high * 0.5 * (3.0 * a * y + y * y) * y * time
    assert quadratic == pytest.approx(exact, rel=1e-4, abs=0.0)


def test_what_is_rounded_away_is_below_its_bound_and_each_rounding_counts():
    curve, given = short_curve()
    sizes, exact = regular._sizes(curve), integral(exact_defect(curve, given)[:3], 0)
    found = regular._rounding(curve, given, sizes)
    assert (exact <= found).all() and found == pytest.approx(exact, rel=1e-8)
    # without any defect what is left are the roundings that Higham's bound allows
    rest = regular._rounding(Curve(curve.step, 0.0 * curve.terms), given, sizes)
    unit, strength = 2.0**-53, 4 * 0.5 + 2.0 + 2 * 0.25
    cubic = regular._cubic(sizes)
    expected = sum(
        unit * (9 * strength * 0.125 * sizes.norm[k] + (2 * k + 10) * 0.125 * cubic[k]
                + 3 * (k + 1) * sizes.norm[k + 1]) / (k + 1)
        for k in range(3)
    )  # fmt: skip
    assert rest == pytest.approx(expected, rel=1e-8, abs=0.0)


def test_norms_are_off_by_twelve_roundings_beside_that_of_the_sum():
    curve, _ = short_curve(steps=1)
    curve.terms[1:] = 0.0
    found = norms_at(regular.leave_unproved(curve), np.zeros(1))
    size = np.linalg.norm(curve.terms[0])
    assert found.parts[-1, 0] == pytest.approx(13 * 2.0**-53 * size, rel=1e-6, abs=0.0)
