"""What the maps of fates show, on made-up maps."""

import numpy as np
import pytest
import xarray as xr
from matplotlib.colors import to_hex
from pendula.studies.breathers import fates
from pendula.studies.breathers.fate_figures import KINDS, LOOKS, draw_fates, gather_fates, kind_of

A, TURNED, PHASES = [0.5, 1.5, 2.5, 3.5], [1.0, 3.0], [-np.pi / 2, 0.0, np.pi / 2, np.pi]


def maps(fate=1, turned=1, periodic=1):
    """Return maps of one fate each, with a breather and a run that spreads among the cases."""
    first, second = ("omega", "a0", "b0"), ("omega", "turned_a0", "phase")
    return xr.Dataset(
        {
            "fate": (first, np.full((1, 4, 4), fate)),
            "periodic": (first, np.full((1, 4, 4), periodic)),
            "turned_fate": (second, np.full((1, 2, 4), turned)),
            "turned_periodic": (second, np.full((1, 2, 4), periodic)),
            "case_omega": ("case", [8.0, 8.0]), "case_fate": ("case", [1, 3]),
            "case_periodic": ("case", [1, -1]),
            "case_a0": ("case", [3.0, 1.0]), "case_b0": ("case", [0.6, 0.1]),
            "common": (("plane", "omega"), [[1], [1]]),
        },
        {"omega": [8.0], "a0": A, "b0": A, "turned_a0": TURNED, "phase": PHASES,
         "case": ["large", "small"]},
        {"ratio": 0.2},
    )  # fmt: skip


def legend_of(figure):
    return [text.get_text() for text in figure.legends[0].get_texts()]


@pytest.mark.parametrize(
    ("drawn", "named"),
    [
        ((1, 1), ["stays, periodic: a breather"]),
        ((1, 1, 0), ["stays, not periodic"]),
        ((1, 1, -1), ["stays, not known whether periodic"]),
        ((0, 3), ["disperses", "spreads"]),
        ((2, 1), ["stays, periodic: a breather", "moves away"]),
    ],
)
def test_the_legend_names_the_ends_that_occur(drawn, named):
    assert legend_of(draw_fates(gather_fates(maps(*drawn)))) == [*named, "the paper's data"]
    others = gather_fates(maps(*drawn), of_paper=False)
    assert legend_of(draw_fates(others)) == [*named, "the data of Figs 2 to 4"]


def test_what_is_not_known_is_drawn_as_nothing_else():
    """Where it is not known whether what stays is periodic, a cell has a colour of its own."""
    data = gather_fates(maps())
    data["periodic"].values[0, 0] = [-1, 0, 1, 1]
    data["fate"].values[0, 1, :3] = [0, 2, 3]
    image = draw_fates(data).axes[0].images[0]
    colours = [to_hex(colour) for colour in image.to_rgba(image.get_array())[:, :2].reshape(-1, 4)]
    shown = [colours[i] for i in (0, 2, 4, 1, 3, 5)]
    names = ["stays, not known whether periodic", "stays, not periodic"]
    names += ["stays, periodic: a breather", "disperses", "moves away", "spreads"]
    assert shown == [to_hex(LOOKS[name]) for name in names]
    assert len(set(shown)) == 6


def test_a_finer_map_of_the_same_runs_is_drawn_in_place_of_the_coarse_one():
    coarse, fine = maps(), maps(3, 3).drop_vars("common")
    assert (gather_fates(coarse, fine)["fate"] == 3).all()
    assert gather_fates(coarse, fine)["case_fate"].values.tolist() == [1, 3]
    of_others = coarse.assign(common=0 * coarse["common"])
    assert (gather_fates(of_others, fine)["fate"] == 1).all()


def test_the_papers_data_are_marked_in_the_colour_of_their_own_fate():
    above, below, *_ = draw_fates(gather_fates(maps())).axes
    marks = [line for line in above.lines if to_hex(line.get_color()) == "#000000"]
    at = {(float(one.get_xdata()[0]), float(one.get_ydata()[0])): one for one in marks}
    assert to_hex(at[3.0, 0.6].get_markerfacecolor()) == LOOKS["stays, periodic: a breather"]
    assert to_hex(at[1.0, 0.1].get_markerfacecolor()) == LOOKS["spreads"]
    (turned,) = [line for line in below.lines if to_hex(line.get_color()) == "#000000"]
    assert [turned.get_xdata()[0], turned.get_ydata()[0]] == [0.0, 3.0]  # the other has less B


def test_a_cell_lies_around_its_data_and_the_phase_goes_all_round():
    above, below, *_ = draw_fates(gather_fates(maps())).axes
    assert above.images[0].get_extent() == [0.0, 4.0, 0.0, 4.0]
    left, right, *_ = below.images[0].get_extent()
    assert left < -np.pi and right > np.pi
    assert below.get_xlim() == pytest.approx((-np.pi, np.pi))
    assert below.images[0].get_array().shape == (2, 5)  # the column at pi stands at -pi too


def test_the_looks_are_of_the_fates_in_their_order():
    """A map holds numbers of fates: another order would paint each with the colour of another."""
    for number, name in enumerate(fates.FATES):
        assert all(KINDS[kind_of(number, one)].startswith(name) for one in (-1, 0, 1))
