"""The files of a run by name, with links to them, and the parts of a section of the report."""

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from markupsafe import Markup

from pendula.configuration.paper import Differences
from pendula.datasets.netcdf import read
from pendula.sources import SCRIPTS

from .page import Picture, picture
from .words import Quote, number, with_error


class ReportError(RuntimeError):
    """A report that cannot be made; the message names what is missing."""


class Results:
    """The files of a run; names are paths seen from the page, without the ending .nc or .png.

    `settings` is the configuration of the run's cases and sweeps, `differs` says where it is not
    the paper's. `references` are the project's own, which sections call truth/<name>.
    """

    def __init__(
        self,
        files: Iterable[str],
        page: str,
        settings: Mapping | None = None,
        differs: Differences | None = None,
        references: Iterable[str] = (),
    ):
        self.settings, self.differs = settings or {}, differs or {}
        self._paths = {link_to(path, page): Path(path) for path in files}
        self._paths |= {f"truth/{Path(path).name}": Path(path) for path in references}
        self._read = {}

    def __getitem__(self, name: str):
        """Return a dataset such as "checks/lyapunov"."""
        if name not in self._read:
            self._read[name] = read(self.path(f"{name}.nc"))
        return self._read[name]

    def __contains__(self, name: str) -> bool:
        return f"{name}.nc" in self._paths

    def path(self, link: str) -> Path:
        """Return where the file is to which the page links."""
        try:
            return self._paths[link]
        except KeyError:
            raise ReportError(
                f"the report needs {link}: add it to the inputs of the rule `report`"
            ) from None

    def figure(self, name: str, caption: str) -> "Figure":
        """Return a figure such as "fig5"; its description is the first sentence of the caption."""
        alt = re.sub(r"<[^>]*>", "", caption).partition(". ")[0].rstrip(".")
        return Figure(self.picture(name, Markup(alt).unescape()), Markup(caption))

    def picture(self, name: str, alt: str) -> Picture:
        """Return the picture of a figure, described in words."""
        link = f"figures/{name}.png"
        return picture(self.path(link), alt, link)

    def quote(self, name: str, value: float, digits: int = 3) -> Quote:
        """Return a number that links to the dataset it comes from."""
        return self.say(name, number(value, digits))

    def quote_error(self, name: str, value: float, error: float) -> Quote:
        """Return a number with its standard error, linked in the same way."""
        return self.say(name, with_error(value, error))

    def quote_time(self, name: str, tau: float) -> Quote:
        """Return a time, or that it never comes, or that it is not known."""
        words = "never" if tau == np.inf else "not known" if np.isnan(tau) else number(tau, 4)
        return self.say(name, words)

    def say(self, name: str, text: str) -> Quote:
        """Return words made from a dataset, or from another file with its ending, linked to it."""
        link = f"{name}.nc" if name in self else name
        self.path(link)
        return Quote(text, link)


def link_to(path: str, page: str) -> str:
    """Return how a page links to a file of the run, or of the project, where results lie in it."""
    if Path(path).is_relative_to(SCRIPTS.parent / "tests"):
        return (Path("..") / Path(path).relative_to(SCRIPTS.parent)).as_posix()
    return Path(path).relative_to(Path(page).parent).as_posix()


class Table(NamedTuple):
    """A table with a caption; each cell is a text or a quote. A table without rows is not shown."""

    title: str
    head: Sequence[str]
    rows: Sequence[Sequence]
    folded: bool = False


class Figure(NamedTuple):
    """A picture with its caption, which is HTML."""

    picture: Picture
    caption: Markup


class Film(NamedTuple):
    """A film of the pendula; `rows` is its last picture: two rows of lines with their ends.

    `frames` holds a byte for each angle, 127 for half a turn, time after time, in base 64; `step`
    is the time between two of its `pictures`.
    """

    frames: str
    pictures: int
    sites: int
    step: float
    per_period: int
    rows: Sequence[Sequence[Mapping]]
    caption: Markup


class Section(NamedTuple):
    """A part of the report under a heading of its own.

    `gather` takes the results and the ledger, and returns parts by name: tables, figures, films, a
    text as a paragraph, or again parts by name, whose name is then their heading. A section is
    folded unless it is `opened`.
    """

    name: str
    title: str
    gather: Callable[[Results, Any], Mapping[str, Any]]
    opened: bool = False
