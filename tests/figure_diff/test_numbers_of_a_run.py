"""Planted faults in datasets: each is one line that names it; what may change passes."""

import made_up_results as made_up
import numpy as np
import pytest
import xarray as xr
from made_up_results import CHAOTIC, REGULAR, change_a, chaotic, regular
from pendula.datasets.netcdf import read, save
from pendula.figure_diff.baseline import MOST_NUMBERS, thin
from pendula.figure_diff.compare_data import curves
from pendula.figure_diff.findings import IDENTICAL, NEARLY
from pendula.figure_diff.tolerances import FILE, ToleranceError, read_rules, rule_for


@pytest.fixture
def rules(run):
    """Return the tolerances of the project."""
    return read_rules(run.accepted)


def test_an_identical_run_is_clean(any_environment):
    assert {found.status for found in any_environment.findings().values()} == {IDENTICAL}


def test_a_curve_off_by_a_hundredth(run):
    save(run.made / REGULAR, change_a(regular(), 1.01))
    (line,) = run.faults()
    assert line.startswith(f"different: {REGULAR}: l2 component=A is off by 0.01 of its scale")
    assert "at tau" in line and "1e-06 is allowed" in line and "\n" not in line


def test_rounding_is_nearly_the_same(run):
    save(run.made / REGULAR, change_a(regular(), 1 + 3e-7))
    assert run.findings()[REGULAR].status == NEARLY and not run.faults()


def test_a_chaotic_tail_may_take_another_path(any_environment):
    """In the numbers and in the picture of them."""
    save(any_environment.made / CHAOTIC, chaotic(seed=7))
    made_up.put(any_environment.made, "fig4", chaotic(seed=7))
    found = any_environment.findings()
    assert not any_environment.faults()
    assert found[CHAOTIC].status == found["figures/fig4.png"].status == NEARLY


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (chaotic(scale=3.0), "of it is allowed (and 1 more curves)"),
        (change_a(chaotic(), 1.3), "is off by 0.3 of its scale"),
        (chaotic(seed=7, horizon=6.0), "at tau = "),
    ],
    ids=["wilder tail", "another level", "parts too early"],
)
def test_a_chaotic_tail_may_not_change_its_nature(run, data, said):
    save(run.made / CHAOTIC, data)
    (line,) = run.faults()
    assert line.startswith(f"different: {CHAOTIC}: l2 component=") and said in line


def test_curves_that_came_and_went(run):
    save(run.made / REGULAR, regular().rename(l2="norm"))
    (line,) = run.faults()
    assert "l2 component=A is gone (and 1 more), norm component=A is new (and 1 more)" in line


def test_other_words_and_other_shapes(run):
    save(run.made / REGULAR, regular().isel(tau=slice(0, 1000)))
    assert "has the shape" in run.faults()[0]
    save(run.made / REGULAR, regular().assign(solver="ode23"))
    assert "solver is new" in run.faults()[0]


def test_gaps_are_found(run):
    save(run.made / REGULAR, regular().where(regular()["tau"] < 40))
    assert "has gaps (NaN) elsewhere" in run.faults()[0]


def test_errors_of_rounding_size_are_compared_by_size(rules):
    residual = xr.Dataset({"error": ("sample", [3e-14, 1e-15])}, {"sample": [0, 1]})
    (curve, _) = curves(residual, "checks/any")
    assert rule_for(rules, curve.label, curve.largest).method == "magnitude"
    assert rule_for(rules, curve.label, 1.0).method == "pointwise"


def test_a_damaged_dataset(run):
    path = run.made / REGULAR
    path.write_bytes(path.read_bytes()[:500])
    (line,) = run.faults()
    assert line.startswith(f"damaged: {REGULAR}: ") and "\n" not in line


def test_the_baseline_keeps_few_numbers(run):
    kept = read(run.accepted / REGULAR)
    assert sum(variable.size for variable in kept.variables.values()) <= MOST_NUMBERS
    large = xr.Dataset({"modulus": (("x", "y", "z"), np.ones((2, 61, 501)))})
    assert thin(large)["modulus"].shape == (2, 61, 63)


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
    (tmp_path / FILE).write_text(table)
    with pytest.raises(ToleranceError, match=FILE) as refused:
        read_rules(tmp_path)
    assert said in str(refused.value)
