"""Compare a picture with that of the baseline: by pixels, by its look, or by its ink."""

from pathlib import Path

import numpy as np

from . import cells, look, pictures
from .findings import DAMAGED, DIFFERENT, IDENTICAL, NEARLY, Finding
from .look import REDUCED
from .pictures import Picture
from .tolerances import LIMITS

HALF_LETTER = 20
EXACT, LOOK = "exact", "look"


def compare(name: str, reference: Path, new: Path, method: str, moved: bool) -> Finding:
    """Return what became of a picture; `moved`: the curves in it are known to have moved."""
    if reference.read_bytes() == new.read_bytes():
        return Finding(name, IDENTICAL)
    pair = []
    for path, which in ((reference, "the picture of the baseline"), (new, "the picture")):
        try:
            pair.append(pictures.read(path))
        except pictures.PictureError as error:
            return Finding(name, DAMAGED, f"{which} {error}")
    return judge(name, *pair, method, moved)


def judge(name: str, was: Picture, now: Picture, method: str, moved: bool) -> Finding:
    """Return the finding by the strictest method that the circumstances allow."""
    if was.pixels.shape != now.pixels.shape:
        sizes = [f"{p.pixels.shape[1]} x {p.pixels.shape[0]} pixels" for p in (now, was)]
        return Finding(name, DIFFERENT, " in place of ".join(sizes))
    if np.array_equal(was.pixels, now.pixels):
        return Finding(name, IDENTICAL)
    if moved:
        return Finding(name, *_by_ink(was, now))
    by_method = {EXACT: _by_pixels, LOOK: _by_look}[method]
    return Finding(name, *by_method(was.pixels, now.pixels))


def _by_pixels(was: np.ndarray, now: np.ndarray) -> tuple[str, str]:
    unlike = (np.maximum(was, now) - np.minimum(was, now)).max(-1) > LIMITS.shade
    part = unlike.mean()
    status = DIFFERENT if part > LIMITS.pixels else NEARLY
    where = f", in {_where(unlike)}" if unlike.any() else ""
    return status, f"{part:.2%} of the pixels differ{where}"


def _by_look(was: np.ndarray, now: np.ndarray) -> tuple[str, str]:
    apart = look.unlikeness(was, now)
    status = DIFFERENT if apart.max() > LIMITS.look else NEARLY
    where = _where(apart >= min(LIMITS.look, apart.max()), REDUCED)
    return status, f"looks unlike by up to {apart.max():.2f} (allowed {LIMITS.look}), in {where}"


def _by_ink(was: Picture, now: Picture) -> tuple[str, str]:
    change, says = cells.changes(was, now)
    # the legend and the titles above the panels do not depend on the curves; the topmost tick does
    head = min((box[1] for box in was.panels), default=0) - HALF_LETTER
    if head > REDUCED and _by_look(was.pixels[:head], now.pixels[:head])[0] == DIFFERENT:
        return DIFFERENT, "what stands above the panels looks different"
    status = DIFFERENT if change > LIMITS.totals else NEARLY
    return status, f"{says} ({LIMITS.totals:.0%} is allowed)"


def _where(mask: np.ndarray, scale: int = 1) -> str:
    """Return the box of what differs, in words."""
    rows, columns = (np.flatnonzero(mask.any(axis)) * scale for axis in (1, 0))
    return f"x {columns[0]}-{columns[-1]}, y {rows[0]}-{rows[-1]}"
