"""ode45: the Dormand-Prince pair and MATLAB's step control, alone and on the paper's cases."""

import numpy as np
import plain
import pytest
import systems
from on_chains import data_of, integrate, numbers_of
from oracle import CASES, SOLVERS, random_chain, slope
from pendula.integrators import DONE, INTERRUPTED, NOT_FINITE, STEP_TOO_SMALL, ode45
from pendula.simulation.lattice import find_reduction
from trees import defect

E = np.array([ode45.E1, 0.0, ode45.E3, ode45.E4, ode45.E5, ode45.E6, ode45.E7])


@pytest.fixture(scope="module")
def matrix():
    """Return the stages' coefficients, read off the compiled code with unit slopes."""
    a = np.zeros((7, 7))
    for stage in range(2, 8):
        ode45.combine(stage, np.zeros(7), 1.0, np.eye(7), a[stage - 1])
    return a


def interpolation_weights(fraction):
    """Return the weights of the interpolant, read off the compiled code with unit slopes."""
    k, out = np.zeros((7, 2, 9)), np.zeros((2, 9))
    k[:, 0, 1:8] = np.eye(7)
    ode45.interpolate(fraction, np.zeros((2, 9)), 1.0, k, out)
    return out[0, 1:8]


def run_case(case, end_time, **tolerances):
    """Return the run of a case with outputs at steps of 0.025, by half of the chain."""
    z, solver = data_of(case), SOLVERS["ode45"] | tolerances
    return integrate(
        z, solver, end_time, round(40 * end_time), find_reduction(z), numbers=numbers_of(case)
    )


def test_the_solution_is_of_order_five(matrix):
    assert defect(matrix, matrix[6], 5) < 1e-14
    assert defect(matrix, matrix[6], 6) > 1e-5


def test_the_error_estimate_is_of_order_four(matrix):
    assert defect(matrix, E, 4, expected=0.0) < 1e-14
    assert defect(matrix, E, 5, expected=0.0) > 1e-5


def test_the_estimate_is_dormand_and_princes():
    published = [5179 / 57600, 0, 7571 / 16695, 393 / 640, -92097 / 339200, 187 / 2100, 1 / 40]
    solution = [35 / 384, 0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84, 0]
    np.testing.assert_allclose(E, np.subtract(solution, published), atol=1e-15)


@pytest.mark.parametrize("fraction", [0.0, 0.1, 0.5, 0.9, 1.0])
def test_the_interpolant_is_of_order_four_everywhere(matrix, fraction):
    assert defect(matrix, interpolation_weights(fraction), 4, fraction) < 1e-14


def test_the_interpolant_joins_the_ends_of_the_step(matrix):
    np.testing.assert_allclose(interpolation_weights(0.0), np.zeros(7), atol=1e-15)
    np.testing.assert_allclose(interpolation_weights(1.0), matrix[6], atol=1e-14)


@pytest.mark.parametrize("threshold", [1e-2, 1.5])
def test_the_error_is_the_largest_of_a_complex_component(threshold):
    rng = np.random.default_rng(0)
    k, y, w = rng.normal(size=(7, 4, 5)), rng.normal(size=(4, 5)), rng.normal(size=(4, 5))
    z, new = (u[0::2, 1:-1] + 1j * u[1::2, 1:-1] for u in (y, w))
    error = np.tensordot(E, k[:, 0::2, 1:-1] + 1j * k[:, 1::2, 1:-1], 1)
    expected = np.max(np.abs(error) / np.maximum(plain.larger(z, new), threshold))
    actual = ode45.relative_error(y, w, k, threshold, np.zeros((4, 5)))
    assert actual == pytest.approx(expected, rel=1e-13)


def test_a_nan_is_never_a_small_error():
    k, y = np.zeros((7, 2, 4)), np.ones((2, 4))
    k[3, 0, 1] = np.nan
    assert not ode45.relative_error(y, y, k, 0.01, np.zeros((2, 4))) < np.inf


@pytest.mark.parametrize("longest", [1e-6, 10.0])
def test_the_first_step_is_matlabs(longest):
    rng = np.random.default_rng(1)
    y, slopes = rng.normal(size=(4, 5)), rng.normal(size=(4, 5))
    z, f = (u[0::2, 1:-1] + 1j * u[1::2, 1:-1] for u in (y, slopes))
    rate = np.max(np.abs(f) / np.maximum(np.abs(z), 0.7)) / (0.8 * 1e-5**0.2)
    step = ode45.initial_step(y, slopes, 0.7, 1e-5, longest)
    assert step == pytest.approx(min(longest, 1 / rate), rel=1e-13)


@pytest.mark.parametrize("rtol", [1e-3, 1e-5, 1e-7])
@pytest.mark.parametrize("outputs", [3, 401])
def test_step_control_is_the_published_one_on_the_chain(rtol, outputs):
    z, times, numbers = 2 * random_chain(3), np.linspace(0.0, 4.0, outputs), (1.0, 1.0, -4.0)
    solver = {"name": "ode45", "rtol": rtol, "atol": 1e-2 * rtol}
    fast = integrate(z, solver, 4.0, outputs - 1, numbers=numbers, boundary="free")
    final, steps, rejected = plain.ode45(
        lambda u: slope(u, numbers, "free"), z, times, rtol, 1e-2 * rtol
    )
    assert (fast.outcome.steps, fast.outcome.rejected) == (steps, rejected)
    assert fast.outcome.evaluations == 1 + 6 * (steps + rejected)
    np.testing.assert_allclose(fast.final, final, atol=1e-8)


@pytest.mark.parametrize(
    ("mu", "start", "times"),
    [
        (1.0, 2.0 + 0.5j, [0.0, 10.0, 20.0]),
        (30.0, 2.0 + 0.5j, [0.0, 10.0, 20.0]),
        (1.0, 2.0 + 0.5j, [0.0, 1e-9, 5.0]),  # the first steps grow as fast as they may
        (300.0, 2.0 + 0.0j, [0.0, 0.5, 1.0]),  # the first steps are far too long
    ],
)
def test_step_control_is_the_published_one_through_sudden_turns(mu, start, times):
    _, final, outcome = systems.run("ode45", mu, times, (1e-4, 1e-6), start)
    expected, steps, rejected = plain.ode45(
        systems.oscillator(mu), np.array([start]), times, 1e-4, 1e-6
    )
    assert (outcome.steps, outcome.rejected) == (steps, rejected)
    assert rejected > 0
    assert final == pytest.approx(expected[0], rel=1e-8)


@pytest.mark.parametrize("end", np.linspace(1.0, 1.1, 15))
def test_the_last_step_is_stretched_as_published(end):
    _, _, outcome = systems.run("ode45", 1.0, [0.0, end], (1e-8, 1e-10))
    start = np.array([systems.START])
    _, steps, _ = plain.ode45(systems.oscillator(1.0), start, [0.0, end], 1e-8, 1e-10)
    assert outcome.steps == steps


def test_no_step_is_longer_than_a_tenth_of_the_span():
    _, _, outcome = systems.run("ode45", 1.0, [0.0, 10.0], (1e-6, 1e-6), start=0j)
    assert outcome.steps == 10


def test_outputs_between_steps_are_as_good_as_the_steps():
    times = np.linspace(0.0, 10.0, 1001)
    values, final, outcome = systems.run("ode45", 1.0, times, (1e-6, 1e-8))
    assert outcome.steps < 100  # most outputs are interpolated
    np.testing.assert_allclose(values, systems.accurate(1.0, times), atol=2e-5)
    assert values[-1] == pytest.approx(final, rel=1e-14)


def test_sites_at_rest_do_not_change_the_steps():
    """A root-mean-square norm would be diluted by them; without coupling nothing else could."""
    wide = np.zeros((2, 41), complex)
    wide[:, 20] = 2.0, 1.0
    runs = [
        integrate(z, "ode45", 3.0, 3, numbers=(0.0, 1.0, -4.0), boundary="free")
        for z in (wide[:, 20:21], wide)
    ]
    assert runs[0].outcome == runs[1].outcome
    np.testing.assert_array_equal(runs[0].final[:, 0], runs[1].final[:, 20])


@pytest.mark.parametrize("case", CASES)
def test_the_papers_cases_err_by_no_more_than_the_sum_of_the_steps(case, scipy_solution):
    """A step may err by rtol times the largest amplitude; unamplified, the errors just add up."""
    run = run_case(case, 2.0)
    error = np.abs(run.final - scipy_solution(case, 2.0)).max()
    assert error < run.outcome.steps * 1e-7 * run.linf.max()


@pytest.mark.parametrize("case", ["fig2_small", "fig3_small"])
def test_a_tenth_of_the_tolerance_makes_a_tenth_of_the_error(case, scipy_solution):
    errors = [
        np.abs(run_case(case, 2.0, rtol=r, atol=r / 100).final - scipy_solution(case, 2.0)).max()
        for r in (1e-7, 1e-8)
    ]
    assert errors[0] / errors[1] == pytest.approx(10.0, rel=0.2)


def test_the_papers_tolerances_cost_a_known_number_of_evaluations():
    assert run_case("fig3_large", 10.0).outcome.evaluations == pytest.approx(6769, rel=0.01)


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
def test_the_energy_drifts_as_much_as_matlabs(case, by_10, by_50, chaos):
    run = run_case(case, 50.0)
    drift = np.abs(run.energy - run.energy[0])
    assert drift[run.tau <= 10].max() == pytest.approx(by_10, rel=0.25)
    assert drift.max() == pytest.approx(by_50, rel=chaos)


def test_a_solution_that_blows_up_is_reported_where_it_does():
    times = np.linspace(0.0, 10.0, 41)
    values, _, outcome = systems.run("ode45", -1.0, times, (1e-7, 1e-9), start=3.0 + 1.0j)
    assert outcome.status != DONE
    np.testing.assert_array_equal(np.isfinite(values), times <= outcome.time)


def test_a_run_that_begins_before_zero_is_given_up_where_any_other_is():
    """A solution that blows up is told by steps too short for the run, whatever its first time."""
    (status, *here), (other, *there) = systems.given_up("ode45"), systems.given_up("ode45", -10.0)
    assert status == other != DONE
    assert there == pytest.approx(here, abs=5.0e-2)


@pytest.mark.parametrize(
    ("t", "expected"), [(0.0, 2.0**-1070), (1.0, 2.0**-48), (-2.0, 2.0**-47), (1e-300, 2.0**-1045)]
)
def test_the_shortest_step_is_sixteen_spacings(t, expected):
    assert ode45.spacing(t) == expected


@pytest.mark.parametrize("place", [(0, 1), (1, 3), (2, 1), (3, 3)])
def test_the_error_of_any_part_of_any_site_counts_but_not_those_of_ghosts(place):
    k, y = np.zeros((7, 4, 5)), np.ones((4, 5))
    k[:, :, [0, -1]] = 1e3 * np.arange(7.0)[:, None, None]
    k[6][place] = 2.0
    found = ode45.relative_error(y, y, k, 1e-2, np.zeros((4, 5)))
    assert found == pytest.approx(2.0 * abs(ode45.E7) / np.sqrt(2.0), rel=1e-13)


def test_interpolating_leaves_ghosts_alone():
    out = np.full((2, 5), 7.0)
    ode45.interpolate(0.5, np.ones((2, 5)), 0.1, np.zeros((7, 2, 5)), out)
    np.testing.assert_array_equal(out, [[7.0, 1.0, 1.0, 1.0, 7.0]] * 2)


@pytest.mark.parametrize(("end", "status"), [(9.9, INTERRUPTED), (10.1, STEP_TOO_SMALL)])
def test_a_step_of_a_ten_milliardth_of_the_run_is_refused(end, status):
    """The first step reaches to the first output; there the run is stopped."""
    record, stop = systems.stopped_by(1, 3)
    times = [0.0, 1e-9, end]
    _, _, outcome = systems.run("ode45", 1.0, times, (1e-6, 1e-6), record=record, stop=stop)
    taken = int(status == INTERRUPTED)
    assert outcome == (status, taken * 1e-9, taken, 0, 1 + 6 * taken)


@pytest.mark.parametrize(("mu", "status"), [(1e18, STEP_TOO_SMALL), (1e200, NOT_FINITE)])
def test_a_step_is_never_shorter_than_what_the_time_resolves(mu, status):
    """The run is so short that a ten-milliardth of it is less than sixteen spacings."""
    _, _, outcome = systems.run("ode45", mu, [1.0, 1.0 + 1e-6], (1e-6, 1e-6))
    assert outcome == (status, 1.0, 0, 0, 7)


@pytest.mark.parametrize("first", [-8.0, 8.0])
def test_the_time_at_which_a_run_begins_does_not_matter(first):
    times = np.array([0.0, 2.0**-20, 8.0])
    _, final, outcome = systems.run("ode45", 1.0, times, (1e-6, 1e-6))
    _, other, there = systems.run("ode45", 1.0, times + first, (1e-6, 1e-6))
    assert there[2:] == outcome[2:] and there.time == first + 8.0
    assert other == pytest.approx(final, rel=1e-9)
    _, _, rest = systems.run("ode45", 1.0, [first, first + 10.0], (1e-6, 1e-6), start=0j)
    assert rest.steps == 10
