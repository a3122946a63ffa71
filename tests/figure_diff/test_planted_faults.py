"""Faults that are planted into a run, one line each; the comparison must find every one.

A line says what is wrong, in which file it is, what the finding must say of the place, and how it
is planted. An untouched run has no fault, so that a comparison that refuses everything fails too.
"""

import json
from collections.abc import Callable
from typing import NamedTuple

import made_up_results as made_up
import numpy as np
import pytest
from made_up_results import CHAOTIC, LEDGER, PICTURE, REFERENCE, REGULAR, TABLE, regular
from pendula.figure_diff import DAMAGED, DIFFERENT, EXTRA, MISSING


class Fault(NamedTuple):
    """A fault: its name, the file, what the finding says of the place, and how it is planted."""

    name: str
    file: str
    where: str
    plant: Callable
    status: str = DIFFERENT


def in_data(name: str, file: str, where: str, change: Callable) -> Fault:
    """Return the fault of a dataset that `change` returns changed."""
    return Fault(name, file, where, lambda run: run.change(file, change))


def in_numbers(name: str, where: str, change: Callable) -> Fault:
    """Return the fault of the regular curves, whose array (component, tau) `change` changes."""

    def plant(data):
        change(data["l2"].values)
        return data

    return in_data(name, REGULAR, where, plant)


def in_text(name: str, file: str, where: str, old: str, new: str) -> Fault:
    """Return the fault of a text in which `old` is replaced once."""

    def plant(run):
        text = (run.made / file).read_text()
        assert text.count(old) >= 1
        (run.made / file).write_text(text.replace(old, new, 1))

    return Fault(name, file, where, plant)


def about(variable: str, **attributes) -> Callable:
    """Return a change of the attributes of one variable."""

    def change(data):
        data[variable].attrs.update(attributes)
        return data

    return change


def swap_components(data):
    """Exchange the curves of A and B and leave their names as they are."""
    return data.assign(l2=(data["l2"].dims, data["l2"].values[::-1], data["l2"].attrs))


def turn_time(data):
    """Let the curves run backwards, and leave the times as they are."""
    return data.assign(l2=(data["l2"].dims, data["l2"].values[:, ::-1], data["l2"].attrs))


def as_single(data):
    """Store the norms in another type of numbers."""
    return data.assign(l2=data["l2"].astype("float32"))


def put(index, value) -> Callable:
    """Return a change of some numbers of an array."""

    def change(array):
        array[index] = value

    return change


def raise_spike(array):
    """Raise one odd sample to ten times its value."""
    array[0, 777] *= 10


def bound(*values) -> Callable:
    """Return a change of the bounds; the accepted bounds are infinity and 9.5."""
    return lambda data: data.assign(bound=("component", list(values), data["bound"].attrs))


def empty(name: str) -> Callable:
    """Return a change that leaves nothing in a file."""
    return lambda run: (run.made / name).write_bytes(b"")


def cut(name: str) -> Callable:
    """Return a change that leaves half of a file."""

    def plant(run):
        content = (run.made / name).read_bytes()
        (run.made / name).write_bytes(content[: len(content) // 2])

    return plant


def remove(name: str) -> Callable:
    """Return a change that loses a file."""
    return lambda run: (run.made / name).unlink()


def edit_ledger(change: Callable) -> Callable:
    """Return a change of the rows of the ledger."""

    def plant(run):
        rows = made_up.ledger()
        change(rows)
        made_up.put_words(run.made, rows, made_up.table())

    return plant


def stale(run):
    """Put back the dataset that an earlier run made of the case."""
    run.change(REGULAR, lambda data: data.assign(l2=data["l2"].roll(tau=40)))


FAULTS = [
    # Attributes
    in_data("units of a norm", REGULAR, "l2: attribute units", about("l2", units="rad")),
    in_data("name of a norm", REGULAR, "l2: attribute long_name", about("l2", long_name="norm")),
    in_data("Omega", REGULAR, "attribute omega is -4.0", lambda d: d.assign_attrs(omega=-4.0)),
    in_data("solver", CHAOTIC, "attribute solver", lambda d: d.assign_attrs(solver="taylor")),
    in_data("lost attribute", REGULAR, "attribute omega is absent", lambda d: d.drop_attrs()),
    in_data("title", REGULAR, "attribute title", lambda d: d.assign_attrs(title="of another")),
    # Numbers of a regular curve, which the baseline keeps at every sample
    in_numbers("spike at an odd sample", "component=A", raise_spike),
    in_numbers("NaN at an odd sample", "component=B", put((1, 777), np.nan)),
    in_numbers("gap of many samples", "component=B", put((1, slice(701, 760)), np.nan)),
    in_numbers("last sample", "component=A", put((0, -1), 0.0)),
    in_numbers("first sample", "component=A", put((0, 0), 3.00001)),
    in_numbers("infinity in a curve", "component=A", put((0, 777), np.inf)),
    in_data("swapped components", REGULAR, "component=", swap_components),
    in_data("swapped names", REGULAR, "component", lambda d: d.assign_coords(component=["B", "A"])),
    in_data("time backwards", REGULAR, "component=", turn_time),
    in_data("times moved", REGULAR, "tau", lambda d: d.assign_coords(tau=d["tau"] + 0.025)),
    Fault("stale dataset", REGULAR, "component=", stale),
    # Numbers that are none
    in_data("infinity's sign", REGULAR, "bound component=A", bound(-np.inf, 9.5)),
    in_data("NaN for infinity", REGULAR, "bound component=A", bound(np.nan, 9.5)),
    in_data("number for infinity", REGULAR, "bound component=A", bound(1e30, 9.5)),
    in_data("words for numbers", REGULAR, "bound is words", bound("inf", "9.5")),
    # What a dataset holds
    in_data("lost variable", REGULAR, "bound is gone", lambda d: d.drop_vars("bound")),
    in_data("new variable", REGULAR, "linf is new", lambda d: d.assign(linf=d["l2"])),
    in_data("other type", REGULAR, "l2 is float32", as_single),
    in_data("dimensions exchanged", REGULAR, "l2 is float64 (tau", lambda d: d.transpose()),
    in_data("fewer times", REGULAR, "tau 1001", lambda d: d.isel(tau=slice(None, None, 2))),
    in_data("reference", REFERENCE, "l2", lambda d: d.assign(l2=d["l2"] * (1 + 1e-12))),
    # Files
    Fault("empty dataset", REGULAR, "cannot be read", empty(REGULAR), DAMAGED),
    Fault("half a dataset", REGULAR, "cannot be read", cut(REGULAR), DAMAGED),
    Fault("lost dataset", REGULAR, "was not made", remove(REGULAR), MISSING),
    Fault("lost picture", PICTURE, "was not made", remove(PICTURE), MISSING),
    Fault("empty picture", PICTURE, "", empty(PICTURE), DAMAGED),
    Fault("empty PDF", "figures/fig2.pdf", "PDF", empty("figures/fig2.pdf"), DAMAGED),
    Fault("half a PDF", "figures/fig2.pdf", "PDF", cut("figures/fig2.pdf"), DAMAGED),
    Fault("empty ledger", LEDGER, "no list", empty(LEDGER), DAMAGED),
    # Words
    in_text("verdict", LEDGER, "regular_bounded: verdict", "confirmed", "not reproduced"),
    in_text("number of a claim", LEDGER, "regular_bounded: measured largest", "2.99871", "2.99872"),
    in_text("words of a claim", LEDGER, "regular_bounded: says", "stays below", "stays above"),
    Fault("lost claim", LEDGER, "chaotic_bounded: name is gone", edit_ledger(lambda r: r.pop())),
    Fault("order of claims", LEDGER, "another order", edit_ledger(lambda r: r.reverse())),
    in_text("number in a table", TABLE, 'column 2 of "regular_bounded"', "2.99871", "2.99971"),
    in_text("name in a table", TABLE, "line 6", "chaotic_bounded", "chaotic_unbounded"),
    in_text("lost row of a table", TABLE, "is gone", "| chaotic_bounded | 6.60403 |\n", ""),
]


@pytest.mark.parametrize("fault", FAULTS, ids=[fault.name for fault in FAULTS])
def test_a_planted_fault_is_found(fault, run):
    fault.plant(run)
    found = run.findings()[fault.file]
    assert found.status == fault.status and fault.where in found.says, found.line


def test_an_extra_file_is_found(run):
    made_up.save(run.made / "checks/new.nc", regular())
    found = run.findings([*made_up.NAMES, "checks/new.nc"])["checks/new.nc"]
    assert found.status == EXTRA


def test_a_file_that_the_rules_make_no_longer_is_found(run):
    names = [name for name in made_up.NAMES if name != TABLE]
    assert run.findings(names)[TABLE].status == MISSING


def test_an_untouched_run_has_no_fault_and_nothing_nearly_the_same(run):
    assert {each.status for each in run.compare(made_up.NAMES)} == {"identical"}


def test_each_fault_has_its_own_name():
    names = [fault.name for fault in FAULTS]
    assert len(names) == len(set(names))


def test_numbers_of_words_may_follow_a_dataset_that_moved_as_little(run):
    """The ledger prints six digits, so a last digit may change where a regular curve moves 1e-7."""
    run.change(REGULAR, lambda data: made_up.change_a(data, 1 + 1e-7))
    rows = made_up.ledger()
    rows[0]["measured"]["largest"] = 2.99872
    made_up.put_words(run.made, rows, made_up.table().replace("2.99871", "2.99872"))
    found = run.findings()
    assert found[LEDGER].status == found[TABLE].status == "nearly the same"
    assert "regular_bounded: measured largest" in found[LEDGER].says

    rows[0]["measured"]["largest"] = 3.1
    made_up.put_words(run.made, rows, made_up.table().replace("2.99871", "3.1"))
    found = run.findings()
    assert found[LEDGER].status == found[TABLE].status == DIFFERENT


def test_a_claim_may_follow_only_the_datasets_that_decide_it(run):
    run.change(REGULAR, lambda data: made_up.change_a(data, 1 + 1e-7))
    rows = made_up.ledger()
    rows[1]["measured"]["largest"] = 6.60404
    made_up.put_words(run.made, rows, made_up.table())
    assert run.findings()[LEDGER].status == DIFFERENT


def test_numbers_may_follow_chaos_but_no_verdict_and_no_word(run):
    made_up.save(run.made / CHAOTIC, made_up.chaotic(seed=3))
    rows = made_up.ledger()
    rows[1]["measured"]["largest"], rows[1]["because"] = 6.9, "the largest norm is 6.9"
    made_up.put_words(run.made, rows, made_up.table())
    assert run.findings()[LEDGER].status == "nearly the same"
    rows[1]["because"] = "the least norm is 6.9"
    made_up.put_words(run.made, rows, made_up.table())
    assert "chaotic_bounded: because" in run.findings()[LEDGER].says
    rows[1]["verdict"] = "not reproduced"
    (run.made / LEDGER).write_text(json.dumps(rows, indent=1) + "\n")
    found = run.findings()[LEDGER]
    assert found.status == DIFFERENT and found.says.startswith("chaotic_bounded: verdict")
