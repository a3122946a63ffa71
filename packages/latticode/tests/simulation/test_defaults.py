"""The default solver where equations have no power series: dop853, with a line that says so."""

import numpy as np
import pytest
from latticode import Case, Model, abs2, check, lap, simulate, sqrt, survey, sweep
from latticode.configuration.files import ConfigurationError
from latticode.configuration.schema import load
from latticode.simulation.simulate import IntegrationError
from scipy.integrate import solve_ivp

DRAG = Model(
    fields="x", parameters={"k": 1.0}, d2_dt2=lambda p, x, v: p.k * lap(x) - sqrt(v * v) * v
)
SINGULAR = Model(  # a root that vanishes at rest, though it is not one of squares alone
    fields="u",
    parameters={"k": 1.0},
    i_dt=lambda p, u: p.k * lap(u) + sqrt(1 - (1 - abs2(u))) * u,
)
ROOTS = Model(fields="u", parameters={"k": 1.0}, i_dt=lambda p, u: p.k * lap(u) + sqrt(abs2(u)) * u)
SMOOTH = Model(fields="u", parameters={"k": 1.0}, i_dt=lambda p, u: p.k * lap(u) + abs2(u) * u)
NO_SERIES, AT_REST = "which has no power series at 0", "taylor stopped at t = 0: the state is no"


def case_of(model, **keys):
    return Case(**{"model": model, "half_width": 3, "initial": {0: [1.2]}, "end_time": 2} | keys)


@pytest.mark.parametrize(
    ("model", "why"),
    [(DRAG, NO_SERIES), (ROOTS, NO_SERIES), (SINGULAR, AT_REST)],
)
def test_a_run_by_default_is_by_dop853_and_says_so_once(model, why, capsys):
    run = simulate(case_of(model))
    (line,) = capsys.readouterr().out.splitlines()
    assert line.startswith("the run uses dop853 instead of taylor, the default: ") and why in line
    assert (run.attrs["solver"], run.attrs["solver_rtol"]) == ("dop853", 1e-13)
    assert why in run.attrs["solver_instead_of_taylor"]
    named = simulate(case_of(model, solver="dop853"))
    np.testing.assert_array_equal(run["final"], named["final"])


def test_what_has_a_power_series_stays_with_taylor_without_a_word(capsys):
    run = simulate(case_of(SMOOTH))
    assert capsys.readouterr().out == "" and run.attrs["solver"] == "taylor"
    assert not [key for key in run.attrs if "default" in key or "instead" in key]


def test_taylor_by_name_is_rejected_with_the_names_of_those_that_work():
    for model in (DRAG, ROOTS):
        with pytest.raises(ConfigurationError, match=r"taylor cannot .* give one of dop853"):
            case_of(model, solver="taylor")
    with pytest.raises(IntegrationError, match="try dop853, which needs no power series"):
        simulate(case_of(SINGULAR, solver="taylor"))


def test_motion_that_ends_by_itself_is_no_fault_of_the_solver(capsys):
    escaping = Model(fields="x", parameters={}, d2_dt2=lambda p, x: x * x * x)
    with pytest.raises(IntegrationError, match=r"^taylor stopped at t = 1\.3"):
        simulate(case_of(escaping, end_time=5, initial={0: [2**0.5]}))
    assert capsys.readouterr().out == ""


def test_a_force_with_a_kink_is_not_left_to_a_series_that_passes_over_it():
    """The series of |v| = sqrt(v * v) goes on as v where v becomes negative: off by 9e-5."""
    drag = Model(fields="x", parameters={}, d2_dt2=lambda p, x, v: -x - sqrt(v * v) * v)
    data = {site: ["1+0.5j"] for site in (-1, 0, 1)}
    run = simulate(case_of(drag, half_width=1, initial=data, end_time=6))
    assert run.attrs["solver"] == "dop853"
    exact = solve_ivp(
        lambda t, y: [y[1], -y[0] - abs(y[1]) * y[1]],
        (0, 6),
        [1, 0.5],
        method="DOP853",
        rtol=1e-13,
        atol=1e-13,
        max_step=0.01,
    ).y[:, -1]
    np.testing.assert_allclose(run["final"].values[:, 0, 1], exact, atol=1e-11)


@pytest.mark.parametrize("model", [ROOTS, SINGULAR])
def test_a_survey_and_a_sweep_say_it_once_and_the_survey_of_each_run(model, capsys):
    surveyed = survey(case_of(model), {"k": [0.5, 1.0, 2.0]}, keep=["final_l2"], cores=2)
    (line,) = capsys.readouterr().out.splitlines()
    assert line.startswith("3 of 3 runs used another solver; the first, k = 0.5: the run uses d")
    assert surveyed.attrs["runs_by_another_solver"] == 3 and surveyed.attrs["solver"] == "dop853"
    assert (surveyed["remark"].values != "").all() and surveyed.attrs["failed_runs"] == 0
    sweep(case_of(model), [3, 4], windows=[(1, 2)])
    (line,) = capsys.readouterr().out.splitlines()
    assert line.startswith("half-width 3: the run uses dop853 instead of taylor")


def test_a_configuration_says_it_before_any_run():
    entries = {"model": ROOTS, "initial": {0: [1]}}
    (line,) = load({"cases": {"mine": entries}}).long_runs()
    assert (
        line.startswith("cases.mine: the run uses dop853 instead of taylor") and NO_SERIES in line
    )
    assert load({"cases": {"mine": entries | {"solver": "ode45"}}}).long_runs() == []


@pytest.mark.parametrize("model", [DRAG, ROOTS, SINGULAR])
def test_auto_and_check_work_without_a_power_series(model):
    run = simulate(case_of(model, solver={"name": "auto", "error": 1e-8}))
    assert (run.attrs["solver"], run.attrs["solver_agrees_with"]) == ("dop853", "ode45")
    checked = check(case_of(model))
    assert checked.attrs["second_name"] == "ode45" and float(checked["largest_difference"]) < 1e-9


@pytest.mark.parametrize("name", ["foo", "delfour_fortin_payre", "kahan_li"])
def test_only_solvers_that_take_the_model_are_offered(name):
    with pytest.raises(ConfigurationError) as error:
        case_of(ROOTS, solver=name)
    assert str(error.value).endswith(" dop853, ode45, crank_nicolson, auto")
