"""The verbs that make wrong cases: what they change, where, and what they leave."""

import numpy as np
import pytest
import xarray as xr
from replication.ledger import changes
from replication.ledger.changes import exchange, keep, put, repeat, roll, scale, shift
from replication.ledger.criterion import UndecidableError


@pytest.fixture
def run() -> xr.Dataset:
    """Return a run whose numbers are all different, at mu of single precision."""
    l2 = ("case", "mu"), [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]], {"tolerance": 0.1}
    linf = "mu", [7.0, 8.0, 9.0], {"tolerance": 0.2}
    mu = np.array([0.1, 0.2, 0.4], np.float32)
    return xr.Dataset({"l2": l2, "linf": linf}, {"case": ["one", "two"], "mu": mu})


BOTH = ("l2", "linf")


@pytest.mark.parametrize(
    ("change", "l2", "linf"),
    [
        (scale("l2", 10.0, case="two", mu=0.1), [1, 2, 3, 40, 5, 6], [7, 8, 9]),
        (shift(BOTH, 0.5, mu=slice(0.2, None)), [1, 2.5, 3.5, 4, 5.5, 6.5], [7, 8.5, 9.5]),
        (put("linf", 0.0, mu=[0.1, 0.4]), [1, 2, 3, 4, 5, 6], [0, 8, 0]),
        (roll("l2", {"mu": 1}, case="one"), [3, 1, 2, 4, 5, 6], [7, 8, 9]),
        (exchange("mu"), [3, 2, 1, 6, 5, 4], [9, 8, 7]),
        (exchange("mu", 0.1, 0.2, names="l2"), [2, 1, 3, 5, 4, 6], [7, 8, 9]),
        (exchange("case", "one", "two"), [4, 5, 6, 1, 2, 3], [7, 8, 9]),
        (repeat("mu", 0.4, at=0.1), [3, 2, 3, 6, 5, 6], [9, 8, 9]),
        (repeat("case", "one", at="two", names="l2"), [1, 2, 3, 1, 2, 3], [7, 8, 9]),
    ],
)
def test_a_verb_changes_what_it_names_and_keeps_labels(run, change, l2, linf):
    altered = change(run)
    assert altered["l2"].values.ravel().tolist() == l2 and altered["linf"].values.tolist() == linf
    assert altered["l2"].attrs == {"tolerance": 0.1} and altered["l2"].dims == ("case", "mu")
    assert altered["mu"].identical(run["mu"]) and altered["case"].identical(run["case"])
    assert run["l2"].values.ravel().tolist() == [1, 2, 3, 4, 5, 6]


def test_what_is_taken_has_the_attributes_of_its_place_and_what_is_not_kept_is_dropped(run):
    altered = changes.take(l2="linf")(run)["l2"]
    assert altered.values.tolist() == [7, 8, 9] and altered.attrs == {"tolerance": 0.1}
    altered = changes.take_from("l2", case="two")(run, -run)["l2"]
    assert altered.values.ravel().tolist() == [1, 2, 3, -4, -5, -6]
    altered = keep(mu=slice(0.2, None), case="two")(run)
    assert altered["l2"].values.tolist() == [[5, 6]] and altered["linf"].values.tolist() == [8, 9]


@pytest.mark.parametrize(
    "change",
    [scale("l2", 2.0, mu=0.3), exchange("case", "one", "three"), keep(mu=slice(1, None))],
)
def test_a_label_that_a_configuration_left_out_decides_nothing(run, change):
    with pytest.raises(
        UndecidableError, match=r"there is no (mu = 0\.3|case = three|mu from 1 to inf)"
    ):
        change(run)
