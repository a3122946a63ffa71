"""Where a run starts: from arrays, functions, runs and files, and on from another run."""

import numpy as np
import pytest
from latticode import Case, ConfigurationError, Model, abs2, check, lap, save, simulate, sin, sweep
from latticode.configuration.files import gather
from latticode.configuration.schema import load
from latticode.simulation.problem import Problem
from latticode.simulation.simulate import simulate as integrate
from scipy.integrate import solve_ivp

MODEL = """from latticode import abs2, lap
fields = 'u'
parameters = {}
def i_dt(p, u):
    return lap(u) + abs2(u) * u
"""
DNLS = Model(fields="u", parameters={}, i_dt=lambda p, u: lap(u) + abs2(u) * u)
TODA = Model(fields="x", parameters={}, d2_dt2=lambda p, x: sin(x.right - x) - sin(x - x.left))
DRIVEN = Model(fields="x", parameters={}, d2_dt2=lambda p, x: -x + sin(2 * p.t))
M = 8
SITES = np.arange(-M, M + 1)
PULSE = 1.5 / np.cosh(SITES) * np.exp(0.3j * SITES)
CASE = Case(model=DNLS, half_width=M, initial={0: [1.5]}, end_time=4)


def waves_by_scipy(start, span):
    """Return the DNLS field (site,) after a time, with zero beyond the ends."""

    def rates(t, y):
        u = y.view(complex)
        beyond = np.pad(u, 1)
        return (-1j * (beyond[2:] - 2 * u + beyond[:-2] + np.abs(u) ** 2 * u)).view(float)

    y = np.array(start, complex).view(float)
    return solve_ivp(rates, (0, span), y, "DOP853", rtol=1e-13, atol=1e-15).y[:, -1].view(complex)


def final_of(case):
    """Return the first field (site,) at the end of a run."""
    re, im = simulate(case)["final"].values[:, 0]
    return re + 1j * im


def pulse(sites):
    return 1.5 / np.cosh(sites) * np.exp(0.3j * sites)


STARTS_OF_ONE_FIELD = {
    "sites": PULSE,
    "field_and_sites": PULSE[None],
    "list": list(PULSE),
    "function": pulse,
}


@pytest.mark.parametrize("initial", STARTS_OF_ONE_FIELD.values(), ids=STARTS_OF_ONE_FIELD)
def test_an_array_and_a_function_of_the_sites_start_a_run_as_scipy_does(initial):
    final = final_of(CASE.changed(initial=initial))
    np.testing.assert_allclose(final, waves_by_scipy(PULSE, 4), rtol=0, atol=1e-12)


def test_a_function_is_evaluated_on_the_sites_of_each_chain_and_an_array_is_not():
    case = CASE.changed(initial=pulse)
    assert case.changed(half_width=20).data[15] == (pulse(15),)
    with pytest.raises(ConfigurationError, match="initial: has 17 values for 41 sites"):
        CASE.changed(initial=PULSE).changed(half_width=20)
    with pytest.raises(ConfigurationError, match="site 8 of case 'sweep' is outside"):
        sweep(case, [4, 8], windows=[(1, 2)])


def test_a_function_of_several_fields_returns_a_value_for_each():
    pair = Model(fields=("a", "b"), parameters={}, i_dt=lambda p, a, b: (lap(a), lap(b)))
    case = Case(model=pair, half_width=1, initial=lambda n: (n * 1j, 2))
    assert case.data == {-1: (-1j, 2), 0: (0, 2), 1: (1j, 2)}


@pytest.fixture(scope="module")
def halves():
    """Return a run to 4, and one to 8."""
    return simulate(CASE), simulate(CASE.changed(end_time=8))


STARTS = {
    "run": lambda run: {"initial": run},
    "final": lambda run: {"initial": run["final"], "start_time": 4},
    "state": lambda run: {"initial": run["state"].sel(snapshot=4), "start_time": 4},
    "array": lambda run: {
        "initial": run["final"].values[0] + 1j * run["final"].values[1],
        "start_time": 4,
    },
}


@pytest.mark.parametrize("start", STARTS.values(), ids=STARTS)
def test_a_run_goes_on_from_another_at_its_time(start, halves, capsys):
    first, single = halves
    run = simulate(CASE.changed(end_time=8, **start(first)))
    assert (run["tau"].values == single["tau"].values[160:]).all() and run.attrs["start_time"] == 4
    assert abs(run["final"] - single["final"]).max() < 1e-13
    assert "agrees with one run from 0 within the error of taylor" in capsys.readouterr().out
    assert "divergence_time" in check(CASE.changed(end_time=8, **start(first)), run)


def test_a_run_that_goes_on_by_steps_of_one_length_has_the_bits_of_one_run(capsys):
    case = Case(
        model=TODA, half_width=4, initial={0: [1]}, end_time=4, solver="kahan_li", boundary="free"
    )
    single = simulate(case.changed(end_time=8))
    on = simulate(case.changed(initial=simulate(case), end_time=8))
    assert (on["final"] == single["final"]).all()
    assert (on["l2"] == single["l2"].sel(tau=on["tau"])).all()
    assert capsys.readouterr().out == ""


@pytest.mark.parametrize("solver", ["taylor", "dop853", "ode45", "kahan_li"])
def test_a_drive_goes_on_at_the_start_time(solver):
    controls = {"name": solver} if solver == "kahan_li" else {"name": solver, "rtol": 1e-12}
    if solver != "kahan_li":
        controls["atol"] = 1e-12
    case = Case(
        model=DRIVEN, half_width=0, initial=[0.2 + 0.1j], start_time=3, end_time=8, solver=controls
    )
    x, rate = simulate(case)["final"].values[:, 0, 0]
    # x = a cos t + b sin t - sin(2 t) / 3, where x(3) = 0.2 and x'(3) = 0.1
    turned = [[np.cos(3), np.sin(3)], [-np.sin(3), np.cos(3)]]
    a, b = np.linalg.solve(turned, [0.2 + np.sin(6) / 3, 0.1 + 2 / 3 * np.cos(6)])
    assert abs(x - (a * np.cos(8) + b * np.sin(8) - np.sin(16) / 3)) < 1e-10
    assert abs(rate - (b * np.cos(8) - a * np.sin(8) - 2 / 3 * np.cos(16))) < 1e-10


FILES = {
    "start.npy": lambda path, run: np.save(path, PULSE),
    "start.py": lambda path, run: path.write_text(
        "import numpy as np\ndef initial(n):\n    return 1.5 / np.cosh(n) * np.exp(0.3j * n)\n"
    ),
    "start.nc": lambda path, run: save(path, run),
}


@pytest.mark.parametrize(("name", "write"), FILES.items(), ids=FILES)
def test_a_configuration_starts_from_a_file_beside_it(name, write, tmp_path):
    (tmp_path / "dnls.py").write_text(MODEL)
    write(tmp_path / name, simulate(CASE.changed(initial=PULSE, end_time=1)))
    text = f"cases: {{mine: {{model: dnls.py, half_width: {M}, initial: {name}, end_time: 4}}}}"
    (tmp_path / "mine.yaml").write_text(text)
    entries = load(gather([tmp_path / "mine.yaml"], {})).shown_problem("mine")
    assert entries["start_time"] == (1 if name == "start.nc" else 0)
    final = integrate(Problem.of(entries)).final[0]
    np.testing.assert_allclose(final, waves_by_scipy(PULSE, 4), rtol=0, atol=1e-12)


def test_a_list_in_a_configuration_is_a_number_for_each_site(tmp_path):
    (tmp_path / "dnls.py").write_text(MODEL)
    text = "cases: {mine: {model: dnls.py, half_width: 1, initial: [0, 1.5, '0.5j']}}"
    (tmp_path / "mine.yaml").write_text(text)
    settings = load(gather([tmp_path / "mine.yaml"], {}))
    assert settings.cases["mine"].data == {0: (1.5,), 1: (0.5j,)}


@pytest.mark.parametrize(
    ("initial", "message"),
    [
        (lambda n: n[:3], "initial: has 3 values for 17 sites"),
        (lambda n: 1 / n, "initial: is inf at site 0, which is not finite"),
        (lambda n: 1 // 0, "initial: is a function of the sites that fails: ZeroDivisionError"),
        (lambda n: np.random.default_rng().random(n.size), "with different values each time"),
        (lambda n: "a", "initial: is 'a', not numbers"),
        ([1, 2, 3], "initial: has 3 values for 17 sites"),
        ([[1], [2, 3]], "with rows of different lengths"),
        ("nothere.nc", "initial: nothere.nc is missing"),
        ("nothere.npy", "initial: nothere.npy cannot be read"),
        (7, "initial: is 7, not data by site such as {0: [1, 0.1]}, an array of numbers"),
        (np.ones((2, 17)), "initial: has 2 x 17 values for 17 sites"),
    ],
)
def test_data_that_do_not_fit_are_refused_by_key(initial, message):
    with pytest.raises(ConfigurationError) as error:
        CASE.changed(initial=initial)
    assert message in str(error.value)


def test_parts_of_runs_that_are_no_data_are_refused_by_key(halves):
    first, _ = halves
    wider = simulate(CASE.changed(half_width=12))
    for initial, message in (
        (first["state"], "has the dimension snapshot; select one value, as by .sel(snapshot=...)"),
        (first[["l2"]], "is a dataset without the fields at the end of a run"),
        (first["final"].assign_coords(component=["v"]), "has no field u; it has v"),
        (wider, "is outside the chain of the sites -8 to 8"),
        (first["l2"].isel(tau=0), "has no dimension site"),
    ):
        with pytest.raises(ConfigurationError) as error:
            CASE.changed(initial=initial, end_time=8)
        assert f"initial: {message}" in str(error.value) or message in str(error.value)


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"start_time": 4}, "end_time: is 4; it must be later than 4"),
        ({"start_time": 0.01}, "end_time: 3.99 after start_time 0.01 is not a whole number of"),
        ({"start_time": -1}, "start_time: is -1; it must be at least 0"),
        ({"start_time": 1, "times": [0.5]}, "times: 0.5 lies before the start of the run at 1"),
        ({"start_time": 1, "snapshot_step": 2}, "2 does not divide the run of 3"),
    ],
)
def test_times_that_do_not_fit_the_start_are_refused_by_key(keys, message):
    with pytest.raises(ConfigurationError) as error:
        CASE.changed(**keys)
    assert message in str(error.value)
