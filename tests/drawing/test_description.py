"""What is written about a figure: each thing that a reader reads, and how it is rounded."""

import json
import re

import numpy as np
import pytest
import xarray as xr
from pendula.datasets.digest import digest, fingerprint
from pendula.drawing import style
from pendula.drawing.description import as_text, describe

DATA = xr.Dataset({"height": ("place", [1.0, 10.0, 4.0]), "depth": ("place", [2.0, np.nan, 8.0])})


@style.styled
def draw():
    """Return a figure with one of each: curve, band, bars, map of colours, legend, texts."""
    figure = style.new_figure(4.0, 2.0)
    left, right, hidden = figure.subplots(1, 3)
    left.plot(DATA["height"], color=style.RED, label="$A$", dashes=(3, 1))
    left.plot(DATA["depth"], "o", color=style.BLUE, markerfacecolor="white")
    left.fill_between([0, 1, 2], DATA["height"], 0, color="0.5", alpha=0.25, lw=0)
    left.set(xlabel="place (m)", ylabel="height (m)", yscale="log", xlim=(2, 0), ylim=(0.5, 20))
    left.set_xticks([0, 1, 2, 3], ["0", "1", "2", "outside"])
    left.set_xlim(2, 0)
    left.set_title("(a) heights", loc="left")
    left.legend(title="curves")
    left.annotate("top", (1, 10), (5, -3), textcoords="offset points")
    left.text(0.9, 1 / 3, "corner", transform=left.transAxes, color="red")
    image = right.imshow(
        np.arange(6.0).reshape(2, 3), cmap="inferno", vmax=4.0, extent=(0, 3, 0, 2)
    )
    figure.colorbar(image, ax=right).set_label("modulus")
    hidden.set_visible(False)
    figure.suptitle("all heights")
    figure.canvas.draw()
    return figure


@pytest.fixture(scope="module")
def described():
    return describe(draw(), DATA)


def test_the_figure_as_a_whole(described):
    assert described["data"] == digest(DATA)
    assert described["size_in_inches"] == [4.0, 2.0] and described["title"] == "all heights"
    kinds = [panel["kind"] for panel in described["panels"]]
    assert kinds == ["panel", "panel", "colour bar"]
    assert not {"texts", "legends"} & described.keys()


def test_axes_have_labels_scales_limits_and_ticks(described):
    x, y = (described["panels"][0][name] for name in "xy")
    assert x["label"] == "place (m)" and x["scale"] == "linear" and x["limits"] == [2.0, 0.0]
    assert y["label"] == "height (m)" and y["scale"] == "log" and y["limits"] == [0.5, 20.0]
    assert x["ticks"] == ["0", "1", "2"] and len(y["ticks"]) == 2


def test_curves_have_names_looks_and_ranges(described):
    first, second = described["panels"][0]["curves"]
    assert first["label"] == "$A$" and first["colour"] == style.RED and first["line"] == "--"
    assert first["points"] == 3 and first["x"] == [0.0, 2.0] and first["y"] == [1.0, 10.0]
    assert "label" not in second and second["marker"] == "o" and second["line"] == "None"
    assert second["face"] == "#ffffff" and second["points"] == 2 and second["y"] == [2.0, 8.0]


def test_bands_and_maps_have_their_colours(described):
    (band,) = described["panels"][0]["areas"]
    assert band["colour"] == "#808080 0.25" and band["y"] == [0.0, 10.0]
    (image,) = described["panels"][1]["images"]
    assert image["colour_map"].startswith("inferno #000004") and image["limits"] == [0.0, 4.0]
    assert image["shape"] == [2, 3] and image["extent"] == [0.0, 3.0, 0.0, 2.0]
    assert described["panels"][2]["y"]["label"] == "modulus"


def test_titles_legends_and_texts(described):
    panel = described["panels"][0]
    assert panel["title"] == "(a) heights"
    (legend,) = panel["legends"]
    (entry,) = legend["entries"]
    assert legend["title"] == "curves" and entry["text"] == "$A$" and entry["colour"] == style.RED
    top, corner = panel["texts"]
    assert top["text"] == "top" and top["points_at"] == [1.0, 10.0] and top["stands_at"] == [5, -3]
    assert corner["colour"] == "#ff0000" and corner["off"] == "axes fraction"
    assert corner["stands_at"] == [0.9, 0.333333]


def test_the_text_is_json_with_a_line_for_each_curve(described):
    text = as_text(described)
    assert json.loads(text) == described
    assert len(re.findall(r'^ +\{.*"points".*\},?$', text, re.MULTILINE)) == 3
    assert fingerprint(text) == fingerprint(as_text(describe(draw(), DATA)))
    assert fingerprint(text) != fingerprint(text.replace("$A$", "$B$"))
