"""The whole state in time: against SciPy on plain NumPy, signed, at chosen times, in surveys."""

import numpy as np
import pytest
from latticode import Case, ConfigurationError, Model, abs2, draw_spacetime, lap, simulate, survey
from latticode.configuration.files import gather
from latticode.configuration.schema import load
from latticode.datasets.trajectories import trajectory_contents
from latticode.simulation.problem import Problem
from latticode.simulation.simulate import simulate as integrate
from scipy.integrate import solve_ivp

SITES = np.arange(-20, 21)
KINK = {int(n): [float(np.tanh(n))] for n in SITES}
PHI4 = Model(fields="x", parameters={"c": 0.5}, d2_dt2=lambda p, x: p.c * lap(x) + x - x * x * x)
DNLS = Model(fields="u", parameters={}, i_dt=lambda p, u: lap(u) + abs2(u) * u)
KINKS = Case(model=PHI4, half_width=20, boundary="antiperiodic", initial=KINK, end_time=5)
WAVES = Case(model=DNLS, half_width=5, initial={0: [1.5]}, end_time=2)


def kinks_by_scipy(times):
    """Return x_n and its rate, (part, site, time), of the antiperiodic phi-4 chain."""

    def rates(t, y):
        x, rate = y.reshape(2, -1)
        right, left = np.append(x[1:], -x[0]), np.append(-x[-1], x[:-1])
        return np.concatenate([rate, 0.5 * (right - 2 * x + left) + x - x**3])

    start = np.concatenate([np.tanh(SITES), np.zeros(41)])
    run = solve_ivp(rates, (0, times[-1]), start, "DOP853", times, rtol=1e-13, atol=1e-15)
    return run.y.reshape(2, 41, -1)


def test_the_state_of_a_real_field_in_time_is_that_of_scipy_with_its_signs():
    run = simulate(KINKS)
    state = run["state"].sel(component="x")
    assert state.dims == ("part", "site", "snapshot") and state.dtype == float
    assert list(run["part"].values) == ["value", "rate"]
    expected = kinks_by_scipy(run["snapshot"].values)
    np.testing.assert_allclose(state.values, expected, rtol=0, atol=1e-12)
    assert float(state.sel(part="value", site=-20, snapshot=0)) < -0.99


def test_the_state_of_a_complex_field_has_its_parts_and_the_moduli_beside_it():
    run = simulate(WAVES)
    state = run["state"]
    assert list(run["part"].values) == ["re", "im"]
    assert (state.isel(snapshot=-1) == run["final"]).all()
    np.testing.assert_allclose(np.hypot(*state.values), run["modulus"].values, rtol=1e-7)


@pytest.mark.parametrize("solver", ["taylor", {"name": "auto", "error": 1e-9}])
def test_chosen_times_have_the_bits_of_a_run_that_keeps_all(solver):
    every = simulate(WAVES.changed(snapshot_step=0.025, solver=solver))
    chosen = simulate(WAVES.changed(times=np.array([1.525, 0, 0.8]), solver=solver))
    assert list(chosen["snapshot"].values) == [0, 0.8, 1.525]
    assert (chosen["state"] == every["state"].sel(snapshot=[0, 0.8, 1.525])).all()
    assert len(draw_spacetime(chosen).axes) == 2


@pytest.mark.parametrize(
    ("keep", "variables"),
    [("norms", []), ("moduli", ["modulus"]), ("state", ["modulus", "state"])],
)
def test_keep_chooses_what_a_run_has_of_its_snapshots(keep, variables):
    run = simulate(WAVES.changed(keep=keep))
    assert [name for name in ("modulus", "state") if name in run] == variables


def test_less_is_kept_for_less_memory():
    costs = {}
    for keep in ("norms", "moduli", "state"):
        case = WAVES.changed(keep=keep, half_width=1000)
        costs[keep] = case.cost(case.shown_problem()).memory
    assert costs["norms"] < costs["moduli"] < costs["state"]


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"times": [0.5, 3]}, "times: 3 lies after the end of the run at 2"),
        ({"times": [0.03]}, "times: 0.03 is not a whole number of output steps of 0.025; the near"),
        ({"times": [1], "snapshot_step": 1}, "times: cannot be combined with snapshot_step"),
        ({"times": []}, "times: is empty; give at least 1"),
        ({"times": [1, 1]}, "times: the same value is given twice: 1"),
        ({"times": [-1]}, "times.0: is -1; it must be at least 0"),
        ({"keep": "stat"}, "keep: is 'stat'; it must be one of 'norms', 'moduli' or 'state'"),
    ],
)
def test_times_and_names_that_cannot_be_kept_are_refused_by_key(keys, message):
    with pytest.raises(ConfigurationError) as error:
        WAVES.changed(**keys)
    assert message in str(error.value)


def test_a_file_keeps_the_state_as_a_configuration_asks(tmp_path):
    model = "from latticode import lap\nfields = 'x'\nparameters = {'c': 0.5}\n"
    (tmp_path / "phi4.py").write_text(
        f"{model}def d2_dt2(p, x):\n    return p.c * lap(x) + x - x * x * x\n", encoding="utf-8"
    )
    path = tmp_path / "mine.yaml"
    keys = "half_width: 20, boundary: antiperiodic, end_time: 5, times: [0, 2.5, 5]"
    data = ", ".join(f"{n}: {values}" for n, values in KINK.items())
    path.write_text(f"cases: {{mine: {{model: phi4.py, {keys}, initial: {{{data}}}}}}}")
    problem = Problem.of(load(gather([path], {})).shown_problem("mine"))
    variables, _ = trajectory_contents("mine", problem, integrate(problem))
    states = variables["state"].values[:, 0]
    np.testing.assert_allclose(states, kinks_by_scipy([0, 2.5, 5]), rtol=0, atol=1e-12)


def test_a_function_that_a_survey_keeps_reads_the_state():
    def spectrum(problem, run):  # of x_3(t)
        return np.abs(np.fft.rfft(run.state[0, 0, problem.half_width + 3]))

    case = KINKS.changed(snapshot_step=0.5)
    spectra = survey(case, {"c": [0.25, 0.5]}, keep=[spectrum])["spectrum"].values
    for c, values in zip([0.25, 0.5], spectra, strict=True):
        run = simulate(case.changed(parameters={"c": c}))
        alone = run["state"].sel(part="value", component="x", site=3)
        np.testing.assert_array_equal(values, np.abs(np.fft.rfft(alone.values)))


def test_signed_fields_are_drawn_on_a_scale_that_reaches_as_far_below_zero_as_above():
    image = draw_spacetime(simulate(KINKS)).axes[0].images[0]
    assert image.cmap.name == "RdBu_r" and image.norm.vmin == -image.norm.vmax < -0.99
    values = image.get_array()
    assert values[0, 0] < -0.9 and values[-1, 0] > 0.9
    moduli = draw_spacetime(simulate(WAVES)).axes[0].images[0]
    assert moduli.cmap.name == "inferno" and moduli.norm.vmin == 0


def test_the_state_of_a_real_equation_of_first_order_has_one_part():
    decay = Model(fields="x", parameters={}, dt=lambda p, x: -x)
    run = simulate(Case(model=decay, half_width=1, initial={0: [-2]}, end_time=1))
    assert list(run["part"].values) == ["value"]
    states = run["state"].sel(part="value", component="x", site=0).values
    np.testing.assert_allclose(states, -2 * np.exp(-run["snapshot"].values), rtol=1e-13)
