"""Tiny numbers count as rest: no subnormal numbers, and the same bits wherever anybody looks."""

import ctypes
import os
import platform
import subprocess
import sys

import numpy as np
import pytest
import runs_with_rest
from latticode import Case, Model, abs2, cos, lap, sin
from latticode.integrators.rest import rest_level, set_to_rest
from latticode.integrators.taylor import lay_out, write_state
from latticode.kernels.compiled import uncached
from latticode.simulation.lattice import FULL_CHAIN
from latticode.simulation.simulate import simulate
from latticode.simulation.traced import kernels_of, make_system

LOOKED_AT = 1e-60
"""From this size on, sites are to have every bit that they would have without the rule."""


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """Return the results of all runs with the rule, and of a library in which it never acts."""

    def make(*rule, **environment):
        file = tmp_path_factory.mktemp("runs") / "results.npz"
        path = os.pathsep.join(sys.path)
        command = [sys.executable, runs_with_rest.__file__, str(file), *rule]
        subprocess.run(command, env=os.environ | {"PYTHONPATH": path} | environment, check=True)
        return np.load(file)

    # kernels that were kept have the text of these, and the rule in them
    return make(), make("without", LATTICODE_CACHE="off")


RUNS = [
    f"{model}.{start}.{solver}"
    for model, solvers in runs_with_rest.RUNS.items()
    for start in runs_with_rest.initial(model, 0)
    for solver in solvers
]


@pytest.mark.parametrize("run", RUNS)
def test_norms_and_sites_above_1e_60_have_every_bit_that_they_have_without_the_rule(run, results):
    with_rule, without = (arrays[f"{run}.final"] for arrays in results)
    seen = np.abs(without) > LOOKED_AT
    np.testing.assert_array_equal(with_rule[seen], without[seen])
    np.testing.assert_array_equal(*(arrays[f"{run}.norms"] for arrays in results))
    if "noise" not in run:
        assert (with_rule != without).any(), "the rule did not act"


def test_the_level_of_rest_follows_tiny_data():
    assert rest_level(np.zeros((2, 5)), 1e-130) == 1e-130
    assert rest_level(np.full((2, 5), -3.0), 1e-130) == 1e-130
    assert rest_level(np.full((2, 5), -1e-100), 1e-130) == pytest.approx(1e-160)


def test_a_state_is_set_to_rest_number_by_number_and_nan_stays():
    y = np.array([[1.0, -1e-131, 1e-131], [-1e-130, np.nan, 1e-320]])
    set_to_rest(y, 1e-130)
    np.testing.assert_array_equal(y, [[1.0, 0.0, 0.0], [-1e-130, np.nan, 0.0]])


def test_a_run_from_data_of_1e_120_is_that_from_data_of_1_on_a_linear_chain():
    """The frequency of a site, and with it a factor of 2^-400, changes no bit of a linear run."""
    model = Model(fields="u", parameters={}, i_dt=lambda p, u: lap(u) + 0.3 * u)
    scale = 2.0**-400

    def final(size):
        case = Case(
            model=model,
            half_width=20,
            initial={0: [size]},
            end_time=3,
            solver={"name": "taylor", "rtol": 1e-12, "atol": 1e-12 * size},
        )
        return simulate(case.kind.of(case.problem())).final

    np.testing.assert_array_equal(final(scale), scale * final(1.0))


# --- No subnormal numbers -------------------------------------------------------------------------

UNDERFLOW = {"x86_64": 0x10, "aarch64": 0x08}
"""FE_UNDERFLOW of C: a result was subnormal or vanished."""


def underflows(function, *arguments):
    """Return whether an operation in a call of a kernel, which is compiled, underflows."""
    function(*arguments)
    c = ctypes.CDLL(None)
    flag = UNDERFLOW[platform.machine()]
    c.feclearexcept(flag)
    function(*arguments)
    return bool(c.fetestexcept(flag))


@uncached
def square(values, squares):
    for i in range(values.size):
        squares[i] = values[i] * values[i]


needs_flags = pytest.mark.skipif(
    platform.machine() not in UNDERFLOW or sys.platform != "linux", reason="no known flag"
)

EQUATIONS = {
    "cubic": lambda p, u: lap(u) + 0.5 * abs2(u) * u,
    "degree five": lambda p, u: lap(u) + abs2(u) * abs2(u) * u,
    "saturable": lambda p, u: lap(u) + abs2(u) / (1 + abs2(u)) * u,
    "nonlocal": lambda p, u: lap(u) + abs2(u.right) * abs2(u.left) * u + lap(abs2(u) * u),
    "phases": lambda p, u: lap(u) + sin(u.real * u.real) * cos(u.imag) * u,
}


@needs_flags
def test_the_flag_shows_what_underflows():
    assert underflows(square, np.full(4, 1e-160), np.zeros(4))
    assert not underflows(square, np.full(4, 1e-130), np.zeros(4))


@needs_flags
@pytest.mark.parametrize("name", EQUATIONS)
def test_neither_rates_nor_series_of_a_state_that_falls_to_1e_130_underflow(name):
    model = Model(fields="u", parameters={}, i_dt=EQUATIONS[name])
    case = Case(model=model, half_width=60, initial={0: [1.0]}, end_time=1)
    problem = case.kind.of(case.problem())
    kernels, system = kernels_of(model, frozenset()), make_system(problem, FULL_CHAIN)
    y = np.zeros((2, problem.sites + 2))
    y[:, 1:61] = 10.0 ** np.linspace(-129, 0, 60) * np.array([[1.0], [-0.7]])
    assert not underflows(kernels.rates, system, y, np.zeros_like(y))
    work = np.zeros((kernels.WORK, *y.shape))
    series = lay_out.py_func(work, y)
    write_state(y, series)
    assert not underflows(kernels.continue_series, system, series)
