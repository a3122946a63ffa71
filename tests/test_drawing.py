"""How figures name the paper's cases, and say where the configuration is another."""

import json
from types import SimpleNamespace

import figure
import pytest
import xarray as xr
from latticode.drawing import style
from pendula.drawing import name_initial


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
    assert name_initial(initial) == name


def gather_line() -> xr.Dataset:
    return xr.Dataset({"height": ("place", [0.0, 2.0], {"long_name": "height", "units": "1"})})


class Outputs(list):
    """Outputs without names, as Snakemake hands them to a script."""

    def items(self):
        return ()


def draw_line(data: xr.Dataset):
    drawn = style.new_figure(1, 1)
    drawn.add_subplot().plot(data["height"])
    return drawn


def test_a_figure_says_where_the_configuration_is_not_the_papers(tmp_path):
    """The picture says the first of it, the data all: else a changed end of the chain leaves no
    trace in a figure."""
    edits = [f"fig2_large.{key} (other)" for key in ("boundary", "gamma", "omega", "end_time")]

    def notes(differs):
        params = {"call": [f"{__name__}.draw_line", "hash"], "unlike_paper": differs}
        paths = [str(tmp_path / f"figure.{kind}") for kind in ("png", "pdf", "nc", "json")]
        values = SimpleNamespace(**params, items=params.items)
        job = SimpleNamespace(rule="line", input={}, params=values, output=Outputs(paths))
        figure.draw(job)
        data = xr.load_dataset(tmp_path / "figure.nc").attrs.get("comment", "")
        return json.loads((tmp_path / "figure.json").read_text()).get("texts", []), data

    (note,), comment = notes(edits)
    assert all(edit in note["text"].replace("\n", " ") for edit in edits[:3])
    assert comment.endswith(", ".join(edits))
    assert notes([]) == ([], "")
