"""Planted faults in pictures, by pixels and by look; other fonts pass by look."""

import made_up_results as made_up
import matplotlib
import numpy as np
import pytest
from made_up_results import CHAOTIC_PICTURE, PICTURE, chaotic, regular
from pendula.drawing import style
from pendula.figure_diff import DAMAGED, DIFFERENT, IDENTICAL, NEARLY, Motion, compare_images
from pendula.figure_diff.compare_images import Method, Picture

FAULTS = {
    "swapped colours": {"colours": ("B", "A")},
    "one wrong colour": {"colours": ("A", "dop853")},
    "lost label": {"label": " "},
    "missing panel": {"panels": 1},
}


@pytest.mark.parametrize("fault", FAULTS.values(), ids=FAULTS)
def test_a_planted_fault_is_named_in_one_line(run, fault):
    made_up.put(run.made, "fig2", regular(), **fault)
    for line in in_both_environments(run, PICTURE):
        assert line.startswith(f"different: {PICTURE}: ") and "\n" not in line


def in_both_environments(run, picture: str) -> list[str]:
    """Return what is found by pixels, or by ink, and what in another environment."""
    names = [picture, picture.replace(".png", ".nc")]
    here = run.findings(names)[picture].line
    run.move_to_another_environment()
    return [here, run.findings(names)[picture].line]


@pytest.mark.parametrize("fault", [name for name in FAULTS if name != "lost label"])
def test_faults_are_found_where_the_curves_have_moved(run, fault):
    """Lost labels are left to the description there: chaotic curves may move as much ink."""
    made_up.put(run.made, "fig4", chaotic(seed=7), **FAULTS[fault])
    for line in in_both_environments(run, CHAOTIC_PICTURE):
        assert line.startswith(f"different: {CHAOTIC_PICTURE}: ")


def _pixels(**changes) -> Picture:
    figure = made_up.draw(regular(), **changes)
    with style.thrifty():
        figure.canvas.draw()
    return Picture(np.asarray(figure.canvas.buffer_rgba())[..., :3].copy(), [], {})


@pytest.fixture(scope="module")
def was() -> Picture:
    """Return the accepted picture."""
    return _pixels()


def _status(was: Picture, now: Picture, method: Method) -> str:
    return compare_images.judge(PICTURE, was, now, method).status


@pytest.mark.parametrize(
    ("key", "value"),
    [("text.antialiased", False), ("axes.labelsize", 8.1), ("xtick.labelsize", 7.4)],
)
def test_letters_drawn_otherwise_look_the_same(was, monkeypatch, key, value):
    monkeypatch.setitem(style._RC, key, value)
    now = _pixels()
    assert (was.colours != now.colours).any()
    assert _status(was, now, Method.LOOK) == NEARLY
    assert _status(was, now, Method.PIXELS) == DIFFERENT


@pytest.mark.parametrize("step", [(0, 1), (1, 0), (2, -2)])
def test_a_shift_by_a_pixel_looks_the_same(was, step):
    shifted = Picture(np.roll(was.colours, step, (0, 1)), [], {})
    assert _status(was, shifted, Method.LOOK) == NEARLY


def test_other_letters_do_not_look_the_same(was):
    assert _status(was, _pixels(label="energy"), Method.LOOK) == DIFFERENT


def test_a_single_shade_of_a_pixel_is_found_by_pixels(was):
    colours = was.colours.copy()
    colours[100, 200, 1] -= 1
    found = compare_images.judge(PICTURE, was, Picture(colours, [], {}), Method.PIXELS)
    assert found.status == DIFFERENT and found.says == "1 pixels differ, in x 200-200, y 100-100"
    assert _status(was, Picture(colours, [], {}), Method.LOOK) == NEARLY


@pytest.mark.parametrize(
    ("motion", "here", "elsewhere"),
    [
        (Motion.NONE, Method.PIXELS, Method.LOOK),
        (Motion.UNSEEN, Method.LOOK, Method.LOOK),
        (Motion.SEEN, Method.INK, Method.INK),
        (Motion.WRONG, Method.LOOK, Method.LOOK),
    ],
)
def test_the_less_the_data_moved_the_stricter_a_picture_is_compared(motion, here, elsewhere):
    assert compare_images.method(motion, same_environment=True) == here
    assert compare_images.method(motion, same_environment=False) == elsewhere


@pytest.mark.parametrize(("top", "status"), [(20, DIFFERENT), (110, NEARLY)])
def test_where_curves_have_moved_a_title_may_not(top, status):
    """Ink that moves within its cell is that of a curve, but above the panels it is a text."""
    pictures = []
    for left in (40, 190):
        colours = np.full((220, 300, 3), 255, np.uint8)
        colours[top : top + 20, left : left + 60] = 0
        pictures.append(Picture(colours, [(30, 100, 270, 190)], {}))
    assert _status(*pictures, Method.INK) == status


@pytest.mark.parametrize("kept", [100, 5000], ids=["header", "half of the pixels"])
def test_a_damaged_picture(any_environment, kept):
    path = any_environment.made / PICTURE
    path.write_bytes(path.read_bytes()[:kept])
    (line,) = any_environment.faults()
    assert line.startswith(f"{DAMAGED}: {PICTURE}: the picture cannot be read")


def test_another_size(was):
    found = compare_images.judge(PICTURE, was, Picture(was.colours[:-10], [], {}), Method.LOOK)
    assert found.status == DIFFERENT and "1200 x 530 pixels in place of 1200 x 540" in found.says


def test_a_saved_figure_names_its_panels(run):
    left, right = compare_images.read(run.made / PICTURE).panels
    assert left[2] < right[0] and left[1] == right[1] and left[3] == right[3]


def test_drawing_twice_gives_the_same_picture(run):
    made_up.put(run.made, "fig2", regular())
    assert run.findings()[PICTURE].status == IDENTICAL, matplotlib.__version__
