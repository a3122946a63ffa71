"""The proven distance of curves: against references, exact flows, dense matrices, wrong curves."""

import numpy as np
import pytest
from helpers import ROOT
from pendula.datasets.netcdf import as_xarray, read
from pendula.models.linear_chain import flow
from pendula.problem import Constants, Problem, on_sites, read_initial
from pendula.studies.certified.contents import curve_contents
from pendula.studies.certified.figures import draw_curves, gather_curves
from pendula.studies.certified.norm import (
    NotDefiniteError,
    bands,
    crude_rates,
    find_form,
    find_rates,
    up,
)
from pendula.studies.certified.polynomials import StepError, add_up, find_curve, linear
from pendula.studies.certified.regular import PARTS, certify, norms_at, prove


def problem(omega=-4.0, half_width=4, end_time=2.0, boundary="dirichlet", scale=1.0, **constants):
    given = {"epsilon": 1.0, "gamma": 1.0, "omega": omega, **constants}
    return Problem(
        constants=Constants(**given),
        half_width=half_width,
        boundary=boundary,
        initial=scale * np.array([[0.2, 1.0, 0.1j], [0.0, 0.1, 0.0]]),
        end_time=end_time,
        output_step=0.025,
        solver={"name": "polynomials"},
    )


def dense(band, state):
    size, width = band.shape[:2]
    matrix = np.zeros((size, size))
    for j in range(size):
        for k in range(min(width, size - j)):
            matrix[j + k, j] = matrix[j, j + k] = band[j, k, state]
    return matrix


@pytest.mark.parametrize("boundary", ["dirichlet", "free"])
@pytest.mark.parametrize("omega", [8.0, -4.0])
def test_the_bands_are_the_forms(omega, boundary):
    given = problem(omega, boundary=boundary, gamma=0.7)
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


def test_a_rate_whose_matrix_would_underflow_is_the_crude_one():
    given = problem()
    form, states = find_form(given.constants), np.full((1, 2, 2, 9), 1e-140)
    assert find_rates(states, given, form) == pytest.approx(crude_rates(states, form), rel=1e-8)


@pytest.mark.parametrize("roundings", [1, 999_999, 10**6, 10**8 + 1])
def test_bounds_rise_above_all_roundings(roundings):
    assert np.log(up(roundings)) > 1.0001 * roundings * 2.0**-53


def test_inside_the_interval_there_is_no_norm():
    for omega in (-2.0, 0.0, 6.0):
        with pytest.raises(NotDefiniteError, match=r"lies in \[-2, 6\]"):
            find_form(Constants(epsilon=1.0, gamma=1.0, omega=omega))
    find_form(Constants(epsilon=1.0, gamma=1.0, omega=6.1))


def test_sums_keep_what_rounding_leaves_out():
    terms = np.array([[1.0], [2.0**-60], [2.0**-61]])
    first, second = add_up(terms)
    assert first[0] == 1.0 and second[0] == 1.5 * 2.0**-60


@pytest.mark.parametrize("boundary", ["dirichlet", "free", "periodic"])
def test_without_the_cubic_term_the_exact_flow_lies_within_the_bound(boundary):
    given = problem(boundary=boundary, scale=1e-9, end_time=1.0)
    found = certify(given)
    exact = flow(given.amplitudes, 1.0, 1.0, 1.0, -4.0, boundary)
    apart = found.states[-1, 0] + 1j * found.states[-1, 1] - exact
    assert np.linalg.norm(apart) < found.bound[-1] + 1e-23 < 2e-22


def test_the_bound_is_the_sum_of_its_parts_and_each_is_there():
    found = certify(problem(epsilon=0.9, gamma=0.7, omega=-5.3))
    assert found.bound == pytest.approx(found.parts.sum(axis=0), rel=1e-8)
    assert (found.parts[:, -1] > 0).all() and len(found.parts) == len(PARTS)
    assert found.bound[-1] < 1e-12 and (np.diff(found.parts[:-1].sum(axis=0)) >= 0).all()


@pytest.mark.parametrize("case", ["fig2_small", "fig3_small"])
def test_no_output_is_further_from_the_reference_than_its_bound(case):
    known = read(ROOT / f"tests/baseline/reference/{case}.nc")
    given = Problem(
        constants=Constants.of(known.attrs),
        half_width=int(known.attrs["half_width"]),
        boundary=known.attrs["boundary"],
        initial=on_sites(read_initial(known.attrs["initial"])),
        end_time=10.0,
        output_step=0.025,
        solver={"name": "polynomials"},
    )
    found = certify(given)
    assert found.bound[-1] < 1e-11
    for name in ("linf", "l2"):
        apart = np.abs(getattr(found, name) - known[name].values[:, : len(found.tau)])
        assert (apart <= found.bound).all()
    for i, tau in enumerate(known["snapshot_tau"].values[:4]):  # 1, 2, 5 and 10
        output = int(np.searchsorted(found.tau, tau))
        state = known["amplitude"].values[..., i]
        assert np.linalg.norm(found.states[output] - state) <= found.bound[output]


def test_where_no_norm_is_kept_the_bound_is_infinite_and_the_file_says_why():
    variables, attributes = curve_contents("mine", problem(omega=1.0))
    assert np.isinf(variables["bound"].values).all() and variables["l2"].values.max() < 10.0
    assert "lies in [-2, 6]" in attributes["not_certified"]
    known = as_xarray(variables, attributes)
    data = gather_curves([as_xarray(*curve_contents("mine", problem(omega=1.0), None, known))])
    assert len(draw_curves(data).axes) == 1


def test_no_step_is_short_enough_for_a_polynomial_of_low_order():
    with pytest.raises(StepError, match="of order 2"):
        find_curve(problem(), order=2)


def test_within_an_interval_the_bound_is_that_at_its_end():
    given = problem(end_time=0.5)
    proof = prove(given, find_curve(given))
    tau = proof.curve.step * np.array([3.3, 3.5])
    assert (norms_at(proof, tau).parts[:-1] == proof.errors[3, 2][:, None]).all()


def test_an_error_that_no_trial_holds_has_no_bound():
    """What is quadratic in so large an error is larger than the room that a trial leaves."""
    given = problem(end_time=0.25)
    far = find_curve(given.changed(initial=1.3 * given.initial))
    assert np.isinf(certify(given, far).bound[-1])


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
