"""How the cost of a run grows, and what the machine could do."""

import numpy as np
import pytest
from pendula.datasets.netcdf import read, write
from pendula.sources import describe_machine
from problems import problem_of
from scipy.integrate import DOP853

from benchmarks import cost, machine
from benchmarks.peer import Peer

TIGHT = {"name": "taylor", "rtol": 1e-14, "atol": 1e-14}
PROBLEM = problem_of("fig3_small", half_width=4, end_time=50.0, solver=TIGHT)


@pytest.fixture(scope="module")
def measured(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(cost, "SITES", (11, 101))
        patch.setattr(cost, "END_TIMES", (1.0, 4.0))
        patch.setattr(cost, "REPEAT", 1)
        patch.setattr(cost, "WORK", 100)
        patch.setattr(cost, "ACTIVE_WIDTHS", (4000, 8000, 16_000))
        patch.setattr(cost, "ACTIVE_DURATION", 0.02)
        patch.setattr(machine, "LONG", 10_000)
        patch.setattr(cost, "find_peers", lambda: ({}, {}))  # nothing is compiled in C++
        variables = cost.measure(PROBLEM)
    path = tmp_path_factory.mktemp("cost") / "cost.nc"
    write(path, variables, describe_machine())
    return read(path)


def test_memory_grows_with_the_chain_and_not_faster(measured):
    memory = measured["memory"].sel(solver="dop853").values
    assert 400 < memory[1] < memory[0] < 2000  # 38 arrays of 4 numbers for each site of a half


def test_memory_is_proportional_to_the_active_sites(measured):
    widths = measured["active_width"].values
    memory = measured["active_memory"].values * widths
    a_site = np.diff(memory) / np.diff(widths)
    # a complex pair is 32 bytes; dop853 keeps 11 more of them, and the tile that it works on
    np.testing.assert_allclose(a_site, 32 * 13, rtol=0.1)
    assert memory[0] < 4000 * 32 * 13 + 1e6


def test_a_ratio_above_one_is_of_a_method_in_cpp_that_takes_longer(monkeypatch):
    peer = Peer("three seconds", lambda: None, lambda problem: lambda tolerance: (None, 3.0))
    monkeypatch.setattr(cost, "BY_HAND", ("cpp_taylor", "not_here"))
    monkeypatch.setattr(cost, "PEERS", dict.fromkeys(cost.BY_HAND, peer))
    monkeypatch.setattr(cost, "find_peers", lambda: ({"cpp_taylor": peer}, {}))
    monkeypatch.setattr(cost, "clocked", lambda action: lambda: 2.0)
    ratios = cost.measure_by_hand(PROBLEM)["by_hand_ratio"].values
    np.testing.assert_array_equal(ratios, [[1.5, np.nan]] * len(cost.END_TIMES))


def test_operations_are_those_of_the_published_coefficients():
    operations, traffic = machine.count_dop853()
    weights = np.count_nonzero(DOP853.A) + np.count_nonzero(DOP853.B)
    estimates = np.count_nonzero(DOP853.E3) + np.count_nonzero(DOP853.E5)
    # 12 right-hand sides of 13.5 operations, two for each weight, and the norms of the errors
    assert operations == 4 * (12 * 13.5 + 2 * (weights + estimates) + 12)
    assert traffic == 4 * 32  # state and slope, read and written
