"""Planted faults, a row each: what is found in the accepted environment, with bits=any, elsewhere.

Of some no environment but the accepted one can know that they are none of its own roundings.
"""

import re
import zlib
from collections.abc import Callable
from typing import NamedTuple

import made_up_results as made_up
import numpy as np
import pytest
from latticode.datasets.netcdf import LENGTH, save
from latticode.drawing import style
from latticode.drawing.seals import PIXELS, SEALED, digest_of_pixels, sealed_pdf
from made_up_results import HORIZON, PICTURE, TAU
from PIL import Image
from PIL.PngImagePlugin import PngInfo
from replication.figure_diff import Status
from replication.figure_diff.compare_pictures import SHOWN_TEXT, STREAM
from replication.ledger.changes import exchange, put, roll, scale, shift

REGULAR, CHAOTIC, SWEEP, TRUST, EXPONENTS, ROUNDING = made_up.NAMES[:6]
MAP, BOUND, LIVES, PROOFS, HARD = (
    made_up.MAP,
    made_up.BOUND,
    made_up.LIVES,
    made_up.PROOFS,
    made_up.HARD,
)
LEDGER, THEORY, TABLE, REPORT, LIVE = (
    made_up.LEDGER,
    made_up.THEORY,
    made_up.TABLE,
    made_up.REPORT,
    made_up.LIVE,
)
DIFFERENT, DAMAGED, MISSING = Status.DIFFERENT, Status.DAMAGED, Status.MISSING
BEYOND, WITHIN = Status.BEYOND, Status.WITHIN
PDF = "figures/fig2.pdf"


class Fault(NamedTuple):
    """What is wrong, in which file, how it is planted, and what any bits make of it.

    Where other versions make something else of it, `elsewhere` says what.
    """

    name: str
    file: str
    plant: Callable
    any_bits: Status = DIFFERENT
    reason: str = ""
    status: Status = DIFFERENT
    elsewhere: Status | None = None


def data(name: str, file: str, change: Callable, any_bits=DIFFERENT, reason: str = "") -> Fault:
    """Return the fault of a dataset that `change` returns changed."""
    return Fault(name, file, lambda run: run.change(file, change), any_bits, reason)


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


def flip(content: bytes) -> bytes:
    """Return a file with one bit in its middle flipped."""
    middle = len(content) // 2
    return content[:middle] + bytes([content[middle] ^ 1]) + content[middle + 1 :]


def repainted(name: str, change: Callable, is_drawn_so: bool) -> Fault:
    """Return the fault of a picture whose pixels are changed, but not what it says of itself.

    If it `is_drawn_so`, its digest is that of the changed pixels.
    """

    def plant(run):
        with Image.open(run.made / PICTURE) as image:
            texts, changed = dict(image.text), change(np.array(image.convert("RGBA")))
        if is_drawn_so:
            texts[PIXELS] = digest_of_pixels(changed)
        metadata = PngInfo()
        for key, text in texts.items():
            metadata.add_text(key, text)
        Image.fromarray(changed).save(run.made / PICTURE, pnginfo=metadata)

    status = DIFFERENT if is_drawn_so else DAMAGED
    return Fault(
        f"{name}{' when drawn' if is_drawn_so else ''}", PICTURE, plant, status, "", status
    )


def rewritten(name: str, change: Callable, is_drawn_so: bool) -> Fault:
    """Return the fault of a PDF of which `change` makes other content, sealed if it is drawn so."""

    def plant(run):
        def packed(match):
            if match[1][:1] != b"x":  # not what zlib has packed
                return match[0]
            return b"stream\n" + zlib.compress(change(zlib.decompress(match[1]))) + b"\nendstream"

        content = SEALED.fullmatch((run.made / PDF).read_bytes())[1]
        changed = STREAM.sub(
            lambda match: packed(match) if match[1][:1] == b"x" else match[0], content
        )
        assert changed != content
        (run.made / PDF).write_bytes(sealed_pdf(changed) if is_drawn_so else changed)

    if is_drawn_so:
        return Fault(f"{name} when drawn", PDF, plant)
    return Fault(name, PDF, plant, DAMAGED, "", DAMAGED)


def darkened(pixels: np.ndarray) -> np.ndarray:
    return np.concatenate([pixels[..., :3] // 2, pixels[..., 3:]], axis=-1)


def with_red_and_blue_exchanged(pixels: np.ndarray) -> np.ndarray:
    return np.ascontiguousarray(pixels[..., [2, 1, 0, 3]])


def with_a_white_box(pixels: np.ndarray) -> np.ndarray:
    height, width = pixels.shape[:2]
    pixels[height // 3 : 2 * height // 3, width // 5 : 2 * width // 5] = 255
    return pixels


def without_text(stream: bytes) -> bytes:
    return SHOWN_TEXT.sub(b"", stream)


def with_exchanged_strokes(stream: bytes) -> bytes:
    """Return a stream of a PDF in which each red is a blue, and each blue a red."""
    red, blue = (
        b" ".join(b"%.9f" % (int(colour[i : i + 2], 16) / 255) for i in (1, 3, 5))
        for colour in (style.RED, style.BLUE)
    )
    number = rb"([\d.]+) ([\d.]+) ([\d.]+) (RG|rg)"

    def exchanged(match):
        colour = np.array(match.groups()[:3], float)
        ends = [np.array(each.split(), float) for each in (red, blue)]
        hits = [i for i in (0, 1) if np.allclose(colour, ends[i], atol=1e-3)]
        return (red, blue)[1 - hits[0]] + b" " + match[4] if hits else match[0]

    return re.sub(number, exchanged, stream)


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


def exchanged_late(data):
    """Exchange the norms of A and B after the horizon."""
    return data.assign(l2=data["l2"].where(data["tau"] < HORIZON + 0.3, data["l2"].values[::-1]))


def add(**variables) -> Callable:
    return lambda data: data.assign(variables)


def describe(key: str, **attributes) -> Callable:
    """Return a change of the attributes of a variable."""
    return lambda data: data.assign({key: data[key].assign_attrs(attributes)})


ENUM = {"regular": 0, "chaotic": 1}

FAULTS = [
    # Numbers of a regular run
    data("last bit", REGULAR, shift("l2", 1e-15), WITHIN, "off by"),
    data("a part in 1e9", REGULAR, scale("l2", 1 + 1e-9), WITHIN),
    data("a part in 1e5", REGULAR, scale("l2", 1 + 1e-5), reason="1e-06 is allowed"),
    data(
        "NaN",
        REGULAR,
        put("l2", np.nan, component="A", tau=TAU[77]),
        reason="differs in NaN or infinity, at 1 ",
    ),
    Fault("stale dataset", REGULAR, stale),
    data("sign", REGULAR, scale("l2", -1.0)),
    data("A and B exchanged", REGULAR, exchange("component", names="l2")),
    data("late by an output", REGULAR, roll("l2", {"tau": 1})),
    data("one number", REGULAR, put("l2", 2.0, component="A", tau=TAU[200])),
    data("zeros", REGULAR, put("l2", 0.0, tau=slice(40, None))),
    # What a dataset holds
    data(
        "tau moved", REGULAR, lambda d: d.assign_coords(tau=d["tau"] + 1e-9), reason="coordinates"
    ),
    data(
        "names exchanged", REGULAR, lambda d: d.assign_coords(component=["B", "A"]), reason="texts"
    ),
    data("sign of infinity", REGULAR, lambda d: d.assign(bound=-d["bound"])),
    data("whole number", REGULAR, lambda d: d.assign(sites=d["sites"] + 1), reason="0 is allowed"),
    data("lost variable", REGULAR, lambda d: d.drop_vars("bound"), reason="bound is missing"),
    data(
        "variable more",
        REGULAR,
        add(more=((), 1.0, {"long_name": "more"})),
        reason="more is not in",
    ),
    data("other type", REGULAR, lambda d: d.astype("float32"), reason="l2 is float32"),
    data("lost attribute", REGULAR, lambda d: d.drop_attrs(deep=False), reason="absent"),
    data("attribute more", REGULAR, lambda d: d.assign_attrs(more=1), reason="attribute more is 1"),
    data("other omega", REGULAR, lambda d: d.assign_attrs(omega=-8.0), reason="attribute omega"),
    data("other units", REGULAR, describe("l2", units="rad"), reason="l2: attribute units"),
    data(
        "other name", REGULAR, describe("l2", long_name="the square"), reason="attribute long_name"
    ),
    data("other steps", REGULAR, lambda d: d.assign_attrs(steps=1600), BEYOND, "steps is 1600"),
    data("other order of axes", REGULAR, lambda d: d.assign(l2=d["l2"].T), reason="l2 is float64"),
    data("a time less", REGULAR, lambda d: d.isel(tau=slice(None, -1)), reason="tau 400"),
    hidden("group", lambda file: file.createGroup("more")),
    hidden("dimension", lambda file: file.createDimension("more", 3)),
    hidden("type", lambda file: file.createEnumType(np.int8, "fate", ENUM)),
    content("lost seal", REGULAR, lambda content: content[:-LENGTH], DAMAGED),
    content("flipped bit", REGULAR, flip, DAMAGED),
    Fault(
        "attribute that hides numbers",
        REGULAR,
        lambda run: run.change(REGULAR, lambda d: d, fill={"l2": 1e30}),
        DAMAGED,
        "hidden attribute: l2:_FillValue",
        DAMAGED,
    ),
    # What rests on chaos
    data("another tail", CHAOTIC, shift("l2", 1.0, tau=slice(HORIZON + 10, None)), BEYOND),
    data("huge number in the tail", CHAOTIC, put("l2", 1e300, tau=45.0), reason="too much"),
    data("negative norms", CHAOTIC, scale("l2", -1.0, tau=slice(40, None)), reason="negative"),
    data("NaN in the tail", CHAOTIC, put("l2", np.nan, tau=45.0), reason="NaN"),
    data("a jump in time", CHAOTIC, put("l2", 14.0, tau=45.0, component="A"), reason="range"),
    data("tail thrice as large", CHAOTIC, scale("l2", 3.0, tau=slice(40, None))),
    data(
        "before the horizon", CHAOTIC, put("l2", 2.5, component="A", tau=TAU[60]), reason="off by"
    ),
    data("A and B exchanged after the horizon", CHAOTIC, exchanged_late, reason="soon after"),
    data(
        "a tail that begins at the horizon",
        CHAOTIC,
        shift("l2", 0.1, tau=slice(HORIZON + 0.3, None)),
        reason="soon after",
    ),
    data("tau of chaos moved", CHAOTIC, lambda d: d.assign_coords(tau=d["tau"] * (1 + 1e-12))),
    data("points of a sweep exchanged", SWEEP, exchange("half_width", names="l2")),
    data("sweep shifted by a half-width", SWEEP, roll("l2", {"half_width": 1})),
    data("sweep lower by a fifth", SWEEP, scale("l2", 0.8), reason="differs by too much"),
    data("sweep by another draw", SWEEP, scale("l2", 1.005), BEYOND),
    data(
        "half-widths of a sweep",
        SWEEP,
        lambda d: d.assign_coords(half_width=d["half_width"] + 5),
        reason="coordinates",
    ),
    data(
        "fates at a regular omega",
        MAP,
        put("fate", 3.0, omega=8.0, half_width=20.0),
        reason="fate is off",
    ),
    data(
        "fates at a chaotic omega", MAP, put("fate", 3.0, omega=0.0), reason="differs by too much"
    ),
    data("lifetimes halved", LIVES, scale("median", 0.5), reason="differs by too much"),
    data("lifetimes exchanged", LIVES, exchange("half_width", names="median")),
    data(
        "names of cases exchanged",
        EXPONENTS,
        lambda d: d.assign_coords(case=["fig4_small", "fig2_small"]),
        reason="texts",
    ),
    data("exponent of a regular case", EXPONENTS, shift("exponent", 0.01, case="fig2_small")),
    data("exponent halved", EXPONENTS, scale("exponent", 0.5, case="fig4_small")),
    data("a horizon", TRUST, scale("difference", 1.1, case="fig4_small")),
    # Roundings and proofs
    data("roundings", ROUNDING, scale("defect", 2.0), WITHIN, "by rounding"),
    data("roundings that are none", ROUNDING, scale("defect", 1e9)),
    data("proven bound times 0.01", BOUND, scale("bound", 0.01), reason="smaller than the"),
    data("proven radius times 0.995", PROOFS, scale("radius", 0.995), reason="smaller than the"),
    data("proven radius times 1.05", PROOFS, scale("radius", 1.05), reason="exceeds the"),
    data("proven radius times 1.005", PROOFS, scale("radius", 1.005), WITHIN),
    data("errors of hard cases", HARD, put("error", 9e-9)),
    data("error of no hard case", HARD, put("error", np.nan, row=1)),
    # Texts
    text("criterion of a chaotic claim", LEDGER, "largest norm <= 9.5", "largest norm <= 95"),
    text("cut-off of a chaotic claim", LEDGER, '"value": 0.25', '"value": 0.5'),
    text("verdict in a table", TABLE, "| confirmed |", "| refuted |"),
    text("row more in a table", TABLE, "\n| ", "\n| one | Fig 4 | more | confirmed |\n| "),
    text("row less in a table", TABLE, "| bounded | confirmed |\n", ""),
    text("verdict", LEDGER, "confirmed", "not reproduced"),
    text("sentence of a claim", LEDGER, "stays below 9.5", "stays above 9.5"),
    text("datasets of a claim", LEDGER, "trajectories/fig4_small", "trajectories/fig2_small"),
    text("verdict by hand", LEDGER, "confirmed", "refuted", DAMAGED, DAMAGED, sealed=False),
    text("number of a claim", LEDGER, "6.60403", "6.60404"),
    text("verdict in the report", REPORT, "confirmed", "refuted"),
    text(
        "verdict hidden in the report",
        REPORT,
        "<p>The claim is",
        '<section id="run"><p>The claim is refuted.</p></section><p>The claim is',
    ),
    text("verdict among the times", REPORT, "Wall time: 96 s", "all 77 claims are refuted"),
    text("line more among the times", REPORT, "</p>\n</section>", "</p>\n<p>Bad.</p>\n</section>"),
    text(
        "report without its times",
        REPORT,
        '<section id="run">\n<p>Wall time: 96 s</p>\n</section>',
        "",
    ),
    text("code of the live page in a report", REPORT, "</p>", '</p>"code": "AA=="'),
    content("emptied report", REPORT, lambda content: b"", DIFFERENT),
    text("other WebAssembly", LIVE, '"code": "AGFz', '"code": "AGFt')._replace(elsewhere=WITHIN),
    text("words of the live page", LIVE, "Run a case.", "Run no case."),
    content("flipped bit of a part", THEORY, flip, DAMAGED),
    # Pictures
    drawn("curves of A and B exchanged", components="BA"),
    drawn("other colours", colours="BA"),
    drawn("a panel less", panels=1),
    drawn("other label", label="norm"),
    drawn("other limit in the PDF", PDF, limit=9),
    Fault(
        "axis nearly doubled",
        "figures/fig4.json",
        lambda run: made_up.put(run.made, "fig4", made_up.norms(True, seed=1), limit=15),
    ),
    *(repainted("darkened picture", darkened, is_drawn_so) for is_drawn_so in (False, True)),
    *(
        repainted("red and blue exchanged", with_red_and_blue_exchanged, is_drawn_so)
        for is_drawn_so in (False, True)
    ),
    *(
        repainted("white box over a curve", with_a_white_box, is_drawn_so)
        for is_drawn_so in (False, True)
    ),
    *(rewritten("text lost in a PDF", without_text, is_drawn_so) for is_drawn_so in (False, True)),
    rewritten("colours of a PDF", with_exchanged_strokes, False),
    rewritten("colours of a PDF", with_exchanged_strokes, True)._replace(elsewhere=BEYOND),
    content("other version of PDF", PDF, lambda f: f.replace(b"%PDF-1.4", b"%PDF-1.5"), DAMAGED),
    content("flipped bit of a picture", PICTURE, flip, DAMAGED),
    Fault("older picture", PICTURE, of_older_run("png"), reason="stale"),
    Fault("older description", "figures/fig2.json", of_older_run("json"), reason="describes data"),
    text("description by hand", "figures/fig2.json", "some case", "another case"),
    # Files
    content("empty picture", "figures/fig4.png", lambda content: b"", DAMAGED),
    Fault("lost dataset", REGULAR, lambda run: (run.made / REGULAR).unlink(), MISSING, "", MISSING),
]


@pytest.mark.parametrize("fault", FAULTS, ids=[fault.name for fault in FAULTS])
def test_a_planted_fault_is_found(fault, run, known):
    fault.plant(run)
    accepted, any_bits, elsewhere = run.anew(fault.file, known)
    assert accepted.status == fault.status and accepted.status.is_fault, accepted
    assert any_bits.status == fault.any_bits and fault.reason in any_bits.reason, any_bits
    assert elsewhere.status == (fault.elsewhere or fault.any_bits), elsewhere
    assert fault.reason in accepted.reason


def test_most_faults_are_told_in_every_environment():
    """This list stands for the kinds of faults; what is not told elsewhere may be a right run."""
    columns = [(f.status, f.any_bits, f.elsewhere or f.any_bits) for f in FAULTS]
    counts = [sum(status.is_fault for status in column) for column in zip(*columns, strict=True)]
    assert counts == [len(FAULTS), 98, 96] and len(FAULTS) == 105


def test_an_untouched_run_is_identical(known):
    assert known.keys() == {*made_up.NAMES}
    assert {finding.status for finding in known.values()} == {Status.IDENTICAL}


OF_CHAOS = (
    "huge number in the tail",
    "negative norms",
    "NaN in the tail",
    "tail thrice as large",
    "before the horizon",
    "proven bound times 0.01",
    "roundings that are none",
    "verdict",
    "sweep shifted by a half-width",
    "lifetimes halved",
    "fates at a regular omega",
    "A and B exchanged after the horizon",
    "proven radius times 0.995",
    "errors of hard cases",
    "red and blue exchanged when drawn",
    "text lost in a PDF when drawn",
    "criterion of a chaotic claim",
    "cut-off of a chaotic claim",
    "verdict in a table",
    "row more in a table",
    "verdict in the report",
    "curves of A and B exchanged",
    "other label",
    "older picture",
    "axis nearly doubled",
)
"""Faults that are found where chaos has taken another path too."""


@pytest.mark.parametrize("name", OF_CHAOS)
def test_a_planted_fault_is_found_in_a_run_with_other_last_bits(name, moved, known_of_moved):
    """tests/replication/figure_diff/test_comparison.py finds nothing in that run as it is."""
    (fault,) = (fault for fault in FAULTS if fault.name == name)
    fault.plant(moved)
    _, any_bits, elsewhere = moved.anew(fault.file, known_of_moved)
    assert any_bits.status.is_fault and elsewhere.status.is_fault, (any_bits, elsewhere)
