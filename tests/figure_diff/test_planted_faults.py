"""Planted faults, a row each: what is found with the accepted bits, and where any bits will do."""

from collections.abc import Callable
from typing import NamedTuple

import made_up_results as made_up
import numpy as np
import pytest
from latticode.datasets.netcdf import LENGTH, save
from made_up_results import HORIZON, PICTURE, TAU
from pendula.figure_diff import Status
from pendula.ledger.changes import exchange, put, scale, shift

REGULAR, CHAOTIC, SWEEP, TRUST, EXPONENTS, ROUNDING = made_up.NAMES[:6]
BOUND = made_up.BOUND
LEDGER, PART, TABLE, REPORT = made_up.NAMES[7:11]
DIFFERENT, DAMAGED, MISSING = Status.DIFFERENT, Status.DAMAGED, Status.MISSING
BEYOND, WITHIN = Status.BEYOND, Status.WITHIN


class Fault(NamedTuple):
    """What is wrong, in which file, how it is planted, and what any bits make of it."""

    name: str
    file: str
    plant: Callable
    any_bits: Status = DIFFERENT
    says: str = ""
    status: Status = DIFFERENT


def data(name: str, file: str, change: Callable, any_bits=DIFFERENT, says: str = "") -> Fault:
    """Return the fault of a dataset that `change` returns changed."""
    return Fault(name, file, lambda run: run.change(file, change), any_bits, says)


def text(name: str, file: str, old: str, new: str, any_bits=DIFFERENT, status=DIFFERENT, **how):
    """Return the fault of a text in which `old` is replaced once."""
    plant = lambda run: run.edit(file, old, new, **how)  # noqa: E731
    return Fault(name, file, plant, any_bits, "", status)


def content(name: str, file: str, change: Callable, status, any_bits=None) -> Fault:
    """Return the fault of a file whose bytes are changed."""

    def plant(run):
        (run.made / file).write_bytes(change((run.made / file).read_bytes()))

    return Fault(name, file, plant, any_bits or status, "", status)


def drawn(name: str, file: str = "figures/fig2.json", **how) -> Fault:
    """Return the fault of a figure that is drawn otherwise."""
    return Fault(name, file, lambda run: made_up.put(run.made, "fig2", made_up.norms(False), **how))


def flip(found: bytes) -> bytes:
    """Return a file with one bit in its middle flipped."""
    middle = len(found) // 2
    return found[:middle] + bytes([found[middle] ^ 1]) + found[middle + 1 :]


def paint(run):
    """Darken a picture, and leave what it says of itself."""
    from PIL import Image
    from PIL.PngImagePlugin import PngInfo

    with Image.open(run.made / PICTURE) as image:
        about = PngInfo()
        for key, said in image.text.items():
            about.add_text(key, said)
        image.point(lambda shade: shade // 2).save(run.made / PICTURE, pnginfo=about)


def of_older_run(kind: str) -> Callable:
    """Return a plant: all files of a figure are drawn from other data, but one kind is older."""

    def plant(run):
        older = (run.made / f"figures/fig2.{kind}").read_bytes()
        made_up.put(run.made, "fig2", made_up.norms(False) * 1.01)
        (run.made / f"figures/fig2.{kind}").write_bytes(older)

    return plant


def hidden(name: str, hide: Callable) -> Fault:
    """Return the fault of a dataset that holds more than xarray shows."""
    plant = lambda run: run.hide(REGULAR, hide)  # noqa: E731
    return Fault(name, REGULAR, plant, DAMAGED, name, DAMAGED)


def stale(run):
    """Put the run of another case in place of a trajectory."""
    save(run.made / REGULAR, made_up.norms(True).assign_attrs(omega=-4.0))


FAULTS = [
    # Numbers of a regular run
    data("last bit", REGULAR, shift("l2", 1e-15), WITHIN, "off by"),
    data("a part in 1e9", REGULAR, scale("l2", 1 + 1e-9), WITHIN),
    data("a part in 1e5", REGULAR, scale("l2", 1 + 1e-5), says="1e-06 is allowed"),
    data("NaN", REGULAR, put("l2", np.nan, component="A", tau=TAU[77]),
         says="NaN or infinity elsewhere, at 1 "),
    Fault("stale dataset", REGULAR, stale),
    # What a dataset holds
    data("tau moved", REGULAR, lambda d: d.assign_coords(tau=d["tau"] + 1e-9), says="coordinates"),
    data("names exchanged", REGULAR, lambda d: d.assign_coords(component=["B", "A"]), says="words"),
    data("sign of infinity", REGULAR, lambda d: d.assign(bound=-d["bound"])),
    data("whole number", REGULAR, lambda d: d.assign(sites=d["sites"] + 1), says="0 is allowed"),
    data("lost variable", REGULAR, lambda d: d.drop_vars("bound"), says="bound is gone"),
    data("other type", REGULAR, lambda d: d.astype("float32"), says="l2 is float32"),
    data("lost attribute", REGULAR, lambda d: d.drop_attrs(deep=False), says="absent"),
    data("other steps", REGULAR, lambda d: d.assign_attrs(steps=1600), BEYOND, "steps is 1600"),
    hidden("group", lambda file: file.createGroup("more")),
    hidden("dimension", lambda file: file.createDimension("more", 3)),
    content("lost seal", REGULAR, lambda found: found[:-LENGTH], DAMAGED),
    # What rests on chaos
    data("another tail", CHAOTIC, shift("l2", 1.0, tau=slice(HORIZON + 0.1, None)), BEYOND),
    data("huge number in the tail", CHAOTIC, put("l2", 1e300, tau=45.0), says="too much"),
    data("negative norms", CHAOTIC, scale("l2", -1.0, tau=slice(40, None)), says="negative"),
    data("NaN in the tail", CHAOTIC, put("l2", np.nan, tau=45.0), says="NaN"),
    data("a jump in time", CHAOTIC, put("l2", 14.0, tau=45.0, component="A"), says="range"),
    data("tail thrice as large", CHAOTIC, scale("l2", 3.0, tau=slice(40, None)), says="range"),
    data("another omega of the cases", EXPONENTS,
         lambda d: d.assign_coords(case=["fig4_small", "fig2_small"]), says="words"),
    data("before the horizon", CHAOTIC, put("l2", 2.5, component="A", tau=TAU[60]), says="off by"),
    data("tau of chaos moved", CHAOTIC, lambda d: d.assign_coords(tau=d["tau"] * (1 + 1e-12))),
    data("points of a sweep exchanged", SWEEP, exchange("half_width"), BEYOND),
    data("exponent of a regular case", EXPONENTS, shift("exponent", 0.01, case="fig2_small")),
    data("a horizon", TRUST, scale("difference", 1.1, case="fig4_small"), BEYOND),
    data("roundings", ROUNDING, scale("defect", 2.0), WITHIN, "by roundings"),
    data("roundings that are none", ROUNDING, scale("defect", 1e9)),
    data("proven bound times 0.01", BOUND, scale("bound", 0.01), says="what is proved"),
    drawn("A and B exchanged", "figures/fig2.json", components="BA"),
    # Texts
    text("criterion of a chaotic claim", LEDGER, "largest norm <= 9.5", "largest norm <= 95"),
    text("cut-off of a chaotic claim", LEDGER, '"value": 0.25', '"value": 0.5'),
    text("verdict in a table", TABLE, "| confirmed |", "| refuted |"),
    text("row more in a table", TABLE, "\n| ", "\n| one | Fig 4 | more | confirmed |\n| "),
    text("verdict", LEDGER, "confirmed", "not reproduced"),
    text("verdict by hand", LEDGER, "confirmed", "refuted", DAMAGED, DAMAGED, sealed=False),
    text("number of a claim", LEDGER, "6.60403", "6.60404"),
    text("verdict in the report", REPORT, "confirmed", "refuted"),
    text("verdict hidden in the report", REPORT, "<p>The claim is",
         '<section id="run"><p>The claim is refuted.</p></section><p>The claim is'),
    text("report without its times", REPORT,
         '<section id="run"><p>Wall time: 96 s</p></section>', ""),
    text("code of the live page in a report", REPORT, "</p>", '</p>"code": "AA=="'),
    content("emptied report", REPORT, lambda found: b"", DIFFERENT),
    content("flipped bit of a part", PART, flip, DAMAGED),
    # Pictures
    drawn("other label", label="norm"),
    drawn("other limit in the PDF", "figures/fig2.pdf", limit=9),
    Fault("axis nearly doubled", "figures/fig4.json",
          lambda run: made_up.put(run.made, "fig4", made_up.norms(True, seed=1), limit=15)),
    Fault("painted picture", PICTURE, paint),
    content(
        "painted PDF", "figures/fig2.pdf", lambda f: f.replace(b"%PDF-1.4", b"%PDF-1.5"), DIFFERENT
    ),
    content("flipped bit of a picture", PICTURE, flip, DAMAGED),
    Fault("older picture", PICTURE, of_older_run("png"), says="stale"),
    Fault("older description", "figures/fig2.json", of_older_run("json"), says="other data"),
    text("description by hand", "figures/fig2.json", "some case", "another case"),
    # Files
    content("empty picture", "figures/fig4.png", lambda found: b"", DAMAGED),
    Fault("lost dataset", REGULAR, lambda run: (run.made / REGULAR).unlink(), MISSING, "", MISSING),
]  # fmt: skip


@pytest.mark.parametrize("fault", FAULTS, ids=[fault.name for fault in FAULTS])
def test_a_planted_fault_is_found(fault, run, known):
    fault.plant(run)
    strictly, found = run.anew(fault.file, known)
    assert strictly.status == fault.status and strictly.status.is_fault, strictly
    assert found.status == fault.any_bits and fault.says in found.says, found
    assert fault.says in strictly.says


def test_an_untouched_run_is_identical(known):
    assert known.keys() == {*made_up.NAMES}
    assert {found.status for found in known.values()} == {Status.IDENTICAL}


OF_CHAOS = (
    *("huge number in the tail", "negative norms", "NaN in the tail", "tail thrice as large"),
    *("before the horizon", "proven bound times 0.01", "roundings that are none", "verdict"),
    *("criterion of a chaotic claim", "cut-off of a chaotic claim", "verdict in a table"),
    "row more in a table",
    *("verdict in the report", "A and B exchanged", "other label", "older picture"),
    "axis nearly doubled",
)
"""Faults that are found where chaos has taken another path too."""


@pytest.mark.parametrize("name", OF_CHAOS)
def test_a_planted_fault_is_found_in_a_run_with_other_last_bits(name, moved, known_of_moved):
    """tests/figure_diff/test_comparison.py finds nothing in that run as it is."""
    (fault,) = (fault for fault in FAULTS if fault.name == name)
    fault.plant(moved)
    _, found = moved.anew(fault.file, known_of_moved)
    assert found.status.is_fault, found
