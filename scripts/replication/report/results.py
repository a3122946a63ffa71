"""The files of a run by name, and numbers from them with links, for the article."""

from collections.abc import Iterable
from pathlib import Path

from latticode.datasets.netcdf import read
from pendula.configuration.paper import Differences
from pendula.sources import SCRIPTS

from .words import Quote, number


class ReportError(RuntimeError):
    """A page that cannot be made; the message names what is missing."""


class Results:
    """The files of a run; names are paths seen from the page, without the ending .nc.

    `differs` says where the configuration is not the paper's.
    """

    def __init__(self, files: Iterable[str], page: str, differs: Differences | None = None):
        self.differs = differs or {}
        self._paths = {link_to(path, page): Path(path) for path in files}
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
            raise ReportError(f"the page needs {link}: add it to the inputs of its rule") from None

    def quote(self, name: str, value: float, digits: int = 3) -> Quote:
        """Return a number that links to the dataset it comes from."""
        return self.say(name, number(value, digits))

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
