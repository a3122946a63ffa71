"""How many snapshots a run keeps where its case leaves that open."""

import pytest
from pendula.configuration.cases import MOST_NUMBERS, choose_every
from pendula.configuration.messages import ConfigurationError, load


@pytest.mark.parametrize(
    ("outputs", "columns"),
    [(200, 200), (399, 399), (400, 200), (2000, 200), (1601, 1601), (100_000, 200), (402, 201)],
)
def test_a_picture_has_two_hundred_columns_or_more_and_the_last_state_among_them(outputs, columns):
    assert outputs / choose_every(outputs, 61) == columns


def test_short_runs_keep_every_output_and_long_chains_fewer():
    assert choose_every(40, 61) == 1
    sites = 1_000_001
    assert 2 * sites * (2000 // choose_every(2000, sites)) <= MOST_NUMBERS
    assert choose_every(2000, MOST_NUMBERS) == 2000


def test_the_paper_and_what_is_asked_for_stay_as_they_are():
    case = {"omega": 1, "end_time": 10, "snapshot_step": 2.5}
    settings = load({"cases": {"asked": case, "open": {"omega": 1, "end_time": 10}}})
    assert settings.shown_problem("asked")["snapshot_every"] == 100
    assert settings.shown_problem("open")["snapshot_every"] == 2
    assert settings.problem("open")["snapshot_every"] == 0


def test_a_snapshot_step_longer_than_the_run_is_a_fault():
    case = {"omega": 1, "end_time": 10, "snapshot_step": 20}
    with pytest.raises(ConfigurationError, match=r"cases.a.snapshot_step: is longer"):
        load({"cases": {"a": case}})


def test_a_sweep_may_have_a_solver_of_its_own():
    sweep = {"case": "a", "half_widths": [2], "windows": [[1, 2]], "solver": "dop853"}
    settings = load({"cases": {"a": {"omega": 1}}, "sweeps": {"s": sweep}})
    assert settings.swept_problem("s")["solver"]["name"] == "dop853"
    assert settings.swept_problem("s", "ode45")["solver"]["name"] == "ode45"
