"""Numbers with variations: errors worked out by hand, and datasets that are read again."""

import numpy as np
import pytest
from latticode.datasets.netcdf import read, save
from latticode.measures.confidence import ConfidenceInterval
from pendula.varied import (
    NamedNumber,
    as_dataset,
    names_of,
    numbers_in,
    settings_of,
    single_numbers,
    variations_of,
    vary,
    vary_several,
)

CHOICES = {"tolerance": [1e-8, 1e-10], "margin": [40, 20, 80]}


def measure(tolerance: float, margin: int):
    """Return two numbers: margin / 10 with an error of 3, and 1e8 times the tolerance, of 0.1."""
    return [margin / 10.0, 1e8 * tolerance], [3.0, 0.1]


def test_one_choice_is_changed_at_a_time():
    printed = {"tolerance": 1e-8, "margin": 40}
    assert settings_of(CHOICES) == {
        "": printed,
        "tolerance = 1e-10": printed | {"tolerance": 1e-10},
        "margin = 20": printed | {"margin": 20},
        "margin = 80": printed | {"margin": 80},
    }
    with pytest.raises(ValueError, match="no choice has a second value to vary: tolerance"):
        vary(lambda tolerance: (1.0, 0.1), {"tolerance": [1e-8]})


def test_the_error_is_the_statistical_one_or_the_largest_change():
    number = vary(measure, CHOICES)
    np.testing.assert_array_equal(number.value, [4.0, 1.0])
    np.testing.assert_allclose(number.error, [4.0, 0.99])  # of margin = 80, and of the tolerance
    steady = vary(measure, {"tolerance": [1e-8], "margin": [40, 50]})
    np.testing.assert_array_equal(steady.error, [3.0, 0.1])


def test_a_variation_that_was_not_measured_is_no_change():
    number = vary(lambda seed: ([1.0, 2.0 if seed == 1 else np.nan], [0.5, 0.5]), {"seed": [1, 2]})
    np.testing.assert_array_equal(number.error, [0.5, 0.5])


def test_limits_enclose_the_variations_and_the_larger_side_is_the_error():
    """A share of 2 % (0 % to 7 %) that another seed makes 9 % has the limits 0 % and 9 %."""
    shares = {1: ConfidenceInterval(0.02, 0.0, 0.07), 2: ConfidenceInterval(0.09, 0.03, 0.2)}
    number = vary(lambda seed: shares[seed], {"seed": [1, 2]})
    data = as_dataset({"share": NamedNumber((), number, "share of runs")}, {})
    assert (data["share_low"], data["share_high"]) == (0.0, 0.09)
    assert data["share_statistical_error"] == pytest.approx(0.05)
    assert data["share_error"] == pytest.approx(0.07)


def test_numbers_of_one_measurement_are_measured_together():
    calls = []

    def measure_two(seed: int):
        calls.append(seed)
        return {"speed": (1.0, 0.1), "power": (10.0 * seed, 0.2)}

    numbers = vary_several(measure_two, {"seed": [1, 2]})
    assert calls == [1, 2] and (numbers["speed"].error, numbers["power"].error) == (0.1, 10.0)


def test_a_dataset_keeps_each_number_with_its_variations(tmp_path):
    both = vary(measure, CHOICES)
    entry = vary(lambda seed: (float(seed), 0.5), {"seed": [1, 2]})
    numbers = {
        "speed": NamedNumber(("omega",), both, "speed of the front"),
        "share": NamedNumber((), entry, "share of runs"),
    }
    save(tmp_path / "study.nc", as_dataset(numbers, {"omega": [0.0, 2.0]}))
    data = read(tmp_path / "study.nc")
    assert numbers_in(data) == ["speed", "share"] and set(names_of("speed")) < set(data.variables)
    assert data["speed"].attrs["choices"] == "tolerance = 1e-08, margin = 40"
    assert variations_of(data, "share") == {"seed = 2": 2.0}
    assert float(data["share_error"]) == 1.0 and float(data["share_statistical_error"]) == 0.5
    repeated = {"tolerance = 1e-10": 4.0, "margin = 20": 2.0, "margin = 80": 8.0}
    assert variations_of(data.sel(omega=0.0), "speed") == repeated
    assert variations_of(data, "temperature") == {}
    places = [
        (name, {key: label.item() for key, label in single[name].coords.items()})
        for name, single in single_numbers(data)
    ]
    assert places == [("speed", {"omega": 0.0}), ("speed", {"omega": 2.0}), ("share", {})]
