"""What is refused before it starts, and what is not."""

import numpy as np
import pytest
from dimers import DIMERS, PAPER, SOLVERS, chain
from latticode.integrators.methods import METHODS
from latticode.integrators.taylor import ORDER
from latticode.simulation import simulate as simulation
from latticode.simulation.feasibility import find_fault, rates_of
from oracle import random_chain


def find_obstacle(problem):
    return simulation.find_obstacle(problem.equations)


def obstacle(name="dop853", size=1.0, span=50.0, numbers=PAPER, **controls):
    solver = SOLVERS[name] | controls
    times = {"end_time": span, "output_step": span}
    return find_obstacle(chain(size * random_chain(2), numbers, solver=solver, **times))


@pytest.mark.parametrize("size", [0.0, 1.0, 100.0])
@pytest.mark.parametrize("name", SOLVERS)
def test_ordinary_runs_meet_no_obstacle(name, size):
    assert obstacle(name, size) is None


AT_REST = {"size": 0.0, "numbers": (0.0, 0.0, 0.1), "step": 2.0**-20}  # exact in doubles
LOOSE = {"rtol": 1e-40, "atol": 1e-14}
REFUSED = [
    (
        "crank_nicolson",
        {"step": 49e-9},
        {"step": 50e-9},
        "the run takes 1e+09 steps, more than 1e+09",
    ),
    (
        "crank_nicolson",
        AT_REST | {"span": (1e9 + 1.0) * 2.0**-20},
        AT_REST | {"span": 1e9 * 2.0**-20},
        "the step is too short",
    ),
    *(("crank_nicolson", {"step": step}, {}, "must be positive") for step in (0.0, -0.1, np.nan)),
    *(
        (name, {"rtol": 1e-17, "atol": 1e-18}, LOOSE, "below the rounding")
        for name in ("taylor", "dop853", "ode45")
    ),
    ("dop853", {"rtol": np.nan}, {"rtol": 1e-15, "atol": 1e-15}, "must be numbers"),
    ("dop853", {"atol": -0.5, "rtol": 1.0}, {"atol": 0.5, "rtol": 1.0}, "must be numbers"),
    ("ode45", {"rtol": 0.0}, {"rtol": 1e-9}, "ode45 must be positive"),
    ("dop853", {"size": 2e-21, "atol": 1e-20}, {"size": 1e-20, "atol": 1e-20}, "smaller than the"),
    ("taylor", {"size": 1e-170, "atol": 1e-190}, {"size": 1e-145, "atol": 1e-157}, "squares"),
    ("dop853", {"size": 1e-145, "atol": 1e-157}, {}, "square of the absolute tolerance"),
    ("dop853", {"size": 1e5}, {"size": 1e3}, "radians"),
    ("dop853", {"size": 1e200}, {}, "overflow"),
    ("dop853", {"size": np.inf}, {}, "not finite"),
]
"""Of each solver what it cannot take, what it just can, and what is said of the first."""


@pytest.mark.parametrize(("name", "impossible", "possible", "words"), REFUSED)
def test_what_cannot_be_integrated_is_refused_and_no_more(name, impossible, possible, words):
    assert words in obstacle(name, **impossible)
    assert obstacle(name, **possible) is None


def test_power_series_beyond_the_doubles_are_refused():
    """Slowly or quickly, dop853 does it; taylor would take the whole run in one step."""
    assert METHODS["taylor"].order == ORDER
    slow, fast = (1e-25, 1e-25, 1e-25), (1e25, 1e25, 1e25)
    for numbers, span, size in ((slow, 1e25, 1e-20), (fast, 1e-25, 1.0)):
        tolerances = {"atol": 1e-12 * size}
        assert "unit of time" in obstacle("taylor", size, span, numbers, **tolerances)
        assert obstacle("dop853", size, span, numbers, **tolerances) is None
    assert obstacle("taylor", 1e-20, 1.0, (0.0, 0.0, 0.0), atol=1e-32) is None  # nothing moves


def fault(rates=(0.0, 1.0), peak=0.0, span=1.0, values=(1.0, 1.0), **solver):
    """Return what is found for constants k and m that turn the data at such rates."""
    parameters = (dict(zip("km", row, strict=True)) for row in (values, rates))
    return find_fault(*parameters, peak, span, {"name": "dop853"} | solver)


def test_the_key_that_stands_in_the_way_is_named():
    assert fault(values=(np.nan, np.inf))[0] == "k"
    assert fault(span=np.inf)[0] == "end_time"
    assert fault((0.0, 1e5), span=1e5)[0] == "end_time"  # as fast as it is long
    assert fault((0.0, 2e5), span=1e5)[0] == "m"
    assert fault((2e5, 1e5), span=1e5)[0] == "k"
    assert fault((0.5e9, 0.499e9)) is None and "radians" in fault((0.5e9, 0.501e9))[1]


def test_rates_of_a_model_are_those_of_its_terms():
    """Constants are told from the cubic term, which turns data of size 2 twice as fast."""
    numbers = {"epsilon": 0.5, "gamma": 1.0, "omega": -3.0}
    at_rest, moving = (rates_of(DIMERS, numbers, peak) for peak in (0.0, 2.0))
    assert at_rest["initial"] == 0.0 and at_rest["parameters"] == moving["parameters"] > 3.0
    assert moving["initial"] >= 2.0


def test_rounding_is_a_part_of_the_data():
    assert fault(name="taylor", peak=1e3, rtol=1e-15, atol=0.0) is None
    assert fault(name="taylor", peak=1e-3, rtol=1e-17, atol=2e-19) is None
    assert "rounding" in fault(name="taylor", peak=1e3, rtol=1e-17, atol=2e-14)[1]


def test_power_series_are_refused_by_the_size_of_their_last_coefficient():
    """With |A| = 1 it is the rate to the sixteenth power."""
    for power, refused in ((269.5, False), (270.5, True)):
        rate = 10.0 ** (power / 16)
        message = fault((0.0, rate), 1.0, 1.0 / rate, name="taylor", rtol=1e-9, atol=0.0)
        assert (message is not None) == refused
    slow = {"name": "taylor", "rtol": 1e-9, "atol": 0.0}
    assert "numbers of 1e-28" in fault((0.0, 1e-17), 1e-10, 1.1e11, **slow)[1]
    assert fault((0.0, 1e-17), 1e-10, 0.9e11, **slow) is None  # nothing moves
