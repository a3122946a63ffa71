"""What a run takes, in words, and what is told of too much."""

import pytest
from latticode import Case, Model, abs2, lap, simulate, survey, sweep
from latticode.configuration.cost import RunCost, demand, name_excess, steps_of
from latticode.configuration.files import ConfigurationError

MORE = "more than a million"
LIMITS = {"hours": 1.0, "gigabytes": 8.0}


@pytest.mark.parametrize(
    ("cost", "words"),
    [
        (RunCost(0.3, 1e3), "less than a second and 1 MB of memory"),
        (RunCost(90, 2.1e9), "about 2 minutes and 2.1 GB of memory"),
        (RunCost(5e4, 1.5e13), "about 14 hours and 15 TB of memory"),
        (RunCost(4e5, 0), "about 5 days and 1 MB of memory"),
        (RunCost(1e30, float("inf")), f"{MORE} years and {MORE} terabytes of memory"),
        (RunCost(float("inf"), 1e30), f"{MORE} years and {MORE} terabytes of memory"),
    ],
)
def test_costs_are_said_in_words(cost, words):
    assert str(cost) == words


def test_a_little_too_much_memory_is_not_printed_as_what_is_allowed():
    message = name_excess(RunCost(1.0, 8.01e9), LIMITS)
    assert "a little over 8 GB of memory, but limits.gigabytes allows 8 GB;" in message
    assert "about 1 second and 9 GB of memory" in name_excess(RunCost(1.0, 9e9), LIMITS)


# --- How many steps a run takes

CUBIC = Model(fields="u", parameters={"c": 1.0}, i_dt=lambda p, u: p.c * lap(u) + abs2(u) * u)
SPRING = Model(
    fields="x", parameters={"k": 1e6, "drag": 4e3}, d2_dt2=lambda p, x, v: -p.k * x - p.drag * v
)


def case_of(model, **keys):
    return Case(**{"model": model, "half_width": 5, "initial": {0: [1.0]}, "end_time": 20} | keys)


@pytest.mark.parametrize("solver", ["taylor", "dop853", "ode45"])
@pytest.mark.parametrize("amplitude", [1.0, 5.0])
def test_steps_of_waves_are_estimated_within_a_factor_of_three(solver, amplitude):
    case = case_of(CUBIC, initial={0: [amplitude], 1: [0.8 * amplitude]}, solver=solver)
    problem = case.problem()
    run = simulate(case)
    steps = run.attrs["steps"] + run.attrs["rejected_steps"]
    assert 1 / 3 < steps_of(problem["solver"], problem, demand(problem))[0] / steps < 3


@pytest.mark.parametrize("k", [1e6, 1e7, 1e8])
def test_a_stiff_spring_turns_at_the_root_of_its_constant_and_is_run(k):
    """It was said to take 13 minutes at k = 1e6, and refused at 1e7."""
    case = case_of(SPRING, parameters={"k": k, "drag": 4.0 * k**0.5}, half_width=1, end_time=50)
    assert case.cost(case.problem()).seconds < 30.0
    if k < 1e8:
        assert abs(float(simulate(case)["final"][0, 0, 1])) < 1e-6


def test_a_limit_is_raised_by_the_argument_that_its_message_names():
    """Each was refused with a key of the configuration, and memory could not be allowed at all."""
    large = case_of(CUBIC, half_width=10_000_000, end_time=0.1, output_step=0.1)
    way_out = "8 GB; make it smaller, or raise it by the argument gigabytes"
    with pytest.raises(ConfigurationError, match=way_out):
        simulate(large)
    with pytest.raises(ConfigurationError, match="by the argument gigabytes"):
        sweep(large, [10_000_000], windows=[(0, 0.1)])
    small = case_of(CUBIC)
    with pytest.raises(ConfigurationError, match="gigabytes allows 1e-06 GB"):
        simulate(small, gigabytes=1e-6)
    with pytest.raises(ConfigurationError, match=r"hours allows 1e-12 h; .* by the argument hours"):
        survey(small, {"c": [1.0]}, hours=1e-12)
    assert survey(small, {"c": [1.0]}, gigabytes=20).attrs["failed_runs"] == 0


def test_a_long_chain_needs_less_memory_than_a_ring():
    """The series of a few blocks suffice, but not for a ring (tests of long_taylor)."""
    for half_width, share in ((1_000, 1.0), (10**6, 0.65)):
        memory = [
            cost(case.shown_problem()).memory
            for boundary in ("free", "periodic")
            for case in [
                case_of(CUBIC, half_width=half_width, initial={1: [1.0]}, boundary=boundary)
            ]
            for cost in [case.cost]
        ]
        assert memory[0] / memory[1] == pytest.approx(share, rel=0.15)


def test_checks_cost_in_proportion_to_the_time_and_hold_two_runs_and_a_matrix():
    short, long = (case_of(CUBIC, end_time=end, output_step=0.5) for end in (1000, 8000))
    alone, checked = (
        [cost(case.shown_problem()) for case in (short, long)]
        for cost in (short.cost, short.cost_with_checks)
    )
    assert checked[0].seconds / alone[0].seconds > 3 and checked[1].memory / alone[1].memory > 2
    assert 4 < checked[1].seconds / checked[0].seconds < 9
    wide, wider = (case_of(CUBIC, half_width=m, initial={1: [1.0]}) for m in (249, 251))
    matrix = [case.cost_with_checks(case.shown_problem()) for case in (wide, wider)]
    assert matrix[0].seconds > 10 > matrix[1].seconds and matrix[0].memory > 7e7
