"""Each lattice of the gallery runs as it is printed, and its number is that of another source."""

import re

import matplotlib as mpl
import numpy as np
import pytest
from page_examples import GALLERY, HOME, ILLUSTRATED, digest_in, digest_of, picture_of, run_page
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.special import j0
from test_published_numbers import leapfrog

LARGEST = 60_000
"""Bytes of a picture."""


def recurrence_without_step() -> float:
    """Return the recurrence of the scheme of 1955, which has order two, at a step of zero."""
    published, finer = (leapfrog(8**-0.5 / divisor, 0.25, 10200)[0] for divisor in (1, 2))
    return finer - (published - finer) / 3


def speed_of_pulse() -> float:
    """Return the speed of a pulse of FitzHugh and Nagumo between the sites 20 and 60, by SciPy."""

    def slope(t, state):
        v, w = state.reshape(2, 100)
        spread = np.roll(v, 1) + np.roll(v, -1) - 2 * v
        return np.concatenate([v - v**3 / 3 - w + spread, 0.08 * (v + 0.7 - 0.8 * w)])

    def first(t, state):
        return state[20]

    def last(t, state):
        return state[60]

    first.direction = last.direction = 1
    n = np.arange(100)
    start = np.concatenate([np.where(n < 5, 1.5, -1.2), np.where(n < 70, -0.625, 0.5)])
    solved = solve_ivp(
        slope, (0, 120), start, "DOP853", rtol=1e-12, atol=1e-12, max_step=0.1, events=[first, last]
    )
    begin, end = (times[0] for times in solved.t_events)
    return 40 / (end - begin)


def locked_order() -> float:
    """Return Kuramoto's order parameter of 50 clocks at K = 2, by its own equation."""
    speed = np.linspace(-1, 1, 50)
    return brentq(lambda r: np.sqrt(1 - (speed / (2 * r)) ** 2).mean() - r, 0.6, 1, xtol=1e-14)


EXPECTED = {
    "ablowitz_ladik": lambda: pytest.approx(2 * np.sinh(0.8) * np.sin(0.6) / 0.8, abs=1e-9),
    "bloch_oscillations": lambda: pytest.approx(2 * np.sqrt(2) / 0.5, abs=1e-9),
    # to first order in the root of the coupling
    "breather": lambda: pytest.approx(2 * np.sqrt(0.01), rel=0.01),
    "fermi_pasta_ulam": lambda: pytest.approx(recurrence_without_step(), abs=0.5),
    "fitzhugh_nagumo": lambda: pytest.approx(speed_of_pulse(), rel=1e-8),
    "henon_heiles": lambda: pytest.approx(0.1274, abs=3.5 * 0.0045),
    "kuramoto": lambda: pytest.approx(locked_order(), abs=1e-12),
    "lorenz_1996": lambda: pytest.approx(1.67, abs=3.5 * 0.009),
    "newtons_cradle": lambda: pytest.approx(0.682, abs=0.001),
    "self_trapping": lambda: pytest.approx(4, abs=0.01),
    "square_array": lambda: pytest.approx(j0(8) ** 4, rel=1e-5),
    "toda": lambda: pytest.approx(np.sinh(1), abs=1e-10),
}
"""The number of each page by another source. Chaotic ones are allowed 3.5 standard errors."""


@pytest.mark.parametrize("page", GALLERY, ids=lambda page: page.stem)
def test_a_lattice_of_the_gallery_gives_the_number_of_its_source(page):
    mpl.use("agg")
    text = page.read_text("utf-8")
    ((name, printed),) = re.findall(r"^\*\*`(\w+)` = ([\d.]+)\*\*", text, re.M)
    number = run_page(page)[name]
    assert f"{number:.{len(printed.partition('.')[2])}f}" == printed
    assert number == EXPECTED[page.stem]()


def test_the_gallery_has_twelve_lattices_and_a_page_that_leads_to_each():
    index = (HOME / "docs/gallery/README.md").read_text("utf-8")
    assert sorted(EXPECTED) == [page.stem for page in GALLERY] and len(GALLERY) == 12
    for page in GALLERY:
        assert f"({page.name})" in index and f"(pictures/{page.stem}.png)" in index


@pytest.mark.parametrize("page", ILLUSTRATED, ids=lambda page: page.stem)
def test_a_page_begins_with_a_small_picture_that_its_example_drew(page):
    picture = picture_of(page)
    assert picture.stat().st_size < LARGEST
    redraw = "run `python packages/latticode/tests/page_examples.py`"
    assert digest_in(picture) == digest_of(page), redraw
