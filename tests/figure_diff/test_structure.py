"""The statistics of tails: each tells one fault, and none depends on what it must not."""

import numpy as np
import pytest
from pendula.figure_diff.structure import DISTANCES, STATISTICS, describe, distances

T = np.linspace(0, 40, 1601)
CURVE = 5 + 0.3 * np.sin(1.3 * T) + 0.2 * np.sin(2.9 * T + 1) + 0.01 * T
"""It moves as smoothly as norms do, and rises."""


def told(values: np.ndarray, start: int = 0) -> dict[str, float]:
    return dict(zip(STATISTICS, describe(np.atleast_2d(values), start), strict=True))


def test_the_statistics_are_what_they_say():
    found = told(CURVE)
    assert found["level"] == pytest.approx(CURVE.mean())
    assert found["width"] == pytest.approx(np.log(CURVE.std()))
    assert (found["top"], found["bottom"]) == (CURVE.max(), CURVE.min())
    slope = np.polyfit(T, CURVE, 1)[0]
    assert found["slope"] == pytest.approx(slope * T[-1])
    assert found["roughness"] == pytest.approx(np.log(np.sqrt(np.mean(np.diff(CURVE) ** 2))))
    assert found["wander"] == pytest.approx(
        np.log(np.sqrt(np.mean((CURVE[100:] - CURVE[:-100]) ** 2)))
    )


def test_time_that_is_reversed_turns_slope_and_lean():
    saw = np.where(T % 2 < 1.8, T % 2, 9 * (2 - T % 2)) + 0.1 * T
    forwards, backwards = told(saw), told(saw[::-1])
    for name in ("slope", "lean"):
        assert backwards[name] == pytest.approx(-forwards[name]) and abs(forwards[name]) > 0.5
    for name in ("level", "width", "top", "bottom", "roughness", "bend", "jump", "wander"):
        assert backwards[name] == pytest.approx(forwards[name])


@pytest.mark.parametrize(
    ("change", "name", "least"),
    [
        (lambda c: 1.1 * c, "level", 0.1 * CURVE.mean()),
        (lambda c: c.mean() + 1.5 * (c - c.mean()), "width", np.log(1.5)),
        (lambda c: np.random.default_rng(0).permutation(c), "roughness", 2.0),
        (lambda c: np.round(c, 1), "bend", 1.0),
        (lambda c: c + 0.5 * (T > 20), "jump", 3.0),
        (lambda c: c[::2].repeat(2)[: c.size], "roughness", 0.3),
        (lambda c: c + 0.5 * np.sin(0.6 * T), "wander", 0.2),
        (lambda c: c + 0.01 * T, "slope", 0.4),
    ],
    ids=[
        "factor",
        "wilder",
        "noise",
        "few digits",
        "step",
        "half of the samples",
        "swing",
        "trend",
    ],
)
def test_a_fault_changes_its_statistic(change, name, least):
    assert abs(told(change(CURVE))[name] - told(CURVE)[name]) >= 0.999 * least


def test_a_step_at_the_horizon_counts_and_what_lies_before_does_not():
    start = 400
    raised = np.where(np.arange(T.size) < start, CURVE, 1.09 * CURVE)
    assert told(raised, start)["jump"] > told(CURVE, start)["jump"] + 3
    other_past = np.where(np.arange(T.size) < start - 2, 0, CURVE)
    assert told(other_past, start) == told(CURVE, start)


def test_what_is_not_finite_is_counted_by_kind_and_left_out():
    values = CURVE.copy()
    values[[3, 5, 6, 8, 9, 10]] = np.nan, np.inf, np.inf, -np.inf, -np.inf, -np.inf
    found = told(values)
    counts = [found[name] for name in ("gaps", "infinities", "negative infinities")]
    assert counts == [1, 2, 3] and found["level"] == pytest.approx(
        np.delete(CURVE, [3, 5, 6, 8, 9, 10]).mean()
    )


def test_a_single_number_has_a_level_and_nothing_that_needs_several():
    found = told(np.array([7.0]))
    assert found["level"] == 7 and np.isnan(found["top"]) and np.isnan(found["slope"])


def test_a_constant_has_no_spread_and_breaks_nothing():
    found = told(np.full(100, 2.0))
    assert found["width"] < -600 and found["lean"] == 0


def test_distances_see_only_the_tail_and_what_is_finite():
    other = CURVE.copy()
    other[:10] += 100
    other[700] += 3
    other[800] = np.nan
    found = dict(zip(DISTANCES, distances(CURVE[None], other[None], 10), strict=True))
    assert found["farthest"] == pytest.approx(np.log(3))
    assert found["apart"] == pytest.approx(np.log(3 / np.sqrt(T.size - 11)))
    assert np.isnan(distances(CURVE[None, :3], other[None, :3])).all()
