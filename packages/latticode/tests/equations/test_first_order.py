"""Real fields of first order by `dt`: against SciPy on plain NumPy, and what is refused."""

import numpy as np
import pytest
from latticode import Case, Model, ModelError, check, lap, simulate, sin
from latticode.configuration.files import ConfigurationError
from scipy.integrate import solve_ivp

FITZHUGH_NAGUMO = """
from latticode import lap

fields = ("v", "w")
parameters = {"diffusion": 1.0, "a": 0.7, "b": 0.8, "slow": 0.08, "current": 0.5}

def dt(p, v, w):
    return (
        p.diffusion * lap(v) + v - v**3 / 3 - w + p.current,
        p.slow * (v + p.a - p.b * w),
    )
"""


def lorenz(p, x, y, z):
    return 10 * (y - x), x * (28 - z) - y, x * y - 8 / 3 * z


def fitzhugh_nagumo_by_scipy(start, end_time):
    def slope(t, state):
        v, w = state.reshape(2, -1)
        spread = np.roll(v, -1) - 2 * v + np.roll(v, 1)
        rates = spread + v - v**3 / 3 - w + 0.5, 0.08 * (v + 0.7 - 0.8 * w)
        return np.concatenate(rates)

    run = solve_ivp(slope, (0, end_time), start.ravel(), method="DOP853", rtol=1e-12, atol=1e-12)
    return run.y[:, -1].reshape(start.shape)


@pytest.mark.parametrize("solver", ["taylor", "dop853"])
def test_a_ring_of_fitzhugh_nagumo_units_follows_scipy(tmp_path, solver):
    (tmp_path / "nerve.py").write_text(FITZHUGH_NAGUMO)
    start = np.random.default_rng(1).normal(size=(2, 11))
    ring = Case(
        model=tmp_path / "nerve.py",
        half_width=5,
        boundary="periodic",
        initial={n - 5: start[:, n] for n in range(11)},
        end_time=20,
        solver={"name": solver, "rtol": 1e-12, "atol": 1e-12},
    )
    run = simulate(ring)
    assert run["part"].values.tolist() == ["value"]
    exact = fitzhugh_nagumo_by_scipy(start, 20)
    assert np.abs(run["final"].values[0] - exact).max() < 1e-10


def test_dt_has_the_bits_of_an_imaginary_rate_of_a_real_part():
    def by_i_dt(p, x):
        return 1j * (sin(x.real.right - x.real) - 0.1 * x.real)

    models = (
        Model(fields="x", parameters={}, dt=lambda p, x: sin(x.right - x) - 0.1 * x),
        Model(fields="x", parameters={}, i_dt=by_i_dt),
    )
    ends = [
        simulate(Case(model=model, half_width=4, initial={0: [1.0], 2: [0.3]}, end_time=5))
        for model in models
    ]
    assert np.array_equal(ends[0]["final"].values[0], ends[1]["final"].values[0])
    assert np.array_equal(ends[0]["l2"], ends[1]["l2"])


def test_the_checks_find_the_lorenz_system_chaotic_and_its_origin_a_saddle():
    model = Model(fields=("x", "y", "z"), parameters={}, dt=lorenz)
    case = Case(model=model, half_width=0, initial={0: [1, 1, 20]}, end_time=100)
    assert int(check(case)["chaotic"]) == 1


def test_the_exponents_of_a_steady_state_are_those_of_its_values_alone():
    model = Model(fields="x", parameters={}, dt=lambda p, x: 0.1 * lap(x) + x * (1 - x * x))
    case = Case(model=model, half_width=2, initial={0: [1.1]}, end_time=1)
    checked = check(case)
    assert checked.sizes["mode"] == 5


@pytest.mark.parametrize("rate", [lambda p, x: -p.k * x.real, lambda p, x: x.real**2])
def test_i_dt_of_a_real_field_without_its_factor_is_refused(rate):
    with pytest.raises(ModelError, match=r"define dt instead, which returns dx/dt, or multiply"):
        Model(fields="x", parameters={"k": 1.0}, i_dt=rate)


def test_complex_numbers_are_refused_in_rates_and_in_data():
    with pytest.raises(ModelError, match="dt returns complex numbers, but its fields are real"):
        Model(fields="x", parameters={}, dt=lambda p, x: 1j * x)
    decay = Model(fields="x", parameters={}, dt=lambda p, x: -x)
    with pytest.raises(ConfigurationError, match="give a real number"):
        Case(model=decay, initial={0: [1 + 1j]})


def test_a_model_has_one_of_three_functions():
    with pytest.raises(ModelError, match="needs exactly one of the functions i_dt, dt and d2_dt2"):
        Model(fields="x", parameters={}, dt=lambda p, x: -x, i_dt=lambda p, x: -x)
