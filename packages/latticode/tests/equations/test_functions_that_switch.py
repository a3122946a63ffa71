"""max, abs, sign and where: against SciPy and exact motion; the power series refuses them."""

import builtins

import latticode
import numpy as np
import pytest
from latticode import Case, IntegrationError, Model, ModelError, max, sign, simulate, where
from latticode.configuration.files import ConfigurationError
from scipy.integrate import solve_ivp


def hertz(p, x):
    """Beads that touch: the contact force is the power 3/2 of the overlap, and never a pull."""
    left, right = max(0, 0.1 + x.left - x), max(0, 0.1 + x - x.right)
    return left * (1e-30 + left) ** 0.5 - right * (1e-30 + right) ** 0.5


def beads_by_scipy(start, end_time):
    def slope(t, state):
        x, v = np.pad(state.reshape(2, -1), ((0, 0), (1, 1)))
        overlap = np.maximum(0, 0.1 + x[:-1] - x[1:]) ** 1.5
        return np.concatenate([v[1:-1], overlap[:-1] - overlap[1:]])

    controls = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-12, "max_step": 0.003}
    run = solve_ivp(slope, (0, end_time), start.ravel(), **controls)
    return run.y[:, -1].reshape(start.shape)


@pytest.mark.parametrize(("solver", "rtol"), [("dop853", 1e-13), ("ode45", 1e-12)])
def test_beads_that_part_and_touch_follow_scipy(solver, rtol):
    start = np.zeros((2, 21))
    start[1, 3] = 1.5
    chain = Case(
        model=Model(fields="x", parameters={}, d2_dt2=hertz),
        half_width=10,
        initial={-7: [1.5j]},
        end_time=12,
        solver={"name": solver, "rtol": rtol, "atol": rtol},
    )
    exact = beads_by_scipy(start, 12)
    assert np.diff(exact[0]).max() > 0.1  # some beads have parted
    assert np.abs(simulate(chain)["final"].values[:, 0] - exact).max() < 1e-8


def test_an_oscillator_with_dry_friction_turns_about_the_other_side_once_it_comes_back():
    model = Model(fields="x", parameters={"f": 0.1}, d2_dt2=lambda p, x, v: -x - p.f * sign(v))
    case = Case(model=model, half_width=0, initial={0: [1j]}, end_time=3, output_step=0.5)
    with pytest.raises(IntegrationError, match="use larger tolerances, such as 1e-8"):
        simulate(case)
    coarse = {"name": "dop853", "rtol": 1e-8, "atol": 1e-8}
    x, v = simulate(case.changed(solver=coarse))["final"].values[:, 0, 0]
    angle, size = 3.0 - np.arctan(10.0), np.sqrt(1.01) - 0.2
    assert (x, v) == pytest.approx((0.1 + size * np.cos(angle), -size * np.sin(angle)), abs=1e-7)


def rates(function, *values):
    """Return a function of the fields x and y at 8 and more sites, by kernels."""
    model = Model(fields=("x", "y"), parameters={}, dt=lambda p, x, y: (0 * x, function(x, y)))
    x, y = values
    initial = {n: [x[n], y[n]] for n in range(len(x))}
    case = Case(model=model, half_width=10, initial=initial, end_time=1, solver="dop853")
    final = simulate(case)["final"].sel(component="y", part="value").values[10 : 10 + len(x)]
    return final - y


@pytest.mark.parametrize(
    ("function", "of_numpy"),
    [
        (lambda x, y: max(x, 0.5), lambda x: np.maximum(x, 0.5)),
        (lambda x, y: max(x, -0.3, 0.2 * x), lambda x: np.maximum(np.maximum(x, -0.3), 0.2 * x)),
        (lambda x, y: np.maximum(x, 0.5), lambda x: np.maximum(x, 0.5)),
        (lambda x, y: abs(x), np.abs),
        (lambda x, y: latticode.abs(x), np.abs),
        (lambda x, y: sign(x), np.sign),
        (lambda x, y: where(x > 0.4, x * x, 2), lambda x: np.where(x > 0.4, x * x, 2)),
        (lambda x, y: where(x <= 0, x * x, 2), lambda x: np.where(x <= 0, x * x, 2)),
        (lambda x, y: where(x < 0.4, x, -x), lambda x: np.where(x < 0.4, x, -x)),
        (lambda x, y: where(x >= 0, x, 3), lambda x: np.where(x >= 0, x, 3)),
    ],
)
def test_each_function_is_that_of_numpy(function, of_numpy):
    x = np.array([-1.0, -0.25, 0.0, 0.25, 0.5, 1.0, 2.0])
    np.testing.assert_allclose(rates(function, x, 0.1 * x), of_numpy(x), atol=1e-9)


def test_of_plain_numbers_they_are_those_of_python():
    assert max(2, 3) == 3 and max([1, 5]) == 5 and latticode.abs(-2) == builtins.abs(-2)


def test_the_power_series_refuses_them_and_the_default_goes_on_by_dop853(capsys):
    model = Model(fields="x", parameters={}, d2_dt2=lambda p, x: -abs(x) * x)
    with pytest.raises(ConfigurationError, match="integrate the model, which has max, "):
        Case(model=model, initial={0: [1]}, solver="taylor")
    run = simulate(Case(model=model, half_width=1, initial={0: [1]}, end_time=1))
    assert run.attrs["solver"] == "dop853"
    assert "no power series where they switch" in capsys.readouterr().out


@pytest.mark.parametrize(
    "function",
    [
        lambda p, u: u if u.real > 0 else -u,
        lambda p, u: where(u > 0, u, -u),
        lambda p, u: where(True, u, -u),
        lambda p, u: max(u, 0),
    ],
)
def test_branches_and_comparisons_of_complex_numbers_are_refused(function):
    with pytest.raises(ModelError, match=r"where\(|give a real one, such as \.real"):
        Model(fields="u", parameters={}, i_dt=function)
