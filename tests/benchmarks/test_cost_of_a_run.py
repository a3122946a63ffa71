"""How the cost of a run grows, and what the machine could do."""

import numpy as np
import pytest
import xarray as xr
from pendula.datasets.netcdf import read, write
from pendula.sources import describe_machine
from problems import problem_of
from scipy.integrate import DOP853

from benchmarks import cost, figures, machine
from benchmarks.peer import Peer
from benchmarks.tables import tabulate_cost

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


def test_the_noisy_chain_is_even_and_the_same_every_time():
    problem = cost.noisy_chain(11, "dop853")
    z = problem.amplitudes
    np.testing.assert_array_equal(z, z[:, ::-1])
    np.testing.assert_array_equal(z, cost.noisy_chain(11, "taylor").amplitudes)
    assert z.shape == (2, 11) and len(problem.times) == 2


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


def test_the_figure_shows_the_steps_a_second_beside_the_limits_of_the_machine(measured):
    """Whether the limits hold is for the figure to show: the clock of a test would decide it."""
    data = figures.gather_cost(measured)
    np.testing.assert_array_equal(data["carried"], measured["steps"] / measured["seconds"])
    assert bool((data["arithmetic_limit"] > 0).all()) and bool((data["memory_limit"] > 0).all())
    assert len(figures.draw_cost(data).axes) == 3


def made_up_cost():
    """Return costs of 2 and 3 µs at 1001 sites, of 3 and 6 at 100 001."""
    costs = 1e-6 * np.array([[2.0, 3.0], [3.0, 6.0]])
    return xr.Dataset(
        {
            "seconds": (("sites", "solver"), costs),
            "long_seconds": (("end_time", "solver"), costs[:1]),
        },
        coords={
            "sites": ("sites", [1001, 100_001], {"long_name": "number of sites N"}),
            "end_time": ("end_time", [10.0], {"long_name": "slow time at the end"}),
            "solver": ["dop853", "taylor"],
        },
    )


def cells_of(parts):
    """Return the cells of all rows of the tables in the parts of a page of Markdown."""
    lines = [line for part in parts for line in part.splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in line[1:-1].split("|")] for line in lines]


def test_the_table_of_active_sites_has_a_row_each(measured):
    rows = {row[0]: row[1:] for row in cells_of(tabulate_cost(measured))}
    for width, memory in zip((8001, 16_001, 32_001), measured["active_memory"].values, strict=True):
        assert rows[f"{width:,}"][-1] == f"{memory:.0f}"


def test_the_table_says_what_was_measured():
    rows = cells_of(tabulate_cost(made_up_cost()))
    assert ["1001", "2", "3"] in rows and ["100001 over 1001", "1.5", "2"] in rows
    assert ["10", "2", "3"] in rows


def test_there_is_no_table_of_methods_in_cpp_where_none_was_run(measured):
    assert measured["by_hand_ratio"].isnull().all()
    assert "C++" not in "".join(tabulate_cost(measured))


def test_the_table_leaves_out_a_method_in_cpp_that_was_not_run():
    ratios = (("end_time", "by_hand"), [[np.nan, 1.5]])
    cost = made_up_cost().assign_coords(by_hand=["contracted", "separate"])
    rows = cells_of(tabulate_cost(cost.assign(by_hand_ratio=ratios)))
    assert ["slow time at the end", "separate"] in rows and ["10", "1.5"] in rows


def test_a_ratio_above_one_is_of_a_method_in_cpp_that_takes_longer(monkeypatch):
    peer = Peer("three seconds", lambda: None, lambda problem: lambda tolerance: (None, 3.0))
    monkeypatch.setattr(cost, "BY_HAND", ("cpp_taylor", "not_here"))
    monkeypatch.setattr(cost, "PEERS", dict.fromkeys(cost.BY_HAND, peer))
    monkeypatch.setattr(cost, "find_peers", lambda: ({"cpp_taylor": peer}, {}))
    monkeypatch.setattr(cost, "clocked", lambda action: lambda: 2.0)
    ratios = cost.measure_by_hand(PROBLEM)["by_hand_ratio"].values
    np.testing.assert_array_equal(ratios, [[1.5, np.nan]] * len(cost.END_TIMES))


def test_the_table_compares_only_chains_that_were_measured():
    short = made_up_cost().isel(sites=[0])
    assert " over 1001" not in "".join(tabulate_cost(short))


def test_operations_are_those_of_the_published_coefficients():
    operations, traffic = machine.count_dop853()
    weights = np.count_nonzero(DOP853.A) + np.count_nonzero(DOP853.B)
    estimates = np.count_nonzero(DOP853.E3) + np.count_nonzero(DOP853.E5)
    # 12 right-hand sides of 13.5 operations, two for each weight, and the norms of the errors
    assert operations == 4 * (12 * 13.5 + 2 * (weights + estimates) + 12)
    assert traffic == 4 * 32  # state and slope, read and written


def test_the_machine_is_described():
    assert {"processor", "python", "numpy", "numba", "scipy"} == set(describe_machine())
