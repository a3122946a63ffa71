"""Lyapunov spectra and sections, against exact motions, sums that are known, and SciPy's events."""

import numpy as np
import pytest
from latticode import Case, Model, ModelError, abs2, cos, couple, lap, lyapunov, section
from latticode.configuration.files import ConfigurationError
from scipy.integrate import solve_ivp


def lorenz_96(p, x):
    return (x.right - x.left.left) * x.left - x + p.force


def test_the_exponents_of_a_linear_chain_are_the_eigenvalues_of_its_matrix():
    matrix = np.random.default_rng(1).normal(size=(6, 6))
    matrix = 0.3 * (matrix + matrix.T)
    model = Model(fields="x", parameters={"W": matrix}, dt=lambda p, x: couple(p.W, x))
    case = Case(model=model, sites=6, initial=np.zeros(6) + 1e-3, end_time=100)
    exact = np.sort(np.linalg.eigvalsh(matrix))[::-1]
    computed = lyapunov(case, count=6)
    np.testing.assert_allclose(computed["exponent"], exact, atol=1e-6)
    assert computed["exponent_error"].max() < 1e-3


def test_all_exponents_of_lorenz_96_add_up_to_the_divergence():
    model = Model(fields="x", parameters={"force": 8.0}, dt=lorenz_96)
    start = 8.0 + np.random.default_rng(2).normal(size=12)
    case = Case(model=model, sites=12, boundary="periodic", initial=start, end_time=40)
    computed = lyapunov(case, count=12)
    assert float(computed["exponent"].sum()) == pytest.approx(-12.0, abs=1e-6)
    assert float(computed["exponent"][0]) > 5 * float(computed["exponent_error"][0]) > 0.0


def test_imaginary_parts_that_nothing_reads_are_no_directions():
    def decay(p, x):
        return 1j * (-x.real - 0.1 * x.real**3)

    model = Model(fields="x", parameters={}, i_dt=decay)
    case = Case(model=model, sites=1, initial={0: [1e-3]}, end_time=40)
    assert float(lyapunov(case)["exponent"][0]) == pytest.approx(-1.0, abs=1e-4)
    with pytest.raises(ConfigurationError, match="give a whole number from 1 to 1"):
        lyapunov(case, count=2)


@pytest.mark.parametrize("solver", ["taylor", "dop853", "auto"])
@pytest.mark.parametrize(("direction", "first", "step"), [("up", 1.5, 2), ("both", 0.5, 1)])
def test_a_harmonic_oscillator_crosses_zero_each_half_turn(solver, direction, first, step):
    model = Model(fields="x", parameters={}, d2_dt2=lambda p, x: -x)
    chosen = {"name": "auto", "error": 1e-9} if solver == "auto" else solver
    case = Case(model=model, sites=1, initial={0: [1]}, end_time=50, solver=chosen)
    computed = section(case, lambda p, x: x, direction)
    expected = np.pi * (first + step * np.arange(computed.sizes["crossing"]))
    assert np.abs(computed["crossing_tau"] - expected).max() < 1e-12
    assert expected[-1] + step * np.pi > 50
    assert np.abs(computed["crossing_state"].sel(part="value")).max() < 1e-12


def test_a_section_by_velocities_neighbours_and_time_is_that_of_events_of_scipy():
    def d2_dt2(p, x, v):
        return 0.3 * lap(x) - x**3 - 0.1 * v

    model = Model(fields="x", parameters={"level": 0.05}, d2_dt2=d2_dt2)
    start = np.array([1.0, -0.3, 0.4, 0.2])

    def slope(t, y):
        x, v = y.reshape(2, -1)
        return np.concatenate([v, 0.3 * (np.roll(x, -1) - 2 * x + np.roll(x, 1)) - x**3 - 0.1 * v])

    def event(t, y):
        x, v = y.reshape(2, -1)
        return v[2] + 0.5 * x[3] - 0.05 * np.cos(t)

    event.direction = -1
    controls = {"method": "DOP853", "rtol": 1e-13, "atol": 1e-14, "max_step": 0.02}
    state = np.concatenate([start, 0 * start])
    exact = solve_ivp(slope, (0, 30), state, events=event, **controls).t_events[0]
    case = Case(model=model, sites=4, boundary="periodic", initial=start, end_time=30)
    computed = section(case, lambda p, x, v: v + 0.5 * x.right - p.level * cos(p.t), "down", site=2)
    assert computed.sizes["crossing"] == exact.size > 5
    assert np.abs(computed["crossing_tau"] - exact).max() < 1e-9


def test_a_complex_field_and_a_model_without_series_have_sections_too():
    turning = Model(fields="u", parameters={}, i_dt=lambda p, u: abs2(u) * u)
    case = Case(model=turning, half_width=1, initial={1: [2.0]}, end_time=3)
    computed = section(case, lambda p, u: u.real, "down", site=1)
    np.testing.assert_allclose(computed["crossing_tau"], np.pi / 8 * np.array([1, 5]), atol=1e-12)
    bouncing = Model(fields="x", parameters={}, d2_dt2=lambda p, x: -abs(x) / x)
    fall = Case(model=bouncing, sites=1, initial={0: [0.5]}, end_time=0.75, output_step=0.125)
    times = section(fall, lambda p, x: x - 0.375, "down")["crossing_tau"]
    assert float(times[0]) == pytest.approx(0.5, abs=1e-12)


def test_more_outputs_than_are_held_at_once_have_the_same_crossings():
    model = Model(fields="x", parameters={}, d2_dt2=lambda p, x: -x)
    case = Case(model=model, sites=1, initial={0: [1]}, end_time=40, output_step=0.02)
    computed = section(case, lambda p, x: x)
    expected = np.pi * (1.5 + 2 * np.arange(computed.sizes["crossing"]))
    assert (
        computed.sizes["crossing"] == 6
        and np.abs(computed["crossing_tau"] - expected).max() < 1e-12
    )


def test_what_is_no_section_or_spectrum_is_refused():
    model = Model(fields="u", parameters={}, i_dt=lambda p, u: lap(u))
    case = Case(model=model, sites=4, initial={0: [1]}, end_time=1)
    with pytest.raises(ConfigurationError, match="direction: is 'left'; give one of up"):
        section(case, lambda p, u: u.real, "left")
    with pytest.raises(ConfigurationError, match="site: is 4; the sites run from 0 to 3"):
        section(case, lambda p, u: u.real, site=4)
    with pytest.raises(ConfigurationError, match="when: is not a function"):
        section(case, 0.5)
    with pytest.raises(ModelError, match="returns a complex number; give a real one"):
        section(case, lambda p, u: u)
    with pytest.raises(ModelError, match="depends on no field"):
        section(case, lambda p, u: p.t)
    with pytest.raises(ConfigurationError, match="count: is 0; give a whole number from 1 to 8"):
        lyapunov(case, count=0)
    with pytest.raises(ConfigurationError, match="the spectrum has 1 error"):
        lyapunov(case.changed(end_time=1e6), count=8, hours=1e-6)
