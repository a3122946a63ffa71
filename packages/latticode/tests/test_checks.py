"""The checks of a run: true, chaotic, too coarse, refused; and its localised state."""

import numpy as np
import pytest
from latticode import Case, Model, abs2, check, lap, simulate
from latticode.checks import run_again

CUBIC = Model(
    fields="u",
    parameters={"c": 0.3},
    i_dt=lambda p, u: p.c * lap(u) + abs2(u) * u,
    conserved=lambda p, u: {"P": abs2(u)},
)
STILL = Case(model=CUBIC, initial={3: [1.5]}, half_width=6, end_time=10)
CHAOTIC = Case(
    model=CUBIC,
    parameters={"c": 1},
    half_width=2,
    boundary="periodic",
    end_time=60,
    initial={-1: [1.5], 0: ["2j"], 1: [-1.1]},
)


@pytest.fixture(scope="module")
def still():
    return check(STILL)


def test_a_regular_run_is_true_to_the_end_and_its_state_is_found(still):
    assert float(still["largest_difference"]) < 1e-11 and still["divergence_time"] == np.inf
    assert still["chaotic"] == 0 and float(still["conserved_drift"][0]) < 1e-12
    assert int(still["breather"].sel(component="u").idxmax()) == 3
    assert float(still["breather_growth"]) == 0.0 and still.attrs["second_name"] == "dop853"
    for name, variable in still.variables.items():
        assert variable.attrs["long_name"] and variable.attrs["units"], name


def test_a_chaotic_run_is_told_from_a_coarse_one():
    found = check(CHAOTIC)
    assert found["chaotic"] == 1 and float(found["exponent"]) > 0.05
    two = Case(model=CUBIC, half_width=1, initial={0: [1.2], 1: ["0.9j"]}, end_time=100)
    coarse = check(two.changed(solver={"name": "crank_nicolson", "step": 0.025}))
    assert coarse["chaotic"] == 0 and np.isfinite(coarse["divergence_time"])


def test_a_refused_second_run_leaves_its_reason_and_no_numbers():
    problem = STILL.kind.of(STILL.shown_problem() | {"initial": {0: (1e-160,)}})
    again = run_again(problem, simulate(STILL))
    assert "squares vanish" in again.attrs["second_refusal"]
    assert np.isnan(again["largest_difference"]) and np.isnan(again["difference"]).all()
