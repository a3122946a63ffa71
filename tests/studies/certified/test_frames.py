"""Proofs by frames: against better curves and dense matrices, and with wrong curves."""

from fractions import Fraction
from itertools import chain as joined

import numpy as np
import pytest
from helpers import ROOT
from latticode.datasets.netcdf import read
from oracle import laplacian
from pendula.studies.certified import fixed_point, frames
from problems import make_problem, problem_of

BITS, ORDER = 96, 36


def problem(data=((0, 1.5, 0), (0, 0.1j, 0)), boundary="dirichlet", **changes):
    keys = {"half_width": 2, "end_time": 0.6, "output_step": 0.05} | changes
    return make_problem(np.array(data), (0.9, 0.7, -1.3), boundary, **keys)


def make_steps(case, bits=BITS, order=ORDER):
    """Return the chain, and the steps of its curve from each output to the next."""
    chain = fixed_point.make_half_chain(case, bits)
    steps = fixed_point.generate_steps(fixed_point.round_initial_data(case, chain)[0], chain, order)
    return chain, [next(steps) for _ in case.times[1:]]


def certify(case, steps, bits=BITS, order=ORDER, per_frame=10):
    """Return what frames.certify finds of steps that it is given in place of its own."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(frames, "generate_steps", lambda state, chain, order: iter(steps))
        return frames.certify(case, bits, order, per_frame)


def bound(case, steps, **how):
    """Return the bound at the end, without what is due to the output in doubles."""
    return float(certify(case, steps, **how).contributions[:3, -1].sum())


def exact_end(steps, chain):
    end = np.array(fixed_point.evaluate_end(steps[-1][-1].terms), object)
    return [[Fraction(int(x), 2**chain.bits) for x in row] for row in end]


def distance(first, second):
    both = zip(joined(*first), joined(*second), strict=True)
    return float(sum((x - y) ** 2 for x, y in both)) ** 0.5


@pytest.fixture(scope="module")
def right():
    """A problem, its chain, the steps of its curve, and their bound."""
    case = problem()
    chain, steps = make_steps(case)
    return case, chain, steps, bound(case, steps)


def test_the_outputs_that_are_reached_are_reported(right):
    case, calls = right[0], []
    frames.certify(case, BITS, ORDER, 10, lambda *numbers: calls.append(numbers))
    count = len(case.times)
    assert calls == [(done, count) for done in range(1, count + 1)]


def test_a_curve_with_twice_the_digits_lies_within_the_bound(right):
    case, chain, steps, _ = right
    finer, better = make_steps(case, 2 * BITS, 2 * ORDER)
    off = distance(exact_end(steps, chain), exact_end(better, finer))
    assert off > 1e-30
    for per_frame in (1, 7, 1000):
        assert off < bound(case, steps, per_frame=per_frame) < 1e-18


def test_the_defect_is_what_a_curve_misses_of_the_equation():
    case = problem(end_time=0.05)
    chain, ((step, *_), *_) = make_steps(case, 48, 8)
    h, theta = chain.interval / step.divisor, Fraction(1, 3)
    p, slope = (
        np.array(
            [[sum(w(k) * series[k] for k in range(9)) for series in row] for row in step.terms]
        )
        for w in (lambda k: theta**k, lambda k: k * theta ** (k - 1) if k else 0)
    )
    p, slope = p / Fraction(2**48), slope / Fraction(2**48)
    q, field = fixed_point.scaled_linear(p.tolist(), chain)
    square = (p[0] ** 2 + p[1] ** 2) / 2
    missed = np.array([-slope[1], slope[0]]) - h * (np.array(field) / q + square * p)
    expected = float((missed**2).sum()) ** 0.5
    assert 0.0 < expected < fixed_point.bound_defect(step, chain) < 1e-6


def test_the_half_chain_has_the_field_of_the_whole():
    case, draws = problem(half_width=3), np.random.default_rng(1)
    chain = fixed_point.make_half_chain(case, BITS)
    half = draws.normal(size=(2, 2, 4))
    x, y = np.concatenate([half[..., :0:-1], half], axis=-1)
    z, (epsilon, gamma, omega) = x + 1j * y, case.constants
    field = epsilon * z @ laplacian(7, "dirichlet") + omega * z + gamma * (z[::-1] - z).conj()
    expected = np.stack([field.real, field.imag])[..., 3:]
    assert frames.linear_terms(half[..., None], chain)[..., 0] == pytest.approx(expected, rel=1e-13)
    q, exact = fixed_point.scaled_linear(half.reshape(2, -1).tolist(), chain)
    assert np.array(exact).reshape(half.shape) / q == pytest.approx(expected, rel=1e-13)


def _raised(steps, output, place, by):
    """Return steps of which the first behind an output has another coefficient."""
    (row, site, k), (first, *later) = place, steps[output]
    terms = [[list(series) for series in each] for each in first.terms]
    terms[row][site][k] += by
    return [*steps[:output], [first._replace(terms=terms), *later], *steps[output + 1 :]]


WRONG = {
    "a constant": lambda case, steps: make_steps(case.changed(gamma=0.7 + 1e-9))[1],
    "the data": lambda case, steps: make_steps(case.changed(initial=(1 + 1e-9) * case.initial))[1],
    "a coefficient": lambda case, steps: _raised(steps, 3, (0, 1, 5), 2 ** (BITS - 40)),
    "a jump": lambda case, steps: _raised(steps, 4, (1, 2, 0), 2 ** (BITS - 40)),
    "an interval": lambda case, steps: steps[:4] + steps[5:] + steps[-1:],
}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_curve_is_found_out(name, right):
    case, chain, steps, small = right
    wrong = WRONG[name](case, steps)
    off = distance(exact_end(wrong, chain), exact_end(steps, chain))
    wrong_bound = bound(case, wrong)
    assert wrong_bound > 1e6 * small
    assert wrong_bound > 0.99 * off


COMMITTED = sorted(ROOT.glob("tests/baseline/proofs/*.nc"))
UNEVEN = {
    "one left out": lambda eight: eight[:3] + eight[4:],
    "one too many": lambda eight: [*eight, eight[-1]],
    "none": lambda eight: [],
    "one that is longer": lambda eight: [eight[0]._replace(divisor=7), *eight[1:]],
    "one back in time": lambda eight: [*eight, *eight[:2], eight[0]._replace(divisor=-4)],
}


@pytest.mark.parametrize("name", UNEVEN)
def test_steps_that_do_not_cover_the_time_between_outputs_are_refused(name):
    case, eight = problem(end_time=0.05), []
    chain = fixed_point.make_half_chain(case, BITS)
    state = fixed_point.round_initial_data(case, chain)[0]
    while len(eight) < 8:
        eight.append(
            fixed_point.Step(
                8, fixed_point.make_taylor_terms(state, chain, chain.interval / 8, ORDER)
            )
        )
        state = fixed_point.evaluate_end(eight[-1].terms)
    assert bound(case, [eight]) < 1e-20
    with pytest.raises(fixed_point.StepError, match="do not add up to the time"):
        certify(case, [UNEVEN[name](eight)])


@pytest.mark.parametrize("path", COMMITTED, ids=lambda path: path.stem)
def test_the_first_outputs_are_those_that_are_committed(path):
    committed = read(path)
    assert committed["tau"][-1] == 50.0
    case = problem_of(path.stem, end_time=0.05)
    keys = ("bits", "order", "outputs_per_frame")
    curve = frames.certify(case, **{key: int(committed.attrs[f"solver_{key}"]) for key in keys})
    assert (curve.bound == committed["bound"].values[:3]).all()
    assert (curve.l2 == committed["l2"].values[:, :3]).all()


def test_what_frames_miss_is_the_linear_and_the_cubic_part_of_the_last_order():
    """A half chain: the bond at its centre counts twice, so that epsilon has the factor 5."""
    chain = fixed_point.FixedPointChain(
        Fraction(-1, 2), Fraction(1, 4), Fraction(3), 3, Fraction(1), 64
    )
    strength, h, sizes = 5 * 0.5 + 3.0 + 2 * 0.25, 0.125, np.array([0.3])
    computed = frames.bound_tangent_defect(np.array([2.0]), sizes, h, chain)
    assert computed == pytest.approx(h * 2.0 * (strength + 1.5 * 0.3**2), rel=1e-6)


def test_the_quadratic_term_adds_what_errors_and_amplitudes_of_one_size_make():
    moved, largest, time = 1e-3, 2e-3, 0.5
    y = moved * (1.0 + frames.SLACK)
    exact = time * 0.5 * (3.0 * largest * y + y * y) * y
    assert frames._bound_quadratic_term(0.0, moved, largest, time) == pytest.approx(
        exact, rel=1e-6, abs=0.0
    )
    assert np.isinf(frames._bound_quadratic_term(0.0, moved, 1e3, time))


def test_what_no_column_follows_grows_at_the_rate_of_the_linearised_flow(right):
    _, chain, ((step, *_), *_), _ = right
    tube = frames.make_initial_tube(chain, 0.0)
    tube = tube._replace(z=np.zeros_like(tube.z), w=np.array([1e-20, 0.0, 0.0, 0.0]))
    p = fixed_point.as_doubles(step, chain)
    largest = np.sqrt((p**2).sum(axis=1).max(axis=(1, 2))).sum()
    h, rate = float(chain.interval / step.divisor), 2.0 * 0.7 + 0.9 / 2.0 + largest**2 / 2.0
    computed = frames.advance_tube(tube, step, chain, 0.0).w[0]
    assert computed == pytest.approx(1e-20 * frames.bound_exponential(h * rate), rel=1e-6, abs=0.0)


@pytest.mark.parametrize("x", [0.0, 1e-9, 1e-3, 0.1, 0.5, 1.0])
def test_the_factor_of_growth_is_an_upper_bound_to_third_order(x):
    assert np.exp(np.longdouble(x)) <= frames.bound_exponential(x) <= np.exp(x) + x**3 / 8 + 1e-14
    assert np.isinf(frames.bound_exponential(x + 1.0 + 1e-12)) and np.isinf(
        frames.bound_exponential(np.nan)
    )


@pytest.mark.parametrize(
    "changes", [{"boundary": "free"}, {"data": ((0, 1, 1), (0, 0, 0))}], ids=["ends", "data"]
)
def test_a_problem_that_is_not_even_is_refused(changes):
    with pytest.raises(fixed_point.NotEvenError, match="even in n"):
        frames.certify(problem(**changes), BITS, ORDER, 10)


def test_a_distance_counts_both_halves_of_the_chain(right):
    tube = frames.make_initial_tube(right[1], 0.0)
    z, w = np.zeros_like(tube.z), np.array([0.0, 1e-20, 0.0, 0.0])
    z[1, 0] = 1e-20  # Re A of the site 1
    bounds = frames.bound_distances(tube._replace(z=z, w=w))
    assert bounds[:2] == pytest.approx(np.sqrt(2.0) * 1e-20, rel=1e-6, abs=0.0)
