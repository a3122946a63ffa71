"""NaN in place of numbers, in every chaotic curve of the accepted results."""

from pathlib import Path

import numpy as np
import pytest
from pendula.figure_diff.compare_curves import deviation
from pendula.figure_diff.tolerances import read_tolerances, rule_for

BASELINE = Path(__file__).resolve().parents[1] / "baseline"


@pytest.fixture(scope="module")
def moving(kept_curves):
    """Return each curve of numbers that other roundings move, with its rule and its spread."""
    rules, spreads = read_tolerances(BASELINE)
    found = []
    for curve in kept_curves:
        rule = rule_for(rules, curve.label, curve.largest)
        spread = spreads.of(curve.label, rule)
        if spread is not None and np.isfinite(curve.values).any():
            found.append((curve._replace(values=curve.values.astype(float)), rule, spread))
    return found


def test_a_curve_of_nothing_but_nan_is_a_fault(moving):
    assert len(moving) > 1000
    passed = [
        curve.label
        for curve, rule, spread in moving
        if not off(curve, all_nan(curve), rule, spread)
    ]
    assert passed == []


def test_a_nan_hides_no_other_fault(moving):
    """A curve that is off without it must be off with it."""
    passed = []
    for curve, rule, spread in moving:
        far = curve._replace(values=1e3 * curve.values)
        one = far._replace(values=np.array(far.values))
        one.values.flat[int(np.isfinite(far.values).argmax())] = np.nan
        long = curve.values.size > 8
        if long and off(curve, far, rule, spread) and not off(curve, one, rule, spread):
            passed.append(curve.label)
    assert passed == []


def all_nan(curve):
    return curve._replace(values=np.full_like(curve.values, np.nan))


def off(curve, made, rule, spread) -> bool:
    """Return whether the comparison counts `made` in place of `curve` as a fault."""
    return deviation(curve, made, rule, spread).excess > 1
