"""Figure 1."""

import numpy as np
import pytest
from pendula.studies.paper import chain_figure


@pytest.mark.parametrize("pairs", [3, 4, 5])
def test_every_pair_hangs_on_its_string_and_neighbours_are_linked(pairs):
    data = chain_figure.gather(pairs)
    assert data.sizes["offset"] == pairs
    near, far = data["string"].isel(end=0), data["string"].isel(end=1)
    across, up = (data["pivot"] - near).transpose("axis", ...).values
    slope = ((far - near).sel(axis="up") / (far - near).sel(axis="across")).values[:, None]
    assert np.allclose(up, slope * across)
    springs = data["spring"].values
    assert np.allclose(springs[:, :, 0], data["pivot"][:-1])
    assert np.allclose(springs[:, :, -1], data["pivot"][1:])


def test_the_central_pair_swings_most():
    data = chain_figure.gather(5)
    swing = np.hypot(*(data["bob"] - data["rest"]).transpose("axis", ...).values)
    assert (swing.argmax(axis=0) == 2).all()
