"""What is kept of long studies for the documents, made of the accepted shorter ones."""

import keep
from accepted import dataset
from latticode.datasets.netcdf import read, save
from pendula.varied import NamedNumber, as_dataset, numbers_in, vary

MADE_UP = vary(lambda seed: ([0.5 * seed], [0.1]), {"seed": [1, 2]})
ATTRIBUTES = {"title": "of a test", "members": 8, "end_time": 50.0, "settled": 10.0}


def varied(name, dimension):
    """Return a made-up study with one number and its variation."""
    numbers = {name: NamedNumber((dimension,), MADE_UP, name)}
    place = (dimension, [1.0], {"long_name": dimension})
    return as_dataset(numbers, {dimension: place}).assign_attrs(ATTRIBUTES, seed=1)


def test_numbers_of_the_infinite_chain_are_kept_as_they_are(tmp_path):
    quoted = dataset("quoted/unbounded")
    (tmp_path / "long/unbounded").mkdir(parents=True)
    save(tmp_path / "long/unbounded/numbers.nc", quoted.assign_attrs(title="Numbers"))
    keep.main(tmp_path, tmp_path / "quoted")
    reduced = read(tmp_path / "quoted/unbounded.nc")
    assert reduced.equals(quoted) and "second_front_speed" in numbers_in(reduced)
    assert reduced["power_between"].attrs["choices"] == quoted["power_between"].attrs["choices"]


def test_numbers_are_kept_with_their_variations(tmp_path):
    """Those of three studies of breathers come together, each with its own variations."""
    breathers = tmp_path / "long/breathers"
    breathers.mkdir(parents=True)
    save(breathers / "fates.nc", dataset("breathers/fates"))
    for name, number, dimension in (
        *(("areas", "area", "place"), ("shares", "share", "size")),
        ("least_power", "least_power", "scan"),
    ):
        save(breathers / f"{name}.nc", varied(number, dimension))
    for place in ("pendula/varied", "chaos/lifetimes"):
        (tmp_path / "long" / place).parent.mkdir()
        save(tmp_path / f"long/{place}.nc", varied("rate", "mu"))
    keep.main(tmp_path, tmp_path / "quoted")
    actual = {
        name: read(tmp_path / f"quoted/{name}.nc") for name in ("breathers", "pendula", "chaos")
    }
    assert {*numbers_in(actual["breathers"])} == {"area", "share", "least_power"}
    assert (actual["breathers"]["fate"] == dataset("breathers/fates")["fate"]).all()
    for name in ("pendula", "chaos"):
        assert actual[name]["rate_error"].item() == 0.5 and actual[name].attrs["members"] == 8
        assert "seed" not in actual[name].attrs


def test_all_that_is_quoted_of_these_studies_has_variations():
    """Beside the map of fates, which a figure shows, and the coordinates."""
    for name in ("breathers", "pendula", "chaos"):
        quoted = dataset(f"quoted/{name}")
        numbers = numbers_in(quoted)
        unvaried = {key for key in quoted.data_vars if not str(key).startswith(tuple(numbers))}
        assert numbers and unvaried <= {"fate"}, (name, unvaried)
