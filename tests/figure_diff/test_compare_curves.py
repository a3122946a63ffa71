"""Planted faults in datasets: each is one line that names it; what may change passes."""

import made_up_results as made_up
import pytest
from made_up_results import CHAOTIC, REGULAR, change_a, chaotic, regular
from pendula.datasets.netcdf import save
from pendula.figure_diff import IDENTICAL, NEARLY


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
        (chaotic(seed=7, scale=3.0), "has the roughness"),
        (change_a(chaotic(), 1.3), "is off by 0.2"),
        (chaotic(seed=7, horizon=6.0), "at tau = "),
    ],
    ids=["wilder tail", "another level", "parts too early"],
)
def test_a_chaotic_tail_may_not_change_its_nature(run, data, said):
    save(run.made / CHAOTIC, data)
    (line,) = run.faults()
    assert line.startswith(f"different: {CHAOTIC}: l2 ") and said in line


def test_curves_that_came_and_went(run):
    save(run.made / REGULAR, regular().rename(l2="norm"))
    (line,) = run.faults()
    assert line == f"different: {REGULAR}: l2 is gone; norm is new"


def test_other_words_and_other_shapes(run):
    save(run.made / REGULAR, regular().isel(tau=slice(0, 1000)))
    fewer = "l2 is float64 (component 2, tau 1000) in place of float64 (component 2, tau 2001)"
    assert fewer in run.faults()[0]
    save(run.made / REGULAR, regular().assign(solver="ode23"))
    assert "solver is new" in run.faults()[0]


def test_gaps_are_found(run):
    early = regular()["l2"].where(regular()["tau"] < 40)
    save(run.made / REGULAR, regular().assign(l2=early))
    assert "has gaps (NaN or infinity) elsewhere" in run.faults()[0]


def test_a_damaged_dataset(run):
    path = run.made / REGULAR
    path.write_bytes(path.read_bytes()[:500])
    (line,) = run.faults()
    assert line.startswith(f"damaged: {REGULAR}: ") and "\n" not in line
