"""Divergence times: growth known in closed form, and a chaotic case followed."""

import numpy as np
import pytest
from accepted import dataset
from pendula.measures.growth import is_chaotic, mean_rate, mean_rate_error
from pendula.studies.chaos import lyapunov
from pendula.studies.chaos.figures import draw_lyapunov, gather_lyapunov
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
    log = lyapunov.amplification(TAU, np.zeros_like(TAU), np.ones_like(TAU))
    assert lyapunov.predict(TAU, log, 1e-6) == np.inf


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
    assert found["chaotic"].values.tolist() == [0, 1]
    published = zip(*(found[name].values.reshape(4, -1) for name in
                      ("log_growth", "exponent", "exponent_error")), strict=True)  # fmt: skip
    pairs = [(one, parity) for one in cases.values() for parity in ("even", "odd")]
    chaotic = []
    for (problem, parity), (growth, rate, error) in zip(pairs, published, strict=True):
        one = lyapunov.follow_parity(problem, parity, 16.0, SEED, tolerance=1e-12)
        np.testing.assert_array_equal(growth, one.log_growth[0])
        assert rate == mean_rate(one.tau, growth, 8.0)
        assert error == mean_rate_error(one.tau, growth, 8.0)
        chaotic.append(is_chaotic(one.tau, growth, one.size))
    assert not any(chaotic[:2]) and sum(chaotic[2:]) == 1  # one of both is enough


def test_chaotic_runs_diverge_when_predicted_and_regular_ones_do_not(measured):
    cases, growth, _ = measured
    found = lyapunov.divergence_times(cases, [1e-4, 1e-7], growth)
    tau, even, l2 = (growth[name].values for name in ("tau", "log_growth", "l2"))
    log = lyapunov.amplification(tau, even[1, 0], l2[1])
    made = lyapunov.measure_divergence(cases["fig4_large"], [1e-4, 1e-7]).early / np.exp(log[8])
    seen = [lyapunov.predict(tau, log, each) for each in made]  # errors at tau = 2
    np.testing.assert_array_equal(found["divergence_predicted"].values[1], seen)
    regular, chaotic = found["divergence_predicted"].values
    assert np.isinf(regular).all() and np.isinf(found["divergence_measured"].values[0]).all()
    assert chaotic[0] < chaotic[1] < found["divergence_rounding"].values[1]
    np.testing.assert_allclose(found["divergence_measured"].values[1], chaotic, atol=3.0)


@pytest.mark.parametrize("pair, said", [("0", ""), ("1", " at first")])
def test_uneven_data_have_a_parity_at_first_alone(pair, said):
    drawn = gather_lyapunov(dataset("checks/lyapunov"))
    data = [f'{{"{pair}": [1.0, 0.1]}}'] * drawn.sizes["case"]
    (legend,) = draw_lyapunov(drawn.assign(initial=drawn["initial"].copy(data=data))).legends
    told = [text.get_text() for text in legend.get_texts()]
    assert told[-2:] == [f"even in $n${said}", f"odd in $n${said}"]
