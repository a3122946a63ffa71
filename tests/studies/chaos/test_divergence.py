"""Divergence times: growth known in closed form, and a chaotic case followed."""

import numpy as np
import pytest
from accepted import dataset
from pendula.measures.growth import is_chaotic, mean_rate, mean_rate_error
from pendula.studies.chaos import lyapunov
from pendula.studies.chaos.figures import draw_lyapunov, gather_lyapunov
from pendula.studies.chaos.lyapunov import follow_parity
from problems import problem_of

TAU, SEED = np.linspace(0.0, 20.0, 1001), 20170817


def test_errors_made_all_along_grow_to_their_integral():
    rate = 1.5
    log = lyapunov.amplification(TAU, rate * TAU, np.ones_like(TAU))
    np.testing.assert_allclose(log[5:], np.log(np.expm1(rate * TAU[5:]) / rate), atol=0.02)


def test_a_solution_that_grows_like_its_errors_keeps_their_relative_size():
    log = lyapunov.amplification(TAU, 1.5 * TAU, np.exp(1.5 * TAU))
    np.testing.assert_allclose(log[1:], np.log(TAU[1:]), atol=1e-9)


def test_a_thousandth_of_the_error_diverges_later_by_its_logarithm_over_the_rate():
    log = lyapunov.amplification(TAU, 2.0 * TAU, np.ones_like(TAU))
    early, late = (lyapunov.predict(TAU, log, error) for error in (1e-6, 1e-9))
    assert late - early == pytest.approx(np.log(1e3) / 2.0, abs=0.02)


def test_what_never_grows_never_diverges():
    log = lyapunov.amplification(TAU, np.zeros_like(TAU), np.ones_like(TAU))
    assert lyapunov.predict(TAU, log, 1e-6) == np.inf


def test_a_chaotic_run_diverges_when_predicted():
    problem = problem_of("fig4_small", half_width=15, end_time=16.0, output_step=0.125)
    growth = follow_parity(problem, "even", 16.0, SEED)
    log = lyapunov.amplification(growth.tau, growth.log_growth[0], growth.size)
    found = lyapunov.measure_divergence(problem, [1e-6])
    made = found.early[0] / np.exp(log[lyapunov.early_index(growth.tau)])
    assert found.time[0] == pytest.approx(lyapunov.predict(growth.tau, log, made), abs=3.0)


@pytest.fixture(scope="module")
def measured():
    """Two short chains, one of them chaotic, and what is published of their growth."""
    changes = {"half_width": 4, "end_time": 16.0, "output_step": 0.25}
    cases = {name: problem_of(name, **changes) for name in ("fig3_small", "fig4_large")}
    return cases, *lyapunov.largest_exponents(cases, 16.0, SEED)


def test_published_exponents_are_those_of_an_even_and_an_odd_vector(measured):
    cases, found, about = measured
    assert about["end_time"] == 16.0 and about["seed"] == SEED
    assert found["parity"].values == ["even", "odd"]
    assert found["parity"].long_name == "parity of the tangent vector in n"
    assert found["chaotic"].values.tolist() == [0, 1]
    chaotic = np.zeros((2, 2), bool)
    for i, problem in enumerate(cases.values()):
        for j, parity in enumerate(("even", "odd")):
            one = follow_parity(problem, parity, 16.0, SEED, tolerance=1e-12)
            tau, growth = one.tau, one.log_growth[0]
            np.testing.assert_array_equal(found["tau"].values, tau)
            np.testing.assert_array_equal(found["log_growth"].values[i, j], growth)
            assert found["exponent"].values[i, j] == mean_rate(tau, growth, 8.0)
            assert found["exponent_error"].values[i, j] == mean_rate_error(tau, growth, 8.0)
            chaotic[i, j] = is_chaotic(tau, growth, one.size)
            if parity == "even":
                np.testing.assert_array_equal(found["l2"].values[i], one.size)
    assert chaotic[1].sum() == 1 and not chaotic[0].any()  # one of both is enough


@pytest.mark.parametrize("pair, said", [("0", ""), ("1", " at first")])
def test_uneven_data_have_a_parity_at_first_alone(pair, said):
    drawn = gather_lyapunov(dataset("checks/lyapunov"))
    data = [f'{{"{pair}": [1.0, 0.1]}}'] * drawn.sizes["case"]
    (legend,) = draw_lyapunov(drawn.assign(initial=drawn["initial"].copy(data=data))).legends
    told = [text.get_text() for text in legend.get_texts()]
    assert told[-2:] == [f"even in $n${said}", f"odd in $n${said}"]


def test_published_divergence_times_are_those_of_errors_seen_early_and_of_rounding(measured):
    cases, growth, _ = measured
    found = lyapunov.divergence_times(cases, [1e-6, 1e-9], growth)
    assert found["rtol"].values.tolist() == [1e-6, 1e-9]
    tau = growth["tau"].values
    for i, problem in enumerate(cases.values()):
        log = lyapunov.amplification(tau, growth["log_growth"].values[i, 0], growth["l2"].values[i])
        runs = lyapunov.measure_divergence(problem, [1e-6, 1e-9])
        np.testing.assert_array_equal(found["divergence_measured"].values[i], runs.time)
        seen = [lyapunov.predict(tau, log, made) for made in runs.early / np.exp(log[8])]
        np.testing.assert_array_equal(found["divergence_predicted"].values[i], seen)
        assert found["divergence_rounding"].values[i] == lyapunov.predict(tau, log, 2.0**-53)
    regular, chaotic = found["divergence_predicted"].values
    assert np.isinf(regular).all() and chaotic[0] < chaotic[1] < 16.0
    assert chaotic[1] < found["divergence_rounding"].values[1]


def test_errors_are_read_off_at_two():
    assert lyapunov.early_index(TAU) == 100
