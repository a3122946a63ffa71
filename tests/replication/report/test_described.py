"""What a page says of files: parameters, meanings of variables, and captions."""

import json

import numpy as np
import xarray as xr
from latticode.datasets.netcdf import save
from matplotlib.image import imsave
from replication.report.described import MapLink, dataset, figure

ATTRS = {"long_name": "height of <b>waves</b>", "units": "rad"}


def test_a_dataset_is_told_with_its_parameters_and_variables(tmp_path):
    attrs = {
        "title": "Waves",
        "seed": 20170817,
        "epsilon": 1e-7,
        "text": 400 * "a",
        "sizes": [1, 2],
    }
    data = {"many": (("x", "y"), np.zeros((3, 100)), ATTRS), "one": ((), 1, ATTRS | {"units": "1"})}
    (tmp_path / "waves").mkdir()
    save(tmp_path / "waves/lives.nc", xr.Dataset(data, attrs=attrs))
    entry = dataset(tmp_path / "waves/lives.nc", tmp_path)
    assert (entry.link, entry.title) == ("waves/lives.nc", "Waves")
    words = {"text": f"{300 * 'a'} ...", "sizes": "1, 2"}
    assert entry.attributes == {"seed": "20170817", "epsilon": "10⁻⁷", **words}
    meaning = "height of <b>waves</b>"
    assert entry.variables == [("many", meaning, "rad", "x 3 × y 100"), ("one", meaning, "", "")]


def test_a_figure_is_told_by_its_caption_and_the_size_of_its_picture(tmp_path):
    (tmp_path / "figures").mkdir()
    attrs = {"caption": "Norms of A: left. Bars are errors."}
    save(tmp_path / "figures/fig5.nc", xr.Dataset(attrs=attrs))
    panels = {"Panels": "3 4 18 14;20 4 21 14"}
    imsave(tmp_path / "figures/fig5.png", np.zeros((20, 30)), metadata=panels)
    entry = figure(tmp_path / "figures/fig5.nc", tmp_path)
    assert entry == ("figures/fig5", attrs["caption"], 30, 20, [])
    axes = [{"x": {"limits": [-6, 10]}, "y": {"limits": [0, 3]}}, {}]
    (tmp_path / "figures/fig5.json").write_text(json.dumps({"panels": axes}))
    link = MapLink("Ω", "γ", "live.html#omega={x}&gamma={y}")
    (panel,) = figure(tmp_path / "figures/fig5.nc", tmp_path, [link]).maps
    assert panel == (link, (10, 20, 50, 50), [-6, 10], [0, 3])
    assert (entry.label, entry._replace(stem="own/cases/fig5").label) == ("Fig 5", "")
    assert entry.headline == "Norms of A"
