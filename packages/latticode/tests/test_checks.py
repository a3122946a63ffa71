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
REGULAR = Case(model=CUBIC, initial={3: [1.5]}, half_width=6, end_time=10)
CHAOTIC = Case(
    model=CUBIC,
    parameters={"c": 1},
    half_width=2,
    boundary="periodic",
    end_time=60,
    initial={-1: [1.5], 0: ["2j"], 1: [-1.1]},
)


@pytest.fixture(scope="module")
def regular():
    return check(REGULAR)


def test_a_regular_run_is_true_to_the_end_and_its_state_is_found(regular):
    assert float(regular["largest_difference"]) < 1e-11 and regular["divergence_time"] == np.inf
    assert regular["chaotic"] == 0 and float(regular["conserved_drift"][0]) < 1e-12
    assert int(regular["breather"].sel(component="u").idxmax()) == 3
    assert float(regular["breather_growth"]) == 0.0 and regular.attrs["second_name"] == "dop853"
    for name, variable in regular.variables.items():
        assert variable.attrs["long_name"] and variable.attrs["units"], name


def test_a_chaotic_run_is_told_from_a_coarse_one():
    checked = check(CHAOTIC)
    assert checked["chaotic"] == 1 and float(checked["exponent"]) > 0.05
    two = Case(model=CUBIC, half_width=1, initial={0: [1.2], 1: ["0.9j"]}, end_time=100)
    coarse = check(two.changed(solver={"name": "crank_nicolson", "step": 0.025}))
    assert coarse["chaotic"] == 0 and np.isfinite(coarse["divergence_time"])


def test_a_refused_second_run_leaves_its_reason_and_no_numbers():
    problem = REGULAR.kind.of(REGULAR.shown_problem() | {"initial": {0: (1e-160,)}})
    second = run_again(problem, simulate(REGULAR))
    assert "squares vanish" in second.attrs["second_refusal"]
    assert np.isnan(second["largest_difference"]) and np.isnan(second["difference"]).all()
