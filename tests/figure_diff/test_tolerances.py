"""The table of tolerances: which rule fits a curve, whether each is needed, and faulty tables."""

from pathlib import Path

import numpy as np
import pytest
import scipy.special
import xarray as xr
from pendula.figure_diff import DIFFERENT, NEARLY, compare_curves
from pendula.figure_diff.compare_curves import curves
from pendula.figure_diff.structure import STATISTICS
from pendula.figure_diff.tolerances import (
    MOST_GROWTH,
    TOLERANCES,
    Allowance,
    Spread,
    Spreads,
    ToleranceError,
    allowances,
    read_rules,
    read_tolerances,
    rule_for,
)

ABOUT = {"curve": "x", "rule": "r", "scale": 1.0, "horizon": 9.0, "copy_of": ""}
APART = ("apart_mean", "apart_spread", "apart_freedom")
BASELINE = Path(__file__).resolve().parents[1] / "baseline"


@pytest.fixture(scope="module")
def rules():
    """Return the rules of the project."""
    return read_rules(BASELINE)


def test_errors_of_rounding_size_are_compared_by_size(rules):
    residual = xr.Dataset({"error": ("sample", [3e-14, 1e-15])}, {"sample": [0, 1]})
    (curve, _) = curves(residual, "checks/any")
    assert rule_for(rules, curve.label, curve.largest).method == "size"
    assert rule_for(rules, curve.label, 1.0).method == "pointwise"


def test_no_rounding_error_may_grow_beyond_its_bound(rules):
    """The ensemble holds residuals that are zero in some runs: their spreads say nothing."""
    sizes = {rule.name for rule in rules if rule.method == "size"}
    mine = [each for each in read_tolerances(BASELINE).spreads if each.rule in sizes]
    largest = max(np.nanmax(each.allowed) for each in mine)
    assert len(mine) > 100 and largest == pytest.approx(np.log(MOST_GROWTH))


@pytest.mark.parametrize(("growth", "status"), [(900, NEARLY), (1100, DIFFERENT)])
def test_an_error_of_rounding_that_grows_is_found(growth, status):
    """The name is that of a residual whose measured spread allows a factor of e^16."""
    label = ("boundary", ["dirichlet", "free"])
    was, now = (
        xr.Dataset(
            {"eigenvalue_error": (("boundary", "point"), np.full((2, 7), size))}, dict([label])
        )
        for size in (1e-13, 1e-13 * growth)
    )
    found = compare_curves.compare("checks/dispersion.nc", was, now, read_tolerances(BASELINE))
    assert found.status == status, found.line


def test_the_first_rule_that_fits_counts_and_the_last_one_takes_all(rules):
    assert rule_for(rules, "trajectories/fig4_small:l2 component=A", 5.0).method == "chaotic"
    assert rule_for(rules, "figures/fig3:l2 amplitude=small component=A", 5.0) is rules[-1]


def test_without_a_table_every_curve_is_regular(tmp_path):
    assert [rule.labels for rule in read_rules(tmp_path)] == [["*"]]


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ("rules: [{name: x, labels: ['*'], method: pointwise}]", "rules.0.reason"),
        ("rules: [{name: x, labels: ['*'], method: about, reason: x}]", "rules.0.method"),
        ("rules: [{name: x, labels: ['*'], method: chaotic, reason: x, band: 1}]", "rules.0.band"),
        ("rules: [", "line "),
    ],
    ids=["without a reason", "unknown method", "unknown key", "no YAML"],
)
def test_a_faulty_table_is_refused_by_name_and_place(tmp_path, table, said):
    (tmp_path / TOLERANCES).write_text(table)
    with pytest.raises(ToleranceError, match=TOLERANCES) as refused:
        read_rules(tmp_path)
    assert said in str(refused.value)


def test_every_large_allowance_has_its_reason_in_the_table():
    large = [each for each in allowances(*read_tolerances(BASELINE)) if each.needs_a_reason]
    assert len(large) > 20
    assert not [f"{each.rule.name}: {each.statistic}" for each in large if not each.rule.wide]


def test_the_spreads_were_measured_with_the_rules_of_the_table(rules):
    """Otherwise run `python -m benchmarks.spreads measure` again."""
    names = [rule.name for rule in rules]
    assert len(set(names)) == len(names)
    assert {each.rule for each in read_tolerances(BASELINE).spreads} == set(names[:-1])


def test_an_allowance_above_a_tenth_needs_a_reason(rules):
    assert Allowance(rules[0], "level", 0.11, 0.02).needs_a_reason
    assert not Allowance(rules[0], "level", 0.1, 0.02).needs_a_reason


def test_a_log_becomes_a_fraction(rules):
    columns = np.full(len(STATISTICS), np.nan)
    columns[[list(STATISTICS).index(name) for name in ("level", "width")]] = 0.2
    rule = next(rule for rule in rules if rule.name == "tails of Fig 4")
    spread = Spread(rule.name, 1.0, 9.0, columns, np.full(2, np.nan), "")
    found = {each.statistic: each.largest for each in allowances([rule], Spreads({"x": spread}))}
    assert found == {"level": pytest.approx(0.2), "width": pytest.approx(np.expm1(0.2))}


def test_the_allowed_differences_come_from_students_law():
    """Of 13 numbers that are compared, one of two right runs is accused in one of 100 runs."""
    curve = {name: (("curve",), [value]) for name, value in ABOUT.items()}
    grid = ("curve", "of")
    spread = xr.Dataset(
        curve
        | {
            "spread": (grid, np.full((1, len(STATISTICS)), 0.5)),
            "freedom": (grid, np.full((1, len(STATISTICS)), 9.0)),
            **{name: (("curve", "distance"), [[np.nan] * 2]) for name in APART},
        },
        attrs={"members": 10},
    )
    (entry,) = Spreads.of_dataset(spread)
    quantile = -scipy.special.stdtrit(9, 0.01 / len(STATISTICS) / 2)  # Student's
    assert entry.allowed == pytest.approx(np.sqrt(2) * 0.5 * quantile)


def test_every_rule_is_the_first_that_fits_some_curve(rules, kept_curves):
    """A rule for a variable that was renamed, or that another rule hides, is named here."""
    measured = {each.rule for each in read_tolerances(BASELINE).spreads}
    used = [rule for rule in rules if rule.name in measured]
    used += [rule_for(rules, curve.label, curve.largest) for curve in kept_curves]
    assert not [rule.labels for rule in rules if rule not in used]
