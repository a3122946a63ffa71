"""Matrices that couple any sites: against SciPy on plain NumPy, and what is refused."""

import numpy as np
import pytest
import scipy.sparse
from latticode import (
    Case,
    Model,
    ModelError,
    abs2,
    check,
    cos,
    couple,
    lap,
    read,
    save,
    shift,
    simulate,
    sin,
    survey,
    sweep,
)
from latticode.configuration.files import ConfigurationError
from latticode.configuration.schema import load
from latticode.generation.toolbox import Couplings, multiply_by_matrix
from scipy.integrate import solve_ivp


def solved(slope, start, end_time):
    controls = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-12}
    return solve_ivp(slope, (0, end_time), start, **controls).y[:, -1]


def kuramoto(p, x):
    return p.speed + p.k * (cos(x) * couple(p.W, sin(x)) - sin(x) * couple(p.W, cos(x)))


@pytest.mark.parametrize("solver", ["taylor", "dop853"])
def test_phases_that_all_see_each_other_follow_scipy(solver):
    rng = np.random.default_rng(1)
    speed, start, all_to_all = rng.normal(size=30), rng.uniform(-3, 3, 30), np.ones((30, 30)) / 30
    model = Model(fields="x", parameters={"speed": speed, "W": all_to_all, "k": 2.0}, dt=kuramoto)
    run = simulate(Case(model=model, sites=30, initial=start, end_time=5, solver=solver))

    def slope(t, x):
        mean = np.exp(1j * x).mean()
        return speed + 2.0 * np.abs(mean) * np.sin(np.angle(mean) - x)

    assert np.abs(run["final"].values[0, 0] - solved(slope, start, 5)).max() < 1e-10


def grid(sites):
    """Return the Laplacian of a square with open ends, for as many sites."""
    side = round(len(sites) ** 0.5)
    line = scipy.sparse.diags_array([1.0, -2.0, 1.0], offsets=[-1, 0, 1], shape=(side, side))
    identity = scipy.sparse.eye_array(side)
    return scipy.sparse.kron(line, identity) + scipy.sparse.kron(identity, line)


@pytest.mark.parametrize("solver", ["taylor", "dop853", "crank_nicolson"])
def test_a_square_lattice_by_its_laplacian_follows_scipy(solver):
    model = Model(
        fields="u",
        parameters={"W": grid},
        i_dt=lambda p, u: -couple(p.W, u) - abs2(u) * u,
        conserved=lambda p, u: {"P": abs2(u)},
    )
    start = np.zeros(49, complex)
    start[24], start[8] = 1.5, 0.5j
    fine = {"name": solver, "step": 0.001} if solver == "crank_nicolson" else solver
    case = Case(model=model, sites=49, initial=start, end_time=2, solver=fine)
    run = simulate(case)
    matrix = grid(range(49)).toarray()
    exact = solved(lambda t, u: 1j * (matrix @ u + np.abs(u) ** 2 * u), start, 2)
    final = run["final"].values[:, 0]
    error = np.abs(final[0] + 1j * final[1] - exact).max()
    assert error < (1e-4 if solver == "crank_nicolson" else 1e-10)
    power = run["conserved"].values[0]
    assert np.abs(power / power[0] - 1).max() < (1e-5 if solver == "crank_nicolson" else 1e-10)


def test_an_interaction_over_the_whole_chain_falls_with_a_power_of_the_distance():
    def interaction(n):
        distance = np.abs(n[:, None] - n[None, :])
        return np.where(distance > 0, 1.0 / np.maximum(distance, 1) ** 3.0, 0.0)

    model = Model(
        fields="x",
        parameters={"W": interaction},
        d2_dt2=lambda p, x: -x + 0.2 * couple(p.W, sin(x)),
    )
    start = np.zeros(41)
    start[20] = 1.0
    run = simulate(Case(model=model, half_width=20, initial={0: [1.0]}, end_time=5))
    matrix = interaction(np.arange(41.0))

    def slope(t, y):
        x, v = y.reshape(2, -1)
        return np.concatenate([v, -x + 0.2 * matrix @ np.sin(x)])

    exact = solved(slope, np.concatenate([start, 0 * start]), 5).reshape(2, -1)
    assert np.abs(run["final"].values[:, 0] - exact).max() < 1e-10


def test_sums_over_a_row_go_from_the_first_site_to_the_last_dense_or_sparse():
    rng = np.random.default_rng(2)
    matrix, factors = rng.normal(size=(2, 23, 23))[0], rng.normal(size=25)
    columns, starts = np.tile(np.arange(23), 23), np.arange(0, 23 * 23 + 1, 23)[None]
    room, nothing = np.zeros((1, 25)), np.zeros((1, 1, 1))
    sums = np.zeros((2, 25))
    for dense, result in zip((matrix.T.copy()[None], nothing), sums, strict=True):
        couplings = Couplings(dense, matrix.ravel(), columns, starts, room, room, room, room)
        multiply_by_matrix(couplings, 0, factors, result, 1)
    for site in range(23):
        total = 0.0
        for column in range(23):
            total += matrix[site, column] * factors[1 + column]
        assert (sums[:, 1 + site] == total).all()


def test_a_ring_by_its_matrix_has_the_motion_and_the_exponent_of_lap():
    ring = np.roll(np.eye(8), 1, axis=0) + np.roll(np.eye(8), -1, axis=0) - 2 * np.eye(8)
    start = np.random.default_rng(3).normal(size=(8, 2)) @ (0.4, 0.4j)
    settings = {"sites": 8, "boundary": "periodic", "initial": start, "end_time": 20}
    by_lap = Model(fields="u", parameters={}, i_dt=lambda p, u: lap(u) + abs2(u) * u)
    by_matrix = Model(
        fields="u", parameters={"W": ring}, i_dt=lambda p, u: couple(p.W, u) + abs2(u) * u
    )
    checks = [check(Case(model=model, **settings)) for model in (by_lap, by_matrix)]
    assert float(checks[1]["largest_difference"]) < 1e-9
    assert float(checks[0]["exponent"]) == pytest.approx(float(checks[1]["exponent"]), abs=1e-3)
    assert "coupling matrix are not supported" in checks[1].attrs["breather_refusal"]


def test_data_that_are_even_are_not_cut_in_half_where_a_matrix_is_not():
    matrix = np.triu(np.ones((9, 9)), 1)
    model = Model(fields="x", parameters={"W": matrix}, dt=lambda p, x: -x + couple(p.W, x))
    run = simulate(Case(model=model, half_width=4, initial={0: [1.0]}, end_time=1))
    assert run["final"].values[0, 0, 0] != 0.0 and run["final"].values[0, 0, -1] == 0.0


def test_a_configuration_sweeps_surveys_and_files_take_matrices(tmp_path):
    (tmp_path / "far.py").write_text(
        "import numpy as np\n"
        "from latticode import couple\n"
        "fields = ('u',)\n"
        "parameters = {'c': 1.0, 'W': lambda n: np.exp(-abs(n[:, None] - n[None, :]))}\n"
        "def i_dt(p, u):\n"
        "    return p.c * couple(p.W, u)\n"
    )
    keys = {"model": str(tmp_path / "far.py"), "initial": {0: [1]}, "end_time": 1}
    by_hand = {**keys, "sites": 2, "parameters": {"W": [[0, 1], [1, 0]]}}
    settings = load({"cases": {"far": keys, "by_hand": by_hand}})
    assert settings.problem("by_hand")["parameters"]["W"]["columns"] == [1, 0]
    two = simulate(Case(**by_hand))
    assert two["final"].values[0, 0, 0] == pytest.approx(np.cos(1.0), abs=1e-12)
    case = Case(**keys, half_width=4)
    assert survey(case, {"half_width": [2, 4], "c": [0.5, 1]})["max_l2"].shape == (2, 2, 1)
    assert bool(np.isfinite(sweep(case, [2, 4], windows=[(0.5, 1)])["l2"]).all())
    run = simulate(case.changed(half_width=60))
    save(tmp_path / "run.nc", run)
    assert read(tmp_path / "run.nc").attrs["parameters"] == run.attrs["parameters"]


@pytest.mark.parametrize(
    ("matrix", "message"),
    [
        (np.ones((3, 3)), "is 3 x 3; couple needs a 4 x 4 matrix for 4 sites"),
        (1.0, "is one number; couple needs a 4 x 4 matrix"),
        (np.eye(4) * 1j, "is a matrix of type complex128; couple needs real numbers"),
        ([[1, 2], [3]], "with rows of different lengths"),
        (np.diag([1, 2, np.nan, 3]), r"is nan at the sites \(2, 2\), which is not finite"),
        (scipy.sparse.eye_array(5), "is 5 x 5; couple needs"),
    ],
)
def test_what_is_no_matrix_of_the_sites_is_refused(matrix, message):
    model = Model(fields="x", parameters={"W": np.eye(4)}, dt=lambda p, x: couple(p.W, x))
    with pytest.raises(ConfigurationError, match=message):
        Case(model=model, sites=4, initial={0: [1]}, parameters={"W": matrix})


@pytest.mark.parametrize(
    ("rate", "message"),
    [
        (lambda p, x: couple(p.W, x).left, "has no neighbours to shift to; shift the rows"),
        (lambda p, x: couple(2.0, x), r"couple\(p.W, u\) must be a parameter"),
        (lambda p, x: couple(x, p.W), r"couple\(p.W, u\) must be a parameter"),
        (lambda p, x: p.W * x + couple(p.W, x), "and a number elsewhere; use two parameters"),
        (lambda p, x: shift(x, 9), r"use a matrix, couple\(p.W, u\)"),
    ],
)
def test_what_no_matrix_can_do_is_refused(rate, message):
    with pytest.raises(ModelError, match=message):
        Model(fields="x", parameters={"W": np.eye(4)}, dt=rate)


def test_a_matrix_without_couple_is_refused_with_the_way_to_take_it():
    model = Model(fields="x", parameters={"W": np.eye(4)}, dt=lambda p, x: p.W * x)
    with pytest.raises(ConfigurationError, match=r"use a matrix only in couple\(p.W, u\)"):
        Case(model=model, sites=4, initial={0: [1]})
