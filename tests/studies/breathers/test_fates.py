"""Fates of data on one pair, which of them spread, and the symmetry of the map."""

import numpy as np
import pytest
from latticode.datasets.netcdf import as_xarray
from latticode.simulation.simulate import simulate
from pendula.problem import Constants, PaperProblem
from pendula.studies.breathers import fates, figures, sensitivity
from pendula.studies.breathers.fates import DISPERSES, MOVES, SPREADS, STAYS, map_fates


def pair_problem(omega, a, b, end_time=30.0, **changes):
    return PaperProblem(
        parameters={"epsilon": 1.0, "gamma": 1.0, "omega": omega},
        half_width=30,
        boundary="dirichlet",
        initial=np.array([[a], [b]], complex),
        end_time=end_time,
        output_step=end_time,
        solver={"name": "taylor", "rtol": 1e-8, "atol": 1e-8},
    ).changed(**changes)


def state_of(power: dict[int, float], half_width: int = 8) -> np.ndarray:
    """Return a state with this P on some sites."""
    state = np.zeros((2, 2 * half_width + 1), complex)
    for site, value in power.items():
        state[0, half_width + site] = 1j * value**0.5
    return state


@pytest.mark.parametrize(
    ("power", "expected"),
    [
        ({0: 6, 5: 3, -5: 2}, STAYS),
        ({0: 3, 1: 2, -1: 2, 5: 6}, STAYS),  # wide, and still at the centre
        ({1: 3, -1: 3, 5: 5}, STAYS),  # on both sides of the centre
        ({4: 3, -4: 3, 0: 1}, MOVES),  # neither of the two holds half by itself
        ({3: 2, 4: 2, 5: 2, 0: 5}, MOVES),  # wide
        ({0: 5, 5: 2.5, -5: 2.5}, DISPERSES),  # exactly half is no majority
        ({0: 14, 3: 7, -3: 7, 6: 2}, DISPERSES),  # P has grown from 10 to 30, as waves can
        ({0: 14, 3: 7, -3: 7, 6: 2.1}, SPREADS),
    ],
)
def test_what_the_end_of_a_run_shows(power, expected):
    assert fates.fate_of(pair_problem(-4.0, 3.0, 1.0), state_of(power)) == expected


@pytest.mark.parametrize(
    ("power", "half_width", "place"),
    [
        ({1: 1, 2: 8, 3: 1, 0: 1}, 8, 2),  # the five at the centre hold more, and are no place
        ({0: 5, 6: 2, 7: 1, 8: 2}, 8, None),  # exactly half is no majority
        ({0: 1, 1: 9}, 1, 0),  # on a short chain nothing is away from the centre
        ({}, 2, None),  # at rest
    ],
)
def test_the_place_is_that_of_the_middle_of_three_pairs(power, half_width, place):
    with np.errstate(invalid="ignore"):
        computed = fates.place_of(fates.power_by_distance(state_of(power, half_width)))
    assert computed == place


def test_linear_waves_stay_below_their_bound_and_come_near_it():
    """One pair at |kappa| = 4: P oscillates between its start and three times as much."""
    for omega, gain in ((-4.0, 3.0), (8.0, 3.0), (10.0, 2.0), (0.0, 1.0), (-2.0, 1.0)):
        constants = Constants(epsilon=1.0, gamma=1.0, omega=omega)
        assert fates.largest_linear_gain(constants) == gain
    grown = []
    for start in (1e-6, 1e-6j):
        problem = pair_problem(
            -4.0,
            start,
            -start,
            4.0,
            epsilon=0.0,
            half_width=1,
            output_step=0.01,
            solver={"name": "taylor", "rtol": 1e-12, "atol": 1e-24},
        )
        power = (simulate(problem).l2 ** 2).sum(axis=0)
        grown.append(float((power / power[0]).max()))
    assert max(grown) == pytest.approx(3.0, rel=1e-4)


@pytest.mark.parametrize(
    ("omega", "a", "b", "expected"),
    [
        (8.0, 5.0, 1.0, STAYS),
        (8.0, 1.0, 0.1, DISPERSES),
        (-4.0, 1.0, 0.1, DISPERSES),
        (0.0, 5.0, 1.0, SPREADS),
        (0.0, 1.0, 1.0, DISPERSES),
    ],
)
def test_known_fates(omega, a, b, expected):
    problem = pair_problem(omega, a, b, 70.0)
    assert fates.keep_fate(problem) == {"fate": expected}
    shares = as_xarray(*sensitivity.measure_sensitivity("one", problem, [0.0], 2, 1).make())
    assert shares["share"].values.tolist() == [float(expected == SPREADS)]


def maps(points, **changes):
    """Return the map at Omega = -4 and 8 of so many real amplitudes."""
    amplitudes = 5.0 * (np.arange(points) + 0.5) / points
    problems = {omega: pair_problem(omega, 1.0, 1.0, 10.0, **changes) for omega in (-4, 8)}
    return as_xarray(*map_fates(problems, amplitudes).make())


def test_a_map_has_the_fate_of_each_of_its_data():
    fates_at_omega = maps(3).sel(omega=-4)
    for a in fates_at_omega["a0"].values:
        for b in fates_at_omega["b0"].values:
            alone = fates.keep_fate(pair_problem(-4, a, b, 10.0))["fate"]
            assert fates_at_omega["fate"].sel(a0=a, b0=b) == alone


def test_a_finer_map_is_drawn_if_it_is_of_the_same_runs():
    coarse, fine = maps(3), maps(9)
    assert figures.gather_fates(coarse)["fate"].shape == (2, 3, 3)
    assert figures.gather_fates(coarse, fine)["fate"].shape == (2, 9, 9)
    assert (fine["fate"][:, 1::3, 1::3].values == coarse["fate"].values).all()
    for another_map in (maps(9, half_width=29), fine.sel(omega=[8])):
        assert figures.gather_fates(coarse, another_map)["fate"].shape == (2, 3, 3)
    assert [name.split()[0] for name in figures.KINDS] == list(fates.FATES)
