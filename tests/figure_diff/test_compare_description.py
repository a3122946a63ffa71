"""How far a description may follow data that have moved: just below and just above each bound."""

import math

import pytest
from pendula.figure_diff import DIFFERENT, NEARLY, Motion
from pendula.figure_diff.compare_description import FOLLOWS, INVISIBLE, judge


def figure(data="other", scale="linear", limits=(0.0, 8.0), points=100, at=(4.0, 4.0), **curve):
    """Return the description of one panel with one curve and one text in it."""
    axis = {"scale": scale, "limits": list(limits), "ticks": ["0", "8"]}
    text = {"text": "top", "stands_at": list(at), "off": "data"}
    drawn = {"label": "$A$", "points": points, "x": [0.0, 8.0], "y": [1.0, 2.0]} | curve
    panel = {"x": {**axis, "limits": [0.0, 8.0]}, "y": axis, "curves": [drawn], "texts": [text]}
    if scale == "log":
        panel["x"] = {"scale": "linear", "limits": [0.0, 8.0]}
    return {"data": data, "size_in_inches": [7.0, 4.0], "panels": [panel]}


def status(was: dict, now: dict, motion: Motion) -> str:
    return judge("figures/it.json", was, now, motion).status


@pytest.mark.parametrize(
    ("motion", "allowed"),
    [(Motion.SEEN, FOLLOWS), (Motion.UNSEEN, INVISIBLE), (Motion.WRONG, INVISIBLE)],
)
@pytest.mark.parametrize("sign", [1, -1])
def test_limits_follow_by_a_part_of_the_axis(motion, allowed, sign):
    was = figure(data="accepted")
    for part, expected in ((0.99, NEARLY), (1.01, DIFFERENT)):
        top = 8 * (1 + sign * part * allowed)
        assert status(was, figure(limits=(0.0, top)), motion) == expected


@pytest.mark.parametrize("end", [0, 1])
def test_limits_of_a_logarithmic_axis_follow_by_its_decades(end):
    was = figure(data="accepted", scale="log", limits=(1e-4, 1.0), at=(4.0, 0.1))
    for part, expected in ((0.99, NEARLY), (1.01, DIFFERENT)):
        limits = [1e-4, 1.0]
        limits[end] *= 10 ** (4 * part * FOLLOWS)
        now = figure(scale="log", limits=limits, at=(4.0, 0.1))
        assert status(was, now, Motion.SEEN) == expected


def test_a_logarithmic_axis_may_not_reach_zero():
    was = figure(data="accepted", scale="log", limits=(1e-4, 1.0))
    assert status(was, figure(scale="log", limits=(0.0, 1.0)), Motion.SEEN) == DIFFERENT


@pytest.mark.parametrize("axis", [0, 1])
def test_a_text_follows_by_a_part_of_the_axis(axis):
    was = figure(data="accepted")
    for part, expected in ((0.99, NEARLY), (1.01, DIFFERENT)):
        at = [4.0, 4.0]
        at[axis] += 8 * part * FOLLOWS
        assert status(was, figure(at=at), Motion.SEEN) == expected


def test_a_text_at_a_place_of_the_panel_does_not_follow():
    was, now = figure(data="accepted"), figure(at=(4.0, 4.1))
    for each in (was, now):
        each["panels"][0]["texts"][0]["off"] = "axes fraction"
    assert status(was, now, Motion.SEEN) == DIFFERENT


def test_many_points_may_half_vanish_and_few_may_vanish():
    was = figure(data="accepted")
    assert status(was, figure(points=50), Motion.SEEN) == NEARLY
    assert status(was, figure(points=49), Motion.SEEN) == DIFFERENT
    assert status(was, figure(points=201), Motion.SEEN) == DIFFERENT
    few = figure(data="accepted", points=9)
    assert status(few, figure(points=0), Motion.SEEN) == NEARLY
    assert status(figure(data="accepted", points=10), figure(points=0), Motion.SEEN) == DIFFERENT


@pytest.mark.parametrize("motion", [Motion.SEEN, Motion.UNSEEN])
def test_no_word_and_no_colour_follows(motion):
    was = figure(data="accepted", colour="#e8402f")
    assert status(was, figure(colour="#e8402f"), motion) == NEARLY
    assert status(was, figure(colour="#e8402e"), motion) == DIFFERENT
    assert status(was, figure(colour="#e8402f", label="$B$"), motion) == DIFFERENT
    assert status(was, figure(), motion) == DIFFERENT


def test_ranges_of_curves_follow_chaos_however_far_and_regular_data_not():
    was = figure(data="accepted")
    assert status(was, figure(y=[1.0, 7.9]), Motion.SEEN) == NEARLY
    assert status(was, figure(y=[1.0, 2.1]), Motion.UNSEEN) == DIFFERENT
    assert status(was, figure(y=[1.0, math.nextafter(2.0, 3.0)]), Motion.UNSEEN) == NEARLY


def test_accepted_data_excuse_nothing():
    was = figure(data="accepted")
    now = figure(data="accepted", y=[1.0, math.nextafter(2.0, 3.0)])
    assert status(was, now, Motion.NONE) == DIFFERENT


def test_the_gravest_difference_is_told_first():
    was = figure(data="accepted")
    now = figure(limits=(0.0, 20.0), label="$B$")
    found = judge("figures/it.json", was, now, Motion.SEEN)
    assert found.says == ('panel 1: curve 1 \'$A$\': label is "$B$" in place of "$A$" (and 1 more)')
