"""The configuration: defaults from the paper, and faults in words."""

from pathlib import Path

import pytest
import yaml
from pendula.configuration.messages import ConfigurationError, load

ROOT = Path(__file__).resolve().parents[2]


def faults(settings) -> list[str]:
    with pytest.raises(ConfigurationError) as caught:
        load(settings)
    return [line.strip() for line in str(caught.value).splitlines()[1:]]


def fault_of(**case) -> str:
    (line,) = faults({"cases": {"mine": {"omega": 1, **case}}})
    return line


def test_what_is_left_out_takes_the_papers_value_and_the_default_solver():
    problem = load({"cases": {"mine": {"omega": 8}}}).problem("mine")
    assert problem == {
        "omega": 8.0,
        "epsilon": 1.0,
        "gamma": 1.0,
        "half_width": 30,
        "boundary": "dirichlet",
        "initial": {0: (1 + 0j, 0.1 + 0j)},
        "end_time": 50.0,
        "output_step": 0.025,
        "solver": {"name": "taylor", "rtol": 1e-14, "atol": 1e-14},
        "snapshot_every": 0,
    }


@pytest.mark.parametrize("name", ["config.yaml"])
def test_the_projects_own_configuration_is_valid(name):
    settings = load(yaml.safe_load((ROOT / "config" / name).read_text()))
    assert {"fig2_small", "fig4_large"} <= set(settings.cases)
    assert max(settings.sweeps["fig5_right"].half_widths) >= 200
    assert settings.problem("fig3_large")["initial"] == {0: (5, 1)}
    assert settings.swept_problem("fig6_right")["end_time"] == 70


@pytest.mark.parametrize(
    ("case", "words"),
    [
        ({"omgea": 3}, "cases.mine.omgea: is not a known key; did you mean 'omega'?"),
        ({"sites": 60}, "the chain has N = 2 half_width + 1 sites, always an odd number"),
        ({"half_width": -1}, "cases.mine.half_width: is -1; it must be at least 0"),
        ({"half_width": 3.5}, "cases.mine.half_width: is 3.5, not a whole number"),
        ({"epsilon": float("nan")}, "cases.mine.epsilon: is nan, which is not finite"),
        ({"gamma": True}, "cases.mine.gamma: is True, not a number"),
        ({"gamma": "much"}, "cases.mine.gamma: is 'much', not a number"),
        ({"boundary": "periodoc"}, "it must be one of 'dirichlet', 'free' or 'periodic'"),
        ({"initial": {31: [1, 0]}}, "site 31 lies outside the chain, whose sites run from -30"),
        ({"initial": {0: ["1+x", 0]}}, "cases.mine.initial.0.0: is '1+x', not a complex number"),
        ({"initial": {0: ["inf", 0]}}, "cases.mine.initial.0.0: is 'inf', which is not"),
        ({"initial": {0: [1]}}, "cases.mine.initial.0.1: is missing"),
        ({"initial": {}}, "cases.mine.initial: is empty; give at least 1"),
        ({"end_time": 0}, "cases.mine.end_time: is 0; it must be greater than 0"),
        ({"end_time": 1.01}, "end_time: 1.01 is not a whole number of output steps of 0.025"),
        (
            {"solver": "ode54"},
            "cases.mine.solver: there is no solver 'ode54'; did you mean 'ode45'",
        ),
        ({"solver": {"name": "ode45", "rtoll": 1}}, "cases.mine.solver.rtoll: is not a known key"),
        ({"solver": {"name": "ode45", "rtol": -1}}, "cases.mine.solver.rtol: is -1"),
        ({"solver": {"rtol": 1e-3}}, "cases.mine.solver.name: is missing"),
    ],
)
def test_a_fault_is_told_by_path_and_in_words(case, words):
    assert words in fault_of(**case)


@pytest.mark.parametrize(
    ("sweep", "words"),
    [
        ({"case": "mime", "half_widths": [3]}, "sweeps.s.case: there is no case 'mime'; did you"),
        ({"case": "mine", "half_widths": []}, "sweeps.s.half_widths: is empty"),
        ({"case": "mine", "half_widths": [3, 3]}, "half_widths: the same value stands twice: 3"),
        ({"case": "mine", "half_widths": [3], "windows": [[5, 2]]}, "does not run forward"),
        ({"case": "mine", "half_widths": [3], "windows": [[0, 1.01]]}, "whole number of output"),
        ({"case": "far", "half_widths": [3]}, "site 4 of case 'far' lies outside the chain"),
    ],
)
def test_a_fault_of_a_sweep_is_told_too(sweep, words):
    cases = {"mine": {"omega": 1}, "far": {"omega": 1, "initial": {-4: [1, 0]}}}
    (line,) = faults({"cases": cases, "sweeps": {"s": sweep}})
    assert words in line


def test_all_faults_are_told_at_once():
    settings = {"cases": {"a": {"omega": 1, "gama": 2}, "b": {"omega": "x", "half_width": -1}}}
    assert len(faults(settings)) == 3


def test_numbers_that_yaml_takes_for_words_are_read():
    assert load(yaml.safe_load("cases: {mine: {omega: 1e-7}}")).cases["mine"].omega == 1e-7


def test_complex_data_are_read_as_python_writes_them():
    case = load({"cases": {"mine": {"omega": 1, "initial": {"3": ["-0.3+0.4j", 2]}}}}).cases["mine"]
    assert case.initial == {3: (-0.3 + 0.4j, 2)}


def test_a_named_solver_takes_the_shared_controls_and_a_given_one_its_own():
    settings = load(
        {
            "cases": {
                "named": {"omega": 1, "solver": "dop853"},
                "given": {"omega": 1, "solver": {"name": "dop853", "atol": 1e-3}},
            },
            "solvers": {"dop853": {"rtol": 1e-9}},
        }
    )
    assert settings.problem("named")["solver"] == {"name": "dop853", "rtol": 1e-9, "atol": 1e-13}
    assert settings.problem("given")["solver"] == {"name": "dop853", "rtol": 1e-9, "atol": 1e-3}
    assert settings.problem("named", "ode45")["solver"]["name"] == "ode45"
