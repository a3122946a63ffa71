"""Faults that are planted into a picture, one line each, and found wherever it is compared.

Each is drawn twice: of the accepted data, and of chaotic data that have moved, where pixels say
little. The description must name panel and text, whatever drew the picture.
"""

import json
import re
import shutil
from collections.abc import Callable
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

import pytest
from made_up_results import NAMES, TAU, chaotic, regular
from matplotlib.backends.backend_pdf import FigureCanvasPdf
from pendula.drawing import style
from pendula.drawing.description import as_text, describe
from pendula.figure_diff import DAMAGED, DIFFERENT, IDENTICAL, MISSING, NEARLY, Motion
from pendula.figure_diff.compare_description import judge, read_description, shows_rounding
from PIL import Image
from PIL.PngImagePlugin import PngInfo

STEM = "fig4_spacetime"
"""The table of tolerances knows data of this name as chaotic."""
PNG, PDF, JSON, DATA = (f"figures/{STEM}.{kind}" for kind in ("png", "pdf", "json", "nc"))
SHOWN = [PNG, PDF, JSON, DATA]
EVERY = [*NAMES, *SHOWN]


class Fault(NamedTuple):
    """A fault: its name, what the finding must say, and how a drawn figure gets it."""

    name: str
    says: str
    plant: Callable


@style.styled
def draw(data):
    """Return a figure with one of each: curves, legend, annotation, map of colours and its bar."""
    figure = style.new_figure(3.0, 1.3)
    left, right = figure.subplots(1, 2)
    for component in "AB":
        look = {"color": style.COLOURS[component], "label": f"${component}$"}
        left.plot(TAU[::20], data["l2"].sel(component=component)[::20], **look)
    left.set(xlabel=r"$\tau$", ylabel="height (m)", xlim=(0, 50), ylim=(0, 8))
    left.set_title(r"(a) $\Omega = 8$", loc="left")
    left.annotate("summit", (20, 6), (30, 7), arrowprops={"arrowstyle": "-"})
    image = right.imshow(data["l2"][:, ::20], cmap="inferno", aspect="auto", vmin=0, vmax=8)
    figure.colorbar(image, ax=right).set_label("modulus")
    right.set(xlabel=r"$\tau$", ylabel="component")
    right.set_title("(b) map", loc="left")
    style.name_legend(figure, left)
    return figure


def nothing(figure):
    """Plant no fault."""


def put(folder, data, plant=nothing):
    """Write the figure with a fault, and all that stands beside it."""
    figure = draw(data)
    style.styled(plant)(figure)
    style.save(figure, data, *(folder / name for name in (PNG, PDF, DATA, JSON)))


@cache
def files_of(seed: int, plant: Callable) -> dict[str, bytes]:
    """Return the same files of chaotic data; each figure is drawn once for all tests."""
    with TemporaryDirectory() as folder:
        (Path(folder) / "figures").mkdir()
        put(Path(folder), chaotic(seed), plant)
        return {name: (Path(folder) / name).read_bytes() for name in SHOWN}


def write(run, *names: str, seed: int = 0, plant: Callable = nothing) -> None:
    """Write these files, or all, of the figure with a fault as another run would have made them."""
    for name, content in files_of(seed, plant).items():
        if not names or name in names:
            (run.made / name).write_bytes(content)


def left(plant: Callable) -> Callable:
    """Return the fault of the panel (a)."""
    return lambda figure: plant(figure.axes[0])


def right(plant: Callable) -> Callable:
    """Return the fault of the map of colours in the panel (b)."""
    return lambda figure: plant(figure.axes[1].images[0])


def exchange(one, other, name: str) -> None:
    """Exchange a property of two artists."""
    pair = [getattr(artist, f"get_{name}")() for artist in (one, other)]
    getattr(one, f"set_{name}")(pair[1])
    getattr(other, f"set_{name}")(pair[0])


def exchange_letters(figure):
    """Exchange (a) and (b)."""
    figure.axes[0].set_title(r"(b) $\Omega = 8$", loc="left")
    figure.axes[1].set_title("(a) map", loc="left")


def exchange_points(axes):
    """Draw the data of A as B."""
    exchange(*axes.lines, "ydata")


def lose_panel(figure):
    """Lose the panel (b) with its bar."""
    for axes in figure.axes[1:]:
        axes.set_visible(False)


PANEL = "panel 1 '(a) $\\Omega = 8$'"
BAR = "panel 3"
MAP = "panel 2 '(b) map'"
FAULTS = [
    Fault(
        "legend texts exchanged",
        'legend 1: entry 1 \'$A$\': text is "$B$" in place of "$A$"',
        lambda figure: exchange(*figure.legends[0].get_texts(), "text"),
    ),
    Fault(
        "colours in the legend exchanged",
        f'legend 1: entry 1 \'$A$\': colour is "{style.BLUE}" in place of "{style.RED}"',
        lambda figure: exchange(*figure.legends[0].get_lines(), "color"),
    ),
    Fault(
        "entry of the legend lost",
        "legend 1: has 1 entry in place of 2",
        lambda figure: (
            figure.legends[0].remove(),
            figure.legend(handles=figure.axes[0].lines[:1], loc="outside upper center"),
        ),
    ),
    Fault(
        "colours of A and B exchanged",
        f'{PANEL}: curve 1 \'$A$\': colour is "{style.BLUE}" in place of "{style.RED}"',
        left(lambda axes: exchange(*axes.lines, "color")),
    ),
    Fault(
        "names of A and B exchanged",
        f'{PANEL}: curve 1 \'$A$\': label is "$B$" in place of "$A$"',
        left(lambda axes: exchange(*axes.lines, "label")),
    ),
    Fault(
        "dashed in place of solid",
        f'{PANEL}: curve 2 \'$B$\': line is "--" in place of "-"',
        left(lambda axes: axes.lines[1].set_linestyle("--")),
    ),
    Fault(
        "curve not drawn",
        f"{PANEL}: has 1 curve in place of 2",
        left(lambda axes: axes.lines[1].remove()),
    ),
    Fault(
        "curve without points",
        f"{PANEL}: curve 2 '$B$': points is 0 in place of 101",
        left(lambda axes: axes.lines[1].set_data([], [])),
    ),
    Fault(
        "curve drawn twice",
        f"{PANEL}: has 3 curves in place of 2",
        left(lambda axes: axes.plot(TAU[::20], TAU[::20] / 10)),
    ),
    Fault(
        "y label without its unit",
        f'{PANEL}: y axis: label is "height" in place of "height (m)"',
        left(lambda axes: axes.set_ylabel("height")),
    ),
    Fault(
        "lost x label",
        f'{PANEL}: x axis: label is absent in place of "$\\\\tau$"',
        left(lambda axes: axes.set_xlabel("")),
    ),
    Fault(
        "logarithmic in place of linear",
        f'{PANEL}: y axis: scale is "log" in place of "linear"',
        left(lambda axes: axes.set(yscale="log", ylim=(0.1, 8))),
    ),
    Fault(
        "limits cut",
        f"{PANEL}: y axis: limits is [0.0, 5.0] in place of [0.0, 8.0]",
        left(lambda axes: axes.set_ylim(0, 5)),
    ),
    Fault(
        "axis upside down",
        f"{PANEL}: y axis: limits is [8.0, 0.0] in place of [0.0, 8.0]",
        left(lambda axes: axes.set_ylim(8, 0)),
    ),
    Fault(
        "Omega in a title",
        f'{PANEL}: title is "(a) $\\\\Omega = -8$" in place of',
        left(lambda axes: axes.set_title(r"(a) $\Omega = -8$", loc="left")),
    ),
    Fault("panel letters exchanged", f'{PANEL}: title is "(b) ', exchange_letters),
    Fault("panel missing", "has 1 panel in place of 3", lose_panel),
    Fault(
        "annotation lost",
        f"{PANEL}: has 0 texts in place of 1",
        left(lambda axes: axes.texts[0].remove()),
    ),
    Fault(
        "annotation elsewhere",
        f"{PANEL}: text 1 'summit': stands at is [30.0, 2.0] in place of [30.0, 7.0]",
        left(lambda axes: axes.texts[0].set_position((30, 2))),
    ),
    Fault(
        "annotation points elsewhere",
        f"{PANEL}: text 1 'summit': points at is [40.0, 6.0] in place of [20.0, 6.0]",
        left(lambda axes: setattr(axes.texts[0], "xy", (40, 6))),
    ),
    Fault(
        "text on the page",
        "has 1 text in place of 0",
        lambda figure: figure.text(0.5, 0.5, "draft"),
    ),
    Fault(
        "another colour map",
        f'{MAP}: image 1: colour map is "viridis ',
        right(lambda image: image.set_cmap("viridis")),
    ),
    Fault(
        "colour map upside down",
        f'{MAP}: image 1: colour map is "inferno_r #fcffa4 #ba3655 #000004" in place of',
        right(lambda image: image.set_cmap("inferno_r")),
    ),
    Fault(
        "limits of colours cut",
        f"{MAP}: image 1: limits is [0.0, 4.0] in place of [0.0, 8.0]",
        right(lambda image: image.set_clim(0, 4)),
    ),
    Fault(
        "label of the colour bar lost",
        f'{BAR}: y axis: label is absent in place of "modulus"',
        lambda figure: figure.axes[2].set_ylabel(""),
    ),
    Fault(
        "extent of the map",
        f"{MAP}: image 1: extent is [0.0, 50.0, 0.0, 2.0] in place of",
        right(lambda image: image.set_extent((0, 50, 0, 2))),
    ),
]
"""Those that moved data cannot excuse."""

OF_SAME_DATA = [
    Fault(
        "wrong ticks",
        f'{PANEL}: x axis: ticks is ["0", "5", "9"] in place of ["0", "20", "40"]',
        left(lambda axes: axes.set_xticks([0, 20, 40], ["0", "5", "9"])),
    ),
    Fault(
        "data of A and B exchanged",
        f"{PANEL}: curve 1 '$A$': y is ",
        left(exchange_points),
    ),
    Fault(
        "limits cut by little",
        f"{PANEL}: y axis: limits is [0.0, 7.999] in place of [0.0, 8.0]",
        left(lambda axes: axes.set_ylim(0, 7.999)),
    ),
]
"""Those that only the accepted data show; where data moved, their own comparison looks for them."""


@pytest.fixture(scope="module")
def accepted(accepted_run, tmp_path_factory):
    """Return the run with the figure, accepted once."""
    folder = tmp_path_factory.mktemp("pictures")
    copies = (shutil.copytree(path, folder / path.name) for path in accepted_run)
    run = type(accepted_run)(*copies)
    put(run.made, chaotic())
    run.accept(EVERY)
    return run


@pytest.fixture
def drawn(accepted, tmp_path):
    """Return a copy of that run and of its baseline, to be changed."""
    copies = (shutil.copytree(path, tmp_path / path.name) for path in accepted)
    return type(accepted)(*copies)


def in_both_environments(run, names=SHOWN) -> list[dict]:
    """Return the findings in the environment of the baseline, and in another one."""
    same = run.findings(names)
    run.move_to_another_environment()
    return [same, run.findings(names)]


@style.styled
def description(data, plant=lambda figure: None) -> dict:
    """Return the description of the figure with a fault, as it is read from a file."""
    figure = draw(data)
    plant(figure)
    for axes in figure.axes:  # matplotlib finds ticks when it draws, or when it is asked for them
        axes.get_xticklabels(), axes.get_yticklabels()
    return json.loads(as_text(describe(figure, data)))


@cache
def described(plant: Callable = nothing) -> dict:
    """Return the description of the accepted data, drawn once for all tests; do not change it."""
    return description(chaotic(), plant)


@pytest.mark.parametrize("fault", [*FAULTS, *OF_SAME_DATA], ids=lambda fault: fault.name)
def test_a_fault_is_told_by_panel_and_text(fault):
    found = judge(JSON, described(), described(fault.plant), Motion.NONE)
    assert found.status == DIFFERENT and fault.says in found.line


@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: fault.name)
def test_a_fault_is_told_where_the_data_have_moved(fault):
    moved = described(fault.plant) | {"data": "of another run"}
    found = judge(JSON, described(), moved, Motion.SEEN)
    assert found.status == DIFFERENT and fault.says in found.line


IN_FILES = [
    each for each in FAULTS if each.name in ("legend texts exchanged", "another colour map")
]


@pytest.mark.parametrize("seed", [0, 7], ids=["accepted data", "moved data"])
@pytest.mark.parametrize("fault", IN_FILES, ids=lambda fault: fault.name)
def test_a_fault_is_told_in_every_environment(drawn, fault, seed):
    write(drawn, seed=seed, plant=fault.plant)
    for found in in_both_environments(drawn):
        assert found[JSON].status == DIFFERENT and fault.says in found[JSON].line
        assert found[DATA].status == (NEARLY if seed else IDENTICAL)


def test_an_untouched_run_is_clean(drawn):
    write(drawn)
    for found in in_both_environments(drawn, EVERY):
        assert {each.status for each in found.values()} == {IDENTICAL}


def test_a_picture_of_moved_data_is_nearly_the_same(drawn):
    write(drawn, seed=7)
    for found in in_both_environments(drawn):
        assert {found[name].status for name in SHOWN} == {NEARLY}
        assert "all words, colours and scales are the same" in found[JSON].says


def title_another(figure):
    """Draw the same data under another title."""
    figure.axes[0].set_title("another")


def of_other_figure(name: str) -> Callable:
    """Return a fault: the file shows the same data in another figure."""
    return lambda run: write(run, name, plant=title_another)


def of_older_run(name: str) -> Callable:
    """Return a fault: the file was drawn of other data."""
    return lambda run: write(run, name, seed=3)


def from_baseline(*names: str) -> Callable:
    """Return a fault: data are new, and these files are those of the accepted run."""
    new = [name for name in SHOWN if name not in names]
    return lambda run: write(run, *new, seed=7)


def edit(old: str, new: str) -> Callable:
    """Return a fault: the description is edited by hand."""

    def plant(run):
        text = (run.made / JSON).read_text(encoding="utf-8")
        assert old in text
        (run.made / JSON).write_text(text.replace(old, new), encoding="utf-8")

    return plant


def hide_fault(run):
    """Draw a picture with a fault, and put the accepted description beside it."""
    write(run, PNG, PDF, plant=FAULTS[0].plant)


def blank_page(run):
    """Write an empty page with the right mark."""
    mark = _mark_of(run)
    empty = style.new_figure(3.0, 1.3)
    FigureCanvasPdf(empty).print_pdf(run.made / PDF, metadata={"Keywords": mark})


def wrong_page(run):
    """Write a page of another size with the right mark."""
    mark, figure = _mark_of(run), draw(chaotic())
    figure.set_size_inches(4, 2)
    FigureCanvasPdf(figure).print_pdf(run.made / PDF, metadata={"Keywords": mark})


def _mark_of(run) -> str:
    return read_description(run.made / JSON).fingerprint


def flip(run):
    """Flip a bit in the middle of the largest stream of the PDF."""
    content = bytearray((run.made / PDF).read_bytes())
    content[content.index(b"stream") + 200] ^= 1
    (run.made / PDF).write_bytes(bytes(content))


def cut(name: str, kept: float) -> Callable:
    """Return a fault: the file is cut off."""

    def plant(run):
        content = (run.made / name).read_bytes()
        (run.made / name).write_bytes(content[: int(kept * len(content))])

    return plant


def rewrite(**saved) -> Callable:
    """Return a fault: the accepted pixels and texts, saved in another form."""

    def plant(run):
        with Image.open(run.made / PNG) as image:
            about = PngInfo()
            for key, text in image.text.items():
                about.add_text(key, text)
            layers = image.convert(saved.get("mode", "RGBA"))
            if "opacity" in saved:
                layers.putalpha(saved["opacity"])
            more = {"save_all": True, "append_images": [layers.rotate(180)]}
            extra = more if saved.get("frames") else {}
            layers.save(
                run.made / PNG, pnginfo=about, dpi=saved.get("dpi", image.info["dpi"]), **extra
            )

    return plant


def table_of(run) -> tuple[bytes, list[bytes]]:
    """Return the PDF, and the entries of its table in their order."""
    content = (run.made / PDF).read_bytes()
    return content, re.findall(rb"\d{10} 00000 n *\r?\n", content)


def permute_table(run):
    """Exchange two entries of the table, so that a viewer takes one object for another."""
    content, entries = table_of(run)
    pair = entries[2] + entries[3]
    assert content.count(pair) == 1
    (run.made / PDF).write_bytes(content.replace(pair, entries[3] + entries[2]))


def turn_trailer(run):
    """Let the trailer name another object as the root of the document."""
    content, _ = table_of(run)
    head, trailer = content[: content.rindex(b"trailer")], content[content.rindex(b"trailer") :]
    assert b"/Root 1 0 R" in trailer
    (run.made / PDF).write_bytes(head + trailer.replace(b"/Root 1 0 R", b"/Root 2 0 R"))


STALE = "was not written with its description: it is stale, or of another figure"
FILES = [
    ("stale PDF", PDF, DIFFERENT, STALE, of_older_run(PDF)),
    ("stale PNG", PNG, DIFFERENT, STALE, of_older_run(PNG)),
    ("PDF of another figure", PDF, DIFFERENT, STALE, of_other_figure(PDF)),
    ("PNG of another figure", PNG, DIFFERENT, STALE, of_other_figure(PNG)),
    ("stale description", JSON, DIFFERENT, "describes other data than", of_older_run(JSON)),
    ("accepted PDF of new data", PDF, DIFFERENT, STALE, from_baseline(PDF)),
    ("accepted PNG of new data", PNG, DIFFERENT, STALE, from_baseline(PNG)),
    ("accepted picture of new data", JSON, DIFFERENT, "other data", from_baseline(PNG, PDF, JSON)),
    ("empty PDF", PDF, DAMAGED, "the PDF is empty", cut(PDF, 0)),
    ("half a PDF", PDF, DAMAGED, "no whole PDF", cut(PDF, 0.5)),
    ("PDF without its end", PDF, DAMAGED, "no whole PDF", cut(PDF, 0.999)),
    ("bit flipped in a PDF", PDF, DAMAGED, "object", flip),
    ("blank page", PDF, DIFFERENT, "has an empty page", blank_page),
    ("page of another size", PDF, DIFFERENT, "4 x 2 inches in place of 3 x 1.3", wrong_page),
    ("objects of a PDF exchanged", PDF, DAMAGED, "objects are not where", permute_table),
    ("another root of a PDF", PDF, DAMAGED, "its root is no catalog", turn_trailer),
    (
        "transparent PNG",
        PNG,
        DIFFERENT,
        "least opacity is 128 in place of 255",
        rewrite(opacity=128),
    ),
    ("invisible PNG", PNG, DIFFERENT, "least opacity is 0 in place of 255", rewrite(opacity=0)),
    ("PNG without opacity", PNG, DIFFERENT, "kind of pixels is RGB", rewrite(mode="RGB")),
    ("second frame of a PNG", PNG, DIFFERENT, "frames is 2 in place of 1", rewrite(frames=2)),
    ("PNG of another size in print", PNG, DIFFERENT, "dpi is (72.0", rewrite(dpi=(72, 72))),
    ("half a PNG", PNG, DAMAGED, "cannot be read", cut(PNG, 0.01)),
    ("edited description", JSON, DIFFERENT, "entry 1 '$A$': text", edit('"$A$"', '"$C$"')),
    ("spaces in a description", JSON, DIFFERENT, "written otherwise", edit("\n ", "\n  ")),
    ("edited, so PNG is other", PNG, DIFFERENT, STALE, edit("summit", "peak")),
    ("edited, so PDF is other", PDF, DIFFERENT, STALE, edit("summit", "peak")),
    ("fault hidden by a description", PNG, DIFFERENT, STALE, hide_fault),
    ("description damaged", JSON, DAMAGED, "cannot be read", cut(JSON, 0.5)),
    ("description lost", JSON, MISSING, "", lambda run: (run.made / JSON).unlink()),
    ("no description of a PNG", PNG, DAMAGED, "no desc", lambda run: (run.made / JSON).unlink()),
    ("no description of a PDF", PDF, DAMAGED, "no desc", lambda run: (run.made / JSON).unlink()),
]


@pytest.mark.parametrize(
    ("file", "status", "says", "plant"), [f[1:] for f in FILES], ids=[f[0] for f in FILES]
)
def test_a_file_that_belongs_to_something_else_is_told(drawn, file, status, says, plant):
    plant(drawn)
    for found in in_both_environments(drawn):
        assert found[file].status == status and says in found[file].says, found[file].line


def redrawn(run) -> None:
    """Draw the PDF with thicker curves, and give it the right mark."""
    mark, figure = _mark_of(run), draw(chaotic())
    figure.axes[0].lines[0].set_linewidth(3)
    FigureCanvasPdf(figure).print_pdf(run.made / PDF, metadata={"Keywords": mark})


def test_a_pdf_that_is_drawn_otherwise_is_told_where_versions_are_the_same(drawn):
    redrawn(drawn)
    same, other = in_both_environments(drawn)
    assert same[PDF].status == DIFFERENT and "drawn otherwise" in same[PDF].says
    assert other[PDF].status == NEARLY


def test_how_a_library_packs_streams_does_not_matter(drawn, monkeypatch):
    before = (drawn.made / PDF).read_bytes()
    monkeypatch.setitem(style._RC, "pdf.compression", 1)
    put(drawn.made, chaotic())
    assert (drawn.made / PDF).read_bytes() != before
    assert drawn.findings(EVERY)[PDF].status == IDENTICAL


def test_errors_of_rounding_move_with_any_bits(tmp_path):
    """A logarithmic axis shows them however regular the data are."""
    for low, shown in ((1e-12, True), (1e-6, False)):
        plant = left(lambda axes, low=low: axes.set(yscale="log", ylim=(low, 8)))
        (tmp_path / "it.json").write_text(as_text(description(regular(), plant)))
        assert shows_rounding(tmp_path / "it.json") == shown
    (tmp_path / "it.json").write_text(as_text(description(regular())))
    assert not shows_rounding(tmp_path / "it.json")


def test_regular_data_of_other_bits_move_no_limit():
    """The allowance for chaotic data is not for all."""
    was, data = description(regular()), regular()
    moved = data.assign(l2=data["l2"] * (1 + 1e-8))
    assert judge(JSON, was, description(moved), Motion.UNSEEN).status == NEARLY
    cut = description(moved, left(lambda axes: axes.set_ylim(0, 7.99)))
    assert judge(JSON, was, cut, Motion.UNSEEN).status == DIFFERENT
    assert judge(JSON, was, cut, Motion.SEEN).status == NEARLY
