"""The contract of a method: a new solver is one file and one line, and all rooms know it."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from latticode.integrators.families import other_family, pair_of, third_of
from latticode.integrators.method import Method
from latticode.integrators.methods import METHODS, NAMED

FOLDER = Path(__file__).parent
LINE = "from .midpoint import Midpoint as Midpoint\n"


@pytest.fixture(scope="module")
def used(tmp_path_factory):
    """Return what a program makes of the library with one file and one line more."""
    folder = tmp_path_factory.mktemp("library")
    package = folder / "latticode"
    shutil.copytree(
        FOLDER.parents[1] / "latticode", package, ignore=shutil.ignore_patterns("__pycache__")
    )
    methods = package / "integrators" / "methods"
    shutil.copy(FOLDER / "midpoint.py", methods)
    text = (methods / "__init__.py").read_text()
    (methods / "__init__.py").write_text(text.replace("from .ode45", f"{LINE}from .ode45", 1))
    done = subprocess.run(
        [sys.executable, FOLDER / "use_of_midpoint.py"],
        env=os.environ | {"PYTHONPATH": str(folder)},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout.splitlines()[-1])


def test_a_new_solver_makes_right_runs_by_its_name(used):
    assert used["solver"] == "midpoint" and used["controls"]["rtol"] == 1e-6
    assert 1e-9 < used["error"] < 1e-3


def test_its_cost_is_estimated(used):
    assert 1 / 3 < used["estimated_steps"] / used["steps"] < 3
    assert used["cost"].startswith("less than a second")


def test_auto_and_check_judge_by_it_and_judge_it(used):
    assert used["agrees_with"] == "midpoint"
    assert used["judge"] == "taylor" and used["difference"] < 1e-3


def test_figures_and_messages_know_it(used):
    assert used["label"] == "midpoint rule" and used["has_colour"]
    assert "did you mean 'midpoint'?" in used["fault"]


@pytest.mark.parametrize("method", NAMED.values(), ids=lambda method: method.name)
def test_each_method_fulfils_the_contract(method):
    """Its docstring is the help on its controls; what it costs grows with the chain."""
    assert isinstance(method, Method) and type(method).__doc__ and method.label
    assert method.work_arrays(61, in_tiles=False) >= 1
    few, many = (method.cost.seconds(100.0, 100.0, pairs) for pairs in (10.0, 1000.0))
    assert 0.0 < few < many


def test_methods_that_control_their_error_come_first_by_their_order():
    judges = [name for name, method in METHODS.items() if method.tightest is not None]
    assert judges == list(METHODS)[: len(judges)] == ["taylor", "dop853", "ode45"]
    assert pair_of(METHODS) == ("taylor", "dop853")
    assert third_of(pair_of(METHODS), METHODS) == "ode45"
    assert other_family("auto", ("kahan_li", "ode45", "dop853")) == "ode45"


def test_the_configuration_of_methods_compiles_nothing():
    """numba takes a tenth of a second to load, in every call of a workflow."""
    code = "import sys, latticode.configuration.schema; print('numba' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.stdout.strip() == "False", done.stderr
