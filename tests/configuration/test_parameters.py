"""What a configuration means: defaults from the paper, controls of solvers, snapshots."""

import pytest
from latticode.configuration.cases import choose_every
from pendula.configuration.messages import load


def test_what_is_left_out_takes_the_papers_value_and_the_default_solver():
    assert load({"cases": {"mine": {"omega": 8}}}).problem("mine") == {
        "omega": 8.0,
        "epsilon": 1.0,
        "gamma": 1.0,
        "half_width": 30,
        "boundary": "dirichlet",
        "initial": {0: (1 + 0j, 0.1 + 0j)},
        "start_time": 0.0,
        "end_time": 50.0,
        "output_step": 0.025,
        "solver": {"name": "taylor", "rtol": 1e-14, "atol": 1e-14},
        "snapshot_every": 0,
        "snapshots_at": [],
        "keep": "moduli",
    }


def test_a_named_solver_takes_the_shared_controls_and_a_given_one_its_own():
    sweep = {"case": "named", "half_widths": [2], "windows": [[1, 2]], "solver": "taylor"}
    settings = load(
        {
            "cases": {
                "named": {"omega": 1, "solver": "dop853"},
                "given": {"omega": 1, "solver": {"name": "dop853", "atol": 1e-3}},
            },
            "solvers": {"dop853": {"rtol": 1e-9}},
            "sweeps": {"s": sweep},
        }
    )
    assert settings.problem("named")["solver"] == {"name": "dop853", "rtol": 1e-9, "atol": 1e-13}
    assert settings.problem("given")["solver"] == {"name": "dop853", "rtol": 1e-9, "atol": 1e-3}
    assert settings.problem("named", "ode45")["solver"]["name"] == "ode45"
    assert settings.swept_problem("s")["solver"]["name"] == "taylor"
    assert settings.swept_problem("s", "ode45")["solver"]["name"] == "ode45"


@pytest.mark.parametrize(
    ("outputs", "columns"),
    [(40, 40), (200, 200), (399, 399), (400, 200), (1601, 1601), (100_000, 200), (402, 201)],
)
def test_a_picture_has_two_hundred_columns_or_more_and_the_last_state_among_them(outputs, columns):
    assert outputs / choose_every(outputs, 61) == columns
