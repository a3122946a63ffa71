"""The explicit methods: the published step control, outputs between steps, and their accuracy."""

import numpy as np
import plain
import pytest
import systems
from dimers import case_of, integrate
from latticode.integrators import DONE, INTERRUPTED, NOT_FINITE, STEP_TOO_SMALL
from latticode.integrators.taylor import ORDER
from latticode.simulation.simulate import simulate
from oracle import BOUNDARIES, power_series, random_chain, slope

METHODS = ("ode45", "dop853", "taylor")
each_method = pytest.mark.parametrize("name", METHODS)
EVALUATIONS = {
    "ode45": lambda tried, interpolated: 1 + 6 * tried,
    "dop853": lambda tried, interpolated: 2 + 12 * tried + 3 * interpolated,
    "taylor": lambda tried, interpolated: ORDER * tried,
}
"""How often each method evaluates the right-hand side, by the numbers of steps tried and of those
in which outputs are interpolated."""


def published_run(name, z, times, numbers, boundary, rtol):
    """Return the final state, and the numbers of accepted and rejected steps."""
    if name == "taylor":
        return plain.taylor(
            lambda u, order: power_series(u, numbers, boundary, order),
            z,
            times,
            rtol,
            1e-2 * rtol,
            ORDER,
        )
    return getattr(plain, name)(lambda u: slope(u, numbers, boundary), z, times, rtol, 1e-2 * rtol)


TOLERANCES = {"ode45": (1e-3, 1e-7), "dop853": (1e-3, 1e-10), "taylor": (1e-3, 1e-10)}
ON_CHAINS = [(name, rtol) for name, both in TOLERANCES.items() for rtol in both]


@pytest.mark.parametrize("boundary", BOUNDARIES)
@pytest.mark.parametrize(("name", "rtol"), ON_CHAINS)
def test_step_control_is_the_published_one_on_the_chain(name, rtol, boundary):
    z, times, numbers = 2 * random_chain(3), np.linspace(0.0, 4.0, 3), (0.7, 1.3, -4.0)
    solver = {"name": name, "rtol": rtol, "atol": 1e-2 * rtol}
    run = integrate(z, solver, 4.0, 2, numbers=numbers, boundary=boundary)
    final, steps, rejected = published_run(name, z, times, numbers, boundary, rtol)
    evaluations = EVALUATIONS[name](steps + rejected, 2)
    assert run.outcome == (DONE, 4.0, steps, rejected, evaluations)
    off = rtol if name == "taylor" else 1e-8  # whose steps have four digits
    np.testing.assert_allclose(run.final, final, atol=off)


@pytest.mark.parametrize("name", ["ode45", "dop853"])
@pytest.mark.parametrize(
    ("mu", "start", "times"),
    [
        (1.0, 2.0 + 0.5j, [0.0, 10.0, 20.0]),
        (30.0, 2.0 + 0.5j, [0.0, 10.0, 20.0]),
        (1.0, 2.0 + 0.5j, [0.0, 1e-9, 5.0]),  # the first steps grow as fast as they may
        (300.0, 2.0 + 0.0j, [0.0, 0.5, 1.0]),  # the first steps are far too long
    ],
)
def test_step_control_is_the_published_one_through_sudden_turns(name, mu, start, times):
    _, final, outcome = systems.run(name, mu, times, (1e-4, 1e-6), start)
    published, z = getattr(plain, name), np.array([start])
    expected, steps, rejected = published(systems.oscillator(mu), z, times, 1e-4, 1e-6)
    assert (outcome.steps, outcome.rejected) == (steps, rejected)
    assert rejected > 0
    assert final == pytest.approx(expected[0], rel=1e-8)


@pytest.mark.parametrize("end", np.linspace(1.0, 1.1, 7))
def test_the_last_step_of_ode45_is_stretched_as_published(end):
    _, _, outcome = systems.run("ode45", 1.0, [0.0, end], (1e-8, 1e-10))
    start = np.array([systems.START])
    _, steps, _ = plain.ode45(systems.oscillator(1.0), start, [0.0, end], 1e-8, 1e-10)
    assert outcome.steps == steps


@pytest.mark.parametrize(
    ("start", "controls", "end"),
    [
        (2.0 + 0.5j, (1e-6, 1e-6), 10.0),
        (0.1 + 0.5j, (1e-3, 1e-6), 10.0),
        (1e-9 + 0j, (0.0, 1e-3), 10.0),  # almost at rest: a hundred times the least guess
        (2.0 + 0.5j, (10.0, 10.0), 100.0),  # slow, but not at rest
        (2.0 + 0.5j, (10.0, 10.0), 0.25),
    ],
)
def test_the_first_step_of_dop853_is_the_published_one(start, controls, end):
    f, z = systems.oscillator(1.0), np.array([start])
    expected = plain.dop853_start(f, z, f(z), *controls, end)
    outcome = stopped_after_a_step("dop853", end, controls, start)
    assert outcome.rejected == 0
    assert outcome.time == pytest.approx(min(expected, end), rel=1e-9)


@pytest.mark.parametrize(
    ("name", "end", "steps"),
    [
        ("ode45", 10.0, 10),  # none is longer than a tenth of the run
        ("dop853", 10.0, 10),  # 1e-6 (6^n - 1) / 5 first passes 10 at n = 10
        ("dop853", 1e5, 14),  # the first guess is 2e-5, twice the shortest step that is allowed
        ("taylor", 10.0, 1),
    ],
)
@pytest.mark.parametrize("first", [0.0, -1e5])
def test_a_system_at_rest_is_done_in_a_known_number_of_steps(name, end, steps, first):
    times = [first, first + end]
    _, final, outcome = systems.run(name, 1.0, times, (1e-6, 1e-6), start=0j)
    assert (final, outcome.status) == (0j, DONE)
    assert (outcome.steps, outcome.rejected) == (steps, 0)


@pytest.mark.parametrize(("beyond", "expected"), [(-1e-3, 3), (5e-10, 3), (5e-9, 4)])
def test_dop853_leaves_no_remnant_of_the_order_of_rounding(beyond, expected):
    """At rest the third step is 36e-6 long and ends at 43e-6; a step may stretch by 1e-9."""
    times = [0.0, 43e-6 + beyond * 36e-6]
    assert systems.run("dop853", 1.0, times, (1e-6, 1e-6), start=0j)[2].steps == expected


@pytest.mark.parametrize(("beyond", "expected"), [(-1e-3, 1), (5e-10, 1), (1e-9, 1), (5e-9, 2)])
def test_taylor_leaves_no_remnant_of_the_order_of_rounding(beyond, expected):
    end = stopped_after_a_step("taylor", 10.0).time * (1.0 + beyond)
    assert systems.run("taylor", 1.0, [0.0, end], (1e-6, 1e-6))[2].steps == expected


@pytest.mark.parametrize(
    ("name", "lengths", "tolerance", "order"),
    [("dop853", (0.3, 0.15), 1e3, (8.8, 10.0)), ("taylor", (0.5, 0.4), 1e9, (16.5, 18.5))],
)
def test_a_single_step_errs_by_one_power_more_than_its_order(name, lengths, tolerance, order):
    errors = np.zeros(2)
    for i, length in enumerate(lengths):
        for start in (2 + 0.5j, 1 - 1j, 0.5 + 2j, -1 + 1.5j):
            arguments = [0.0, length], (tolerance, tolerance), start
            _, final, outcome = systems.run(name, 1.0, *arguments)
            assert outcome.steps == 1
            errors[i] += abs(final - systems.accurate(1.0, [0.0, length], start)[-1])
    slope = np.log(errors[0] / errors[1]) / np.log(lengths[0] / lengths[1])
    assert order[0] < slope < order[1]


@pytest.mark.parametrize(
    ("name", "controls", "error"),
    [
        ("ode45", (1e-6, 1e-8), 2e-5),
        ("dop853", (1e-10, 1e-10), 1e-9),
        ("taylor", (1e-12, 1e-12), 1e-11),
    ],
)
def test_outputs_between_steps_are_as_good_as_the_steps_and_do_not_change_them(
    name, controls, error
):
    times = np.linspace(0.0, 10.0, 1001)
    values, final, outcome = systems.run(name, 1.0, times, controls)
    assert outcome.steps < 100  # most outputs lie between steps
    np.testing.assert_allclose(values, systems.accurate(1.0, times), atol=error)
    assert values[-1] == pytest.approx(final, rel=1e-14)
    fewer = systems.run(name, 1.0, times[[0, 1, 500, 1000]], controls)
    assert (fewer[1], fewer[2].steps) == (final, outcome.steps)


@each_method
def test_sites_at_rest_do_not_change_the_steps(name):
    """A root-mean-square norm would be diluted by them; without coupling nothing else could."""
    wide = np.zeros((2, 41), complex)
    wide[:, 20] = 2.0, 1.0
    runs = [
        integrate(z, name, 3.0, 3, numbers=(0.0, 1.0, -4.0), boundary="free")
        for z in (wide[:, 20:21], wide)
    ]
    assert runs[0].outcome == runs[1].outcome
    np.testing.assert_array_equal(runs[0].final[:, 0], runs[1].final[:, 20])


# --- The paper's cases --------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("case", "by_10", "by_50", "chaos"),
    [
        ("fig2_small", 2e-6, 9e-6, 0.25),
        ("fig2_large", 2e-4, 9.5e-4, 0.25),
        ("fig3_small", 2e-6, 8e-6, 0.25),
        ("fig3_large", 5e-5, 1.7e-4, 0.6),  # 1e-4 to 2.5e-4: chaos makes it a matter of luck
        ("fig4_small", 1.6e-4, 1.7e-3, 0.5),
        ("fig4_large", 1.6e-4, 1.7e-3, 0.5),
    ],
)
def test_the_energy_drifts_as_much_as_by_matlabs_ode45(case, by_10, by_50, chaos):
    run = simulate(case_of(case, solver="ode45", end_time=50.0, output_step=0.025))
    drift = np.abs(run.conserved["H"] - run.conserved["H"][0])
    assert drift[run.tau <= 10].max() == pytest.approx(by_10, rel=0.25)
    assert drift.max() == pytest.approx(by_50, rel=chaos)


# --- Where a run is given up --------------------------------------------------------------------


def stopped_after_a_step(name, end, controls=(1e-6, 1e-6), start=systems.START):
    """Return the outcome of a run that is stopped when its first step is taken."""
    record, stop = systems.stopped_by(1, 3)
    times = np.array([0.0, 1e-15 * end, end])
    return systems.run(name, 1.0, times, controls, start, record, stop)[2]


@each_method
def test_a_solution_that_blows_up_is_reported_where_it_does(name):
    """Steps too short for the run tell it, whatever the time at which the run begins."""
    times, arguments = np.linspace(0.0, 10.0, 41), ((1e-7, 1e-9), 3.0 + 1.0j)
    values, _, first = systems.run(name, -1.0, times, *arguments)
    assert first.status != DONE
    np.testing.assert_array_equal(np.isfinite(values), times <= first.time)
    early = systems.run(name, -1.0, times - 10.0, *arguments)[2]
    assert early.status == first.status
    assert (early.time + 10.0, early.steps) == pytest.approx((first.time, first.steps), abs=5e-2)


@pytest.mark.parametrize("name", ["dop853", "taylor"])
def test_a_step_of_a_ten_milliardth_of_the_run_is_refused(name):
    controls = (1e-6, 1e-6)
    h = stopped_after_a_step(name, 10.0, controls).time
    assert 0.01 < h < 1.0
    done, refused = (stopped_after_a_step(name, span * h, controls) for span in (0.99e10, 1.01e10))
    assert (done.status, done.time) == (INTERRUPTED, h)
    if name == "taylor":
        assert refused == (STEP_TOO_SMALL, 0.0, 1, 0, ORDER)
    else:  # it takes twice the shortest step, since data at rest would otherwise be refused
        assert refused.time == pytest.approx(2.0 * 1e-10 * 1.01e10 * h)


@pytest.mark.parametrize(("end", "status"), [(9.9, INTERRUPTED), (10.1, STEP_TOO_SMALL)])
def test_a_step_of_ode45_of_a_ten_milliardth_of_the_run_is_refused(end, status):
    """The first step reaches to the first output; there the run is stopped."""
    record, stop = systems.stopped_by(1, 3)
    times = [0.0, 1e-9, end]
    _, _, outcome = systems.run("ode45", 1.0, times, (1e-6, 1e-6), record=record, stop=stop)
    steps = int(status == INTERRUPTED)
    assert outcome == (status, steps * 1e-9, steps, 0, 1 + 6 * steps)


@pytest.mark.parametrize(("mu", "status"), [(1e18, STEP_TOO_SMALL), (1e200, NOT_FINITE)])
def test_a_step_of_ode45_is_never_shorter_than_what_the_time_resolves(mu, status):
    """The run is so short that a ten-milliardth of it is less than sixteen spacings."""
    _, _, outcome = systems.run("ode45", mu, [1.0, 1.0 + 1e-6], (1e-6, 1e-6))
    assert outcome == (status, 1.0, 0, 0, 7)


def test_a_series_beyond_the_doubles_is_told_from_a_step_too_short():
    _, _, outcome = systems.run("taylor", 1.0, [0.0, 1.0], (1e-6, 1e-6), start=1e200 + 1e200j)
    assert outcome == (NOT_FINITE, 0.0, 1, 0, ORDER)
