"""How figures are saved."""

import json
import time

import pytest
import xarray as xr
from latticode.drawing import strips, style

NAMES = ("figure.png", "figure.pdf", "figure.nc", "figure.json")


@pytest.fixture
def data():
    attributes = {"long_name": "height", "units": "1"}
    return xr.Dataset({"height": ("place", [0.0, 2.0, 1.0], attributes)})


def save(folder, data, drawn=None, note=""):
    folder.mkdir(exist_ok=True)
    figure = style.new_figure(1, 1)
    figure.add_subplot().plot((data if drawn is None else drawn)["height"])
    paths = [folder / name for name in NAMES]
    style.save(figure, data, *paths, note)
    return [path.read_bytes() for path in paths]


def test_saving_twice_writes_the_same_bytes(data, tmp_path):
    first = save(tmp_path / "one", data)
    time.sleep(1.1)  # a date in seconds would differ now; a longer wait changes nothing
    assert save(tmp_path / "two", data) == first


def test_a_note_stands_below_the_panels_and_in_the_description(data, tmp_path):
    note = "of another chain " * 10
    (text,) = json.loads(save(tmp_path, data, note=note)[-1])["texts"]
    assert text["text"].replace("\n", " ") == note.strip()
    assert "texts" not in json.loads(save(tmp_path, data)[-1])


def test_fields_have_colours_by_their_place():
    data = xr.Dataset({"linf": (("component", "tau"), [[1.0, 2.0]] * 3)})
    data = data.assign(l2=data["linf"]).assign_coords(component=list("uvw"), tau=[0.0, 1.0])
    figure, _ = strips.draw_cases([data], [[strips.Strip("", "")]])
    colours = [line.get_color() for line in figure.axes[0].get_lines()]
    assert colours == [style.RED, style.BLUE, "C2"]


def test_a_fault_leaves_older_files_as_they_were_and_no_others(data, tmp_path):
    before = save(tmp_path, data)
    with pytest.raises((TypeError, ValueError)):
        save(tmp_path, data.assign(bad=((), object())), drawn=-data)
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(NAMES)
    assert [(tmp_path / name).read_bytes() for name in NAMES] == before
