"""How figures are saved, and how cases are named in them."""

import json
import time

import pytest
import xarray as xr
from pendula.drawing import style

NAMES = ("figure.png", "figure.pdf", "figure.nc", "figure.json")


@pytest.fixture
def data():
    attributes = {"long_name": "height", "units": "1"}
    return xr.Dataset({"height": ("place", [0.0, 2.0, 1.0], attributes)})


def save(folder, data, drawn=None, differs=None):
    folder.mkdir(exist_ok=True)
    figure = style.new_figure(1, 1)
    figure.add_subplot().plot((data if drawn is None else drawn)["height"])
    paths = [folder / name for name in NAMES]
    style.save(figure, data, *paths, differs)
    return [path.read_bytes() for path in paths]


def test_saving_twice_writes_the_same_bytes(data, tmp_path):
    first = save(tmp_path / "one", data)
    time.sleep(1.1)  # a date in seconds would differ now; a longer wait changes nothing
    assert save(tmp_path / "two", data) == first


def test_a_figure_says_where_the_configuration_is_not_the_papers(data, tmp_path):
    """The picture says the first of it, the data all: else a changed end of the chain leaves no
    trace in a figure."""
    edits = [f"fig2_large.{key} (other)" for key in ("boundary", "gamma", "omega", "end_time")]
    told = json.loads(save(tmp_path, data, differs=edits)[-1])["texts"]
    assert [all(edit in text["text"] for edit in edits[:3]) for text in told] == [True]
    assert xr.load_dataset(tmp_path / "figure.nc").attrs["comment"].endswith(", ".join(edits))
    assert "texts" not in json.loads(save(tmp_path, data)[-1])
    assert "comment" not in xr.load_dataset(tmp_path / "figure.nc").attrs


def test_a_fault_leaves_older_files_as_they_were_and_no_others(data, tmp_path):
    before = save(tmp_path, data)
    with pytest.raises((TypeError, ValueError)):
        save(tmp_path, data.assign(bad=((), object())), drawn=-data)
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(NAMES)
    assert [(tmp_path / name).read_bytes() for name in NAMES] == before


@pytest.mark.parametrize(
    ("initial", "name"),
    [
        ('{"0": [1.0, 0.1]}', "$(A_{0}, B_{0}) = (1, 0.1)$"),
        ('{"0": [5, 1]}', "$(A_{0}, B_{0}) = (5, 1)$"),
        ('{"-3": [2.0, "-0.3+0.4j"]}', "$(A_{-3}, B_{-3}) = (2, -0.3+0.4j)$"),
        ('{"0": [1.0, 1.0], "3": [1.0, 1.0]}', "data on 2 sites"),
    ],
)
def test_initial_data_are_named_by_site_and_values(initial, name):
    assert style.name_initial(initial) == name
