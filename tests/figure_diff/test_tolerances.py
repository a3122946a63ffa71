"""The table of tolerances: which rule fits a curve, whether each is needed, and faulty tables."""

from pathlib import Path

import pytest
import xarray as xr
from pendula.datasets.netcdf import read
from pendula.figure_diff.baseline import recorded
from pendula.figure_diff.compare_data import (
    TOLERANCES,
    ToleranceError,
    curves,
    read_rules,
    rule_for,
)

BASELINE = Path(__file__).resolve().parents[1] / "baseline"


@pytest.fixture(scope="module")
def rules():
    """Return the rules of the project."""
    return read_rules(BASELINE)


def test_errors_of_rounding_size_are_compared_by_size(rules):
    residual = xr.Dataset({"error": ("sample", [3e-14, 1e-15])}, {"sample": [0, 1]})
    (curve, _) = curves(residual, "checks/any")
    assert rule_for(rules, curve.label, curve.largest).method == "magnitude"
    assert rule_for(rules, curve.label, 1.0).method == "pointwise"


def test_the_first_rule_that_fits_counts_and_the_last_one_takes_all(rules):
    assert rule_for(rules, "trajectories/fig4_small:l2 component=A", 5.0).horizon > 5
    assert rule_for(rules, "figures/fig3:l2 amplitude=small component=A", 5.0) is rules[-1]


def test_without_a_table_every_curve_is_regular(tmp_path):
    assert [rule.labels for rule in read_rules(tmp_path)] == [["*"]]


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ("rules: [{labels: ['*'], method: pointwise, limit: 1e-3}]", "rules.0.reason"),
        ("rules: [{labels: ['*'], method: about, limit: 1, reason: x}]", "rules.0.method"),
        ("rules: [{labels: ['*'], method: chaotic, limit: 1, reason: x, band: 1}]", "rules.0.band"),
        ("rules: [", "line 1"),
    ],
    ids=["without a reason", "unknown method", "unknown key", "no YAML"],
)
def test_a_faulty_table_is_refused_by_name_and_place(tmp_path, table, said):
    (tmp_path / TOLERANCES).write_text(table)
    with pytest.raises(ToleranceError, match=TOLERANCES) as refused:
        read_rules(tmp_path)
    assert said in str(refused.value)


def test_every_rule_is_the_first_that_fits_some_curve_of_the_baseline(rules):
    """A rule for a variable that was renamed, or that another rule hides, is named here."""
    used = []
    for name in recorded(BASELINE)["files"]:
        if name.endswith(".nc"):
            data = read(BASELINE / name)
            found = curves(data, name.removesuffix(".nc"))
            used += [rule_for(rules, curve.label, curve.largest) for curve in found]
    assert not [rule.labels for rule in rules if rule not in used]
