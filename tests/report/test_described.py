"""What a page says of files: all of a few values, the range of many, and nothing of markup."""

import numpy as np
import pytest
import xarray as xr
from latticode.datasets.netcdf import save
from matplotlib.image import imsave
from pendula.report.described import dataset, figure

ABOUT = {"long_name": "height of <b>waves</b>", "units": "rad"}


@pytest.fixture
def made(tmp_path):
    """Return the path of a dataset with few values, many, words, gaps and one number."""
    gaps = np.where(np.arange(60) % 2, np.nan, np.arange(60.0))
    data = xr.Dataset(
        {
            "few": (("x",), [1.0, -2.5e-7, np.inf], ABOUT),
            "many": (("x", "y"), np.arange(300.0).reshape(3, 100), ABOUT),
            "gaps": (("z",), gaps, ABOUT),
            "unknown": (("z",), np.full(60, np.nan), ABOUT),
            "count": ((), 123456789, ABOUT | {"units": "1"}),
            "word": (("x",), ["a", "b", "c"], ABOUT),
        },
        attrs={"title": "Waves", "seed": 20170817, "epsilon": 1e-7, "text": 400 * "a"},
    )
    (tmp_path / "waves").mkdir()
    save(tmp_path / "waves/lives.nc", data)
    return tmp_path / "waves/lives.nc"


def test_a_dataset_is_told_with_its_parameters_and_values(made, tmp_path):
    found = dataset(made, tmp_path)
    assert (found.link, found.title) == ("waves/lives.nc", "Waves")
    assert found.attributes == {"seed": "20170817", "epsilon": "10⁻⁷", "text": f"{300 * 'a'} ..."}
    variables = {one.name: one for one in found.variables}
    values = {
        name: one.values.replace("\N{NO-BREAK SPACE}", " ") for name, one in variables.items()
    }
    assert values == {
        "few": "1, −2.5 × 10⁻⁷, infinite", "many": "0 to 299", "gaps": "0 to 58",
        "unknown": "none", "count": "123456789", "word": "a, b, c",
    }  # fmt: skip
    assert variables["many"][1:4] == ("height of <b>waves</b>", "rad", "x 3 × y 100")
    assert variables["count"].units == "" and variables["count"].dimensions == ""


def test_a_figure_is_told_by_its_caption_and_the_size_of_its_picture(tmp_path):
    (tmp_path / "figures").mkdir()
    about = {"caption": "Norms of A: left. Bars are errors."}
    save(tmp_path / "figures/fig5.nc", xr.Dataset(attrs=about))
    imsave(tmp_path / "figures/fig5.png", np.zeros((20, 30)))
    found = figure(tmp_path / "figures/fig5.nc", tmp_path)
    assert found == ("figures/fig5", about["caption"], 30, 20)
    assert (found.label, found._replace(stem="own/cases/fig5").label) == ("Fig 5", "")
    assert found.headline == "Norms of A"
