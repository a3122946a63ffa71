"""What the colours of the maps of fates stand for."""

from accepted import dataset
from matplotlib.colors import to_hex
from pendula.studies.breathers import fates
from pendula.studies.breathers.figures import KINDS, LOOKS, draw_fates, gather_fates, kind_of


def test_what_is_not_known_is_drawn_as_nothing_else():
    """Where it is not known whether what stays is periodic, a cell has a colour of its own."""
    data = gather_fates(dataset("breathers/fates")).copy(deep=True)
    data["fate"].values[0, 0, :6] = [1, 1, 1, 0, 2, 3]
    data["periodic"].values[0, 0, :3] = [-1, 0, 1]
    image = draw_fates(data).axes[0].images[0]
    colours = [to_hex(colour) for colour in image.to_rgba(image.get_array())[:6, 0]]
    names = ["stays, not known whether periodic", "stays, not periodic"]
    names += ["stays, periodic: a breather", "disperses", "moves away", "spreads"]
    assert colours == [to_hex(LOOKS[name]) for name in names]
    assert len(set(colours)) == 6


def test_the_looks_are_of_the_fates_in_their_order():
    """A map holds numbers of fates: another order would paint each with the colour of another."""
    for number, name in enumerate(fates.FATES):
        assert all(KINDS[kind_of(number, one)].startswith(name) for one in (-1, 0, 1))
