"""Proofs by frames: against better curves and dense matrices, and with wrong curves."""

from fractions import Fraction
from itertools import chain as joined

import numpy as np
import pytest
from helpers import ROOT
from pendula.datasets.netcdf import read
from pendula.problem import Constants, Problem, on_sites, read_initial
from pendula.studies.certified import fixed_point, frames

BITS, ORDER = 96, 36


def problem(half_width=2, end_time=0.6, **changes):
    return Problem(
        constants=Constants(epsilon=0.9, gamma=0.7, omega=-1.3),
        half_width=half_width,
        boundary="dirichlet",
        initial=on_sites({0: (1.5, 0.1j)}),
        end_time=end_time,
        output_step=0.05,
        solver={"name": "polynomials"},
    ).changed(**changes)


def steps_of(given, bits=BITS, order=ORDER):
    chain = fixed_point.half_chain(given, bits)
    found = fixed_point.follow(fixed_point.start(given, chain)[0], chain, order)
    return chain, [step for _ in given.times[1:] for step in next(found)]


def walk(given, steps, chain, per_frame=10):
    """Return the bound at the end of steps, as frames.certify finds it for steps of its own."""
    state, off = fixed_point.start(given, chain)
    begins = [[own[0] for own in part] for part in steps[0].terms]
    off += fixed_point.as_double(
        sum(abs(x - y) for x, y in zip(joined(*state), joined(*begins), strict=True)),
        Fraction(1, 2**chain.bits),
    )
    tube, before = frames.begin(chain, off), None
    for i, step in enumerate(steps):
        jumped = fixed_point.jump(before, step, chain) if before else 0.0
        tube, before = frames.advance(tube, step, chain, jumped), step
        if (i + 1) % per_frame == 0:
            tube = frames.reframe(tube)
    return float(frames.distances(tube)[:3].sum())


def exact_end(steps, chain):
    whole = np.array(fixed_point.end(steps[-1].terms), object)
    return [[Fraction(int(x), 2**chain.bits) for x in part] for part in whole]


def apart(one, other):
    both = zip(joined(*one), joined(*other), strict=True)
    return float(sum((x - y) ** 2 for x, y in both)) ** 0.5


@pytest.fixture(scope="module")
def right():
    """A problem, its chain, the steps of its curve, and their bound."""
    given = problem()
    chain, steps = steps_of(given)
    return given, chain, steps, walk(given, steps, chain)


def test_a_curve_with_twice_the_digits_lies_within_the_bound(right):
    given, chain, steps, _ = right
    finer, better = steps_of(given, 2 * BITS, 2 * ORDER)
    off = apart(exact_end(steps, chain), exact_end(better, finer))
    assert off > 1e-30
    for per_frame in (1, 7, 1000):
        assert off < walk(given, steps, chain, per_frame) < 1e-18


def test_the_defect_is_what_a_curve_misses_of_the_equation():
    given = problem(end_time=0.05)
    chain, (step, *_) = steps_of(given, 48, 8)
    h, theta = chain.interval / step.pieces, Fraction(1, 3)
    p, slope = (
        np.array([[sum(w(k) * own[k] for k in range(9)) for own in part] for part in step.terms])
        for w in (lambda k: theta**k, lambda k: k * theta ** (k - 1) if k else 0)
    )
    p, slope = p / Fraction(2**48), slope / Fraction(2**48)
    q, field = fixed_point.scaled_linear(p.tolist(), chain)
    square = (p[0] ** 2 + p[1] ** 2) / 2
    missed = np.array([-slope[1], slope[0]]) - h * (np.array(field) / q + square * p)
    there = float((missed**2).sum()) ** 0.5
    assert 0.0 < there < fixed_point.defect(step, chain) < 1e-6


def test_the_half_chain_has_the_field_of_the_whole():
    from pendula.studies.certified.polynomials import linear

    given, draws = problem(half_width=3), np.random.default_rng(1)
    chain = fixed_point.half_chain(given, BITS)
    half = draws.normal(size=(2, 2, 4))
    whole = np.concatenate([half[..., :0:-1], half], axis=-1)
    expected = linear(whole, given)[..., 3:]
    assert frames.linear(half[..., None], chain)[..., 0] == pytest.approx(expected, rel=1e-13)
    q, exact = fixed_point.scaled_linear(half.reshape(2, -1).tolist(), chain)
    assert np.array(exact).reshape(half.shape) / q == pytest.approx(expected, rel=1e-13)


def test_the_tangent_polynomials_are_the_slope_of_the_flow():
    given = problem(end_time=0.05)
    chain, (step, *_) = steps_of(given, BITS, 30)
    size = 4 * chain.sites
    p = fixed_point.doubles(step, chain, 30)
    h = float(chain.interval / step.pieces)
    matrix = frames.sum_up(
        frames.tangents(np.eye(size).reshape(2, 2, chain.sites, size), p, h, chain, 24)
    ).reshape(size, size)
    for column in (0, 5, size - 1):
        state = [[own[0] for own in part] for part in step.terms]
        change = 2 ** (BITS - 30)
        state[column // (size // 2)][column % (size // 2)] += change
        moved = fixed_point.taylor(state, chain, chain.interval / step.pieces, 30)
        ends = (np.array(fixed_point.end(terms), object) for terms in (moved, step.terms))
        slope = np.subtract(*ends).ravel() / change
        assert matrix[:, column] == pytest.approx(slope.astype(float), abs=1e-8)


def test_a_bound_that_is_no_longer_small_is_infinite(right):
    _, chain, steps, _ = right
    tube = frames.begin(chain, 1.0)
    assert np.isinf(frames.distances(frames.advance(tube, steps[0], chain, 0.0))[2])


def _raised(steps, place, by):
    index, part, site, k = place
    terms = [[list(own) for own in each] for each in steps[index].terms]
    terms[part][site][k] += by
    return [*steps[:index], steps[index]._replace(terms=terms), *steps[index + 1 :]]


WRONG = {
    "a constant": lambda given, steps: steps_of(given.changed(gamma=0.7 + 1e-9))[1],
    "the data": lambda given, steps: steps_of(given.changed(initial=(1 + 1e-9) * given.initial))[1],
    "a coefficient": lambda given, steps: _raised(steps, (3, 0, 1, 5), 2 ** (BITS - 40)),
    "a jump": lambda given, steps: _raised(steps, (4, 1, 2, 0), 2 ** (BITS - 40)),
    "a step": lambda given, steps: steps[:4] + steps[5:],
}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_curve_is_found_out(name, right):
    given, chain, steps, bound = right
    wrong = WRONG[name](given, steps)
    off = apart(exact_end(wrong, chain), exact_end(steps, chain))
    found = walk(given, wrong, chain)
    assert found > 1e6 * bound
    assert found > 0.99 * off or name == "a step"


def test_the_data_must_be_even():
    for wrong in (problem(boundary="free"), problem(initial=on_sites({1: (1.0, 0.0)}))):
        with pytest.raises(fixed_point.NotEvenError):
            fixed_point.half_chain(wrong, BITS)


COMMITTED = sorted(ROOT.glob("tests/baseline/proofs/fig?_*.nc"))
BY_FRAMES = [path for path in COMMITTED if "solver_bits" in read(path).attrs]


@pytest.mark.parametrize("path", BY_FRAMES, ids=lambda path: path.stem)
def test_no_committed_bound_is_below_the_distance_to_the_reference(path):
    one, known = read(path), read(ROOT / f"tests/baseline/reference/{path.name}")
    count = one.sizes["tau"]
    assert np.allclose(one["tau"], known["tau"][:count], rtol=0.0, atol=1e-9)
    for name in ("linf", "l2"):
        assert (abs(one[name] - known[name].values[:, :count]) <= one["bound"]).all()
    assert one["bound"][-1] < 1e-9


@pytest.mark.parametrize("path", BY_FRAMES, ids=lambda path: path.stem)
def test_the_first_outputs_are_those_that_are_committed(path):
    one = read(path)
    given = Problem(
        constants=Constants.of(one.attrs),
        half_width=int(one.attrs["half_width"]),
        boundary=one.attrs["boundary"],
        initial=on_sites(read_initial(one.attrs["initial"])),
        end_time=0.05,
        output_step=0.025,
        solver={"name": "polynomials"},
    )
    keys = ("bits", "order", "outputs_per_frame")
    found = frames.certify(given, **{key: int(one.attrs[f"solver_{key}"]) for key in keys})
    assert (found.bound == one["bound"].values[:3]).all()
    assert (found.l2 == one["l2"].values[:, :3]).all()
