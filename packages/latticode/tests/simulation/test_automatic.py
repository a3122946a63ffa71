"""auto: the error that was asked for is kept, or the run is refused."""

import pytest
from dimers import case_of, chain
from latticode.equations.initial_values import on_sites
from latticode.measures.difference import norm_difference
from latticode.simulation.simulate import IntegrationError, simulate
from oracle import CASES


def run(case, error, end_time):
    solver = error if isinstance(error, dict) else {"name": "auto", "error": error}
    return simulate(case_of(case, solver=solver, end_time=end_time, output_step=0.1))


def taylor(tolerance):
    return {"name": "taylor", "rtol": tolerance, "atol": tolerance}


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("error", [1e-2, 1e-6, 1e-11])
def test_the_error_that_was_asked_for_is_kept(case, error):
    exact = run(case, taylor(1e-15), 5.0)
    trajectory = run(case, error, 5.0)
    assert norm_difference(trajectory.linf, trajectory.l2, exact.linf, exact.l2).max() < error
    assert trajectory.solver["estimated_error"] <= error == trajectory.solver["requested_error"]


def test_what_double_precision_cannot_do_is_refused_with_the_time_it_lasts():
    with pytest.raises(IntegrationError, match=r"^auto: .* agree to 1e-06 only before t = 1\d"):
        run("fig4_small", 1e-6, 50.0)


@pytest.mark.parametrize("pair", [(0.0, 0.0), (1.0, 0.0)])
def test_what_stays_at_rest_is_no_obstacle(pair):
    """Zero differs from zero by nothing, and no norm of it is divided by."""
    numbers = (1.0, 0.0, -4.0)  # without a drive B stays at rest where it starts so
    solver = {"name": "auto", "error": 1e-9}
    trajectory = simulate(chain(on_sites({0: pair}), numbers, solver=solver, half_width=2))
    assert trajectory.solver["estimated_error"] <= 1e-9
