"""Numbers of long runs with variations, from made-up runs whose numbers are known."""

import numpy as np
import pytest
import xarray as xr
from accepted import dataset
from latticode.datasets.netcdf import as_xarray
from pendula.problem import Constants
from pendula.studies.unbounded.claims import SLOW
from pendula.studies.unbounded.claims_state import largest_change
from pendula.studies.unbounded.front import linear_front
from pendula.studies.unbounded.long_runs import run_variables
from pendula.studies.unbounded.measured import measure_fronts, with_first_choices
from pendula.studies.unbounded.noise import ROUNDING
from pendula.studies.unbounded.variations import (
    differences,
    exponent_of_case,
    numbers_of_fronts,
    numbers_of_growth,
    numbers_of_states,
    predict_distances,
)
from pendula.varied import NamedNumber, as_dataset, numbers_in, single_numbers, vary
from problems import problem_of

TAU = np.arange(2.0, 402.0, 2.0)
LEVELS, EDGES = (1e-2, 1e-4, 1.0, 1e-12), (160, 80, 320)
BOTH, ALONE = 18.0, 19.0
PROBLEM = problem_of("fig4_small", half_width=None, end_time=TAU[-1], output_step=2.0)
FRONT = linear_front(PROBLEM.constants)
THERMAL = xr.Dataset(
    {"power": ("omega", [BOTH]), "antisymmetric_power": ("omega", [ALONE])}, {"omega": [0.0]}
)


def made_up(tolerance: float, relaxing: float = 0.0, second: float = 1.5, power: float = 1.0):
    """Return a run with fronts at v_1 and `second`, and l2^2 as the law has it to this power.

    P between the fronts is lower by `relaxing` times the part of its sites near the first front.
    """
    shape = (1, 2, TAU.size)
    way = FRONT.speed * TAU - FRONT.delay * np.log(TAU)
    squares = 2.0 * (second * BOTH * TAU + (way - second * TAU) * ALONE)
    series = {name: np.ones(shape) * TAU for name in ("tau", "piece_tau")}
    series |= {"front": np.ones(shape) * way, "linf": np.ones(shape)}
    series["l2"] = np.ones(shape) * np.sqrt(squares**power)
    series["second_front"] = second * np.ones((*shape, len(LEVELS))) * TAU[:, None]
    between = [ALONE - relaxing / edge for edge in EDGES]
    means = [[[BOTH, 0.5 * BOTH], [power, 0.0]] for power in between]
    series["means"] = np.broadcast_to(means, (*shape, *np.shape(means)))
    run = as_xarray(run_variables([PROBLEM], series, LEVELS, EDGES), {})
    return run.assign_attrs(solver_rtol=tolerance)


def test_a_power_that_relaxes_behind_the_front_has_the_error_of_the_margin():
    """The margin is doubled and halved, of which the half changes more."""
    for relaxing in (0.0, 80.0):
        runs = {rtol: made_up(rtol, relaxing) for rtol in (1e-8, 1e-10)}
        numbers = numbers_of_states(runs, THERMAL)
        power, ratio = (numbers[name].number for name in ("power_between", "ratio_between"))
        assert power.value == pytest.approx([ALONE - relaxing / 160.0])
        assert power.error == pytest.approx([relaxing / 160.0], abs=1e-9)
        assert ratio.value == pytest.approx(power.value / ALONE)
        assert numbers["power_behind"].number.error == pytest.approx([0.0], abs=1e-9)


def test_a_front_that_depends_on_the_tolerance_has_the_error_of_it():
    runs = {1e-8: made_up(1e-8), 1e-10: made_up(1e-10, second=1.6)}
    numbers = numbers_of_fronts(runs)
    assert numbers["second_front_speed"].number.value == pytest.approx([1.5])
    assert numbers["second_front_speed"].number.error == pytest.approx([0.1])
    assert numbers["front_speed"].number.value == pytest.approx([FRONT.speed])
    assert numbers["level_speed"].number.value == pytest.approx([1.5] * len(LEVELS))


@pytest.mark.parametrize(("predicted", "ratio"), [(1.5, 1.0), (2.5, None)])
def test_the_law_is_that_of_predicted_speeds(predicted, ratio):
    """Its error tells a predicted speed of the second front that is not the measured one."""
    speeds = xr.Dataset({"predicted_second_speed": ("omega", [predicted])}, {"omega": [0.0]})
    numbers = numbers_of_growth({1e-8: made_up(1e-8), 1e-6: made_up(1e-6)}, THERMAL, speeds)
    law = numbers["slope_ratio"].number
    if ratio:
        assert law.value == pytest.approx([ratio], abs=1e-3) and law.error < 1e-3
    else:
        expected = 1.5 * BOTH + (FRONT.speed - 1.5) * ALONE
        slope = predicted * BOTH + (FRONT.speed - predicted) * ALONE
        assert law.value == pytest.approx([expected / slope], abs=1e-3)
        assert law.error == pytest.approx([abs(1.0 - expected / slope)], rel=0.05)


def test_the_row_on_the_law_says_how_little_one_state_behind_both_fronts_would_change():
    """With v_2 = 1.5 and states of 18 and 19 that is 3 %, with equal states nothing."""
    law = 1.5 * BOTH + (FRONT.speed - 1.5) * ALONE
    expected = max(abs(FRONT.speed * factor / law - 1.0) for factor in (BOTH, ALONE))
    assert (
        largest_change(with_first_choices(made_up(1e-8)), THERMAL) == pytest.approx(expected)
        and expected > 0.02
    )
    equal = THERMAL.assign(antisymmetric_power=THERMAL["power"])
    assert largest_change(with_first_choices(made_up(1e-8)), equal) == pytest.approx(0.0, abs=1e-12)


def test_exponents_are_fitted_with_an_offset_and_plainly():
    runs = {rtol: made_up(rtol, power=0.8) for rtol in (1e-8, 1e-6)}
    speeds = xr.Dataset({"predicted_second_speed": ("omega", [1.5])}, {"omega": [0.0]})
    numbers = numbers_of_growth(runs, THERMAL, speeds)
    assert numbers["exponent"].number.value == pytest.approx([0.4], abs=0.02)
    assert numbers["plain_exponent"].number.value == pytest.approx([0.4], abs=0.02)
    assert exponent_of_case(runs).number.value == pytest.approx(0.4, abs=0.02)


def test_figures_of_long_runs_show_the_first_level_and_edge():
    run = made_up(1e-8, relaxing=80.0)
    fronts = measure_fronts(run, THERMAL)
    assert fronts["second_front_speed"].values == pytest.approx([1.5])
    assert fronts["power_between"].values == pytest.approx([ALONE - 80.0 / EDGES[0]])


def test_noise_leaves_the_second_front_a_distance_behind_the_first():
    kappa = vary(lambda tolerance: ([0.5], [0.01]), {"tolerance": [1e-8, 1e-10]})
    along, omega = ("omega",), {"omega": ("omega", [0.0])}
    growth = as_dataset({"growth_behind_front": NamedNumber(along, kappa, "growth")}, omega)
    noise = xr.Dataset(coords={"noise": np.array(["1e-08", ROUNDING], object), "omega": [0.0]})
    distance = predict_distances(noise, growth).number
    assert distance.value.ravel() == pytest.approx([8 * np.log(10.0) * 2.0, 53 * np.log(2.0) * 2.0])
    assert distance.error == pytest.approx(distance.value * 0.02)


def test_what_two_noises_have_in_common_cancels_in_the_difference_of_their_distances():
    """Both distances have the constant 7, which one choice doubles, and their errors add up."""
    along, omega = ("omega",), {"omega": ("omega", [0.0])}
    kappa = vary(lambda tolerance: ([0.5], [0.0]), {"tolerance": [1e-8, 1e-10]})
    growth = as_dataset({"growth_behind_front": NamedNumber(along, kappa, "growth")}, omega)
    labels = np.array(["1e-16", "1e-08", ROUNDING], object)
    logs = np.log(10.0) * np.array([[16.0], [8.0], [16.0]])

    def measure(level):
        return 2.0 * logs + 7.0 * level, np.array([[3.0], [4.0], [0.0]])

    distance = NamedNumber(("noise", "omega"), vary(measure, {"level": [1.0, 2.0]}), "distance")
    noise = as_dataset({"distance": distance}, {"noise": ("noise", labels), **omega})
    numbers = {name: number.number for name, number in differences(noise, growth).items()}
    for number in numbers.values():
        assert number.value == pytest.approx([16.0 * np.log(10.0)])
    assert numbers["distance_difference"].error == pytest.approx([5.0])


# --- The accepted long study ----------------------------------------------------------------------


@pytest.fixture(scope="module")
def quoted() -> xr.Dataset:
    return dataset("quoted/unbounded")


def within(quoted, measured: str, predicted: str) -> None:
    """Require that all measured numbers are the predicted ones, as far as both errors go."""
    error = quoted[f"{measured}_error"] + quoted[f"{predicted}_error"]
    off = abs(quoted[measured] - quoted[predicted])
    known = off.notnull()
    assert known.any() and (off <= error).where(known, True).all(), (off - error).values


def test_every_number_of_the_long_study_has_variations(quoted):
    assert len(numbers_in(quoted)) >= 15
    assert {name for name, _ in single_numbers(quoted)} == set(numbers_in(quoted))


def test_predicted_speeds_are_those_of_the_front(quoted):
    for omega, speed in zip(quoted["omega"].values, quoted["predicted_speed"].values, strict=True):
        constants = Constants(epsilon=1.0, gamma=1.0, omega=float(omega))
        assert speed == linear_front(constants).speed


def test_measured_fronts_and_states_are_the_predicted_ones(quoted):
    """At Omega = 2 the power between the fronts is thermal, once it has settled.

    Noise that is less by a factor of 1e-8 leaves the second front as much further behind as noise
    of 1e-8 is predicted to: a constant remains, since growth begins at no one site.
    """
    within(quoted, "second_front_speed", "predicted_second_speed")
    within(quoted, "distance_difference", "predicted_distance_difference")
    weaker = quoted.sel(noise="1e-08")
    off = abs(quoted["distance_difference"] - weaker["predicted_distance"]).dropna("omega")
    assert off.size == 3 and (off < weaker["predicted_distance_error"]).all()
    assert abs(quoted["ratio_between"].sel(omega=2.0) - 1.0) < 0.01
    assert quoted["ratio_between_error"].sel(omega=2.0) < 0.01
    assert abs(quoted["slope_ratio"] - 1.0).max() < 0.05


def test_the_large_case_grows_faster_than_by_diffusion_in_the_long_study_too(quoted):
    least = quoted["large_exponent"] - quoted["large_exponent_error"]
    assert float(least) > SLOW.value
