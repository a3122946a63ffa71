"""What a page says of files: parameters, meanings of variables, and captions."""

import numpy as np
import xarray as xr
from latticode.datasets.netcdf import save
from matplotlib.image import imsave
from replication.report.described import dataset, figure

ABOUT = {"long_name": "height of <b>waves</b>", "units": "rad"}


def test_a_dataset_is_told_with_its_parameters_and_variables(tmp_path):
    about = {
        "title": "Waves",
        "seed": 20170817,
        "epsilon": 1e-7,
        "text": 400 * "a",
        "sizes": [1, 2],
    }
    data = {"many": (("x", "y"), np.zeros((3, 100)), ABOUT), "one": ((), 1, ABOUT | {"units": "1"})}
    (tmp_path / "waves").mkdir()
    save(tmp_path / "waves/lives.nc", xr.Dataset(data, attrs=about))
    found = dataset(tmp_path / "waves/lives.nc", tmp_path)
    assert (found.link, found.title) == ("waves/lives.nc", "Waves")
    words = {"text": f"{300 * 'a'} ...", "sizes": "1, 2"}
    assert found.attributes == {"seed": "20170817", "epsilon": "10⁻⁷", **words}
    meaning = "height of <b>waves</b>"
    assert found.variables == [("many", meaning, "rad", "x 3 × y 100"), ("one", meaning, "", "")]


def test_a_figure_is_told_by_its_caption_and_the_size_of_its_picture(tmp_path):
    (tmp_path / "figures").mkdir()
    about = {"caption": "Norms of A: left. Bars are errors."}
    save(tmp_path / "figures/fig5.nc", xr.Dataset(attrs=about))
    imsave(tmp_path / "figures/fig5.png", np.zeros((20, 30)))
    found = figure(tmp_path / "figures/fig5.nc", tmp_path)
    assert found == ("figures/fig5", about["caption"], 30, 20)
    assert (found.label, found._replace(stem="own/cases/fig5").label) == ("Fig 5", "")
    assert found.headline == "Norms of A"
