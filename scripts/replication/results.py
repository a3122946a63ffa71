"""The files of a run by name, as the article and the report read them."""

from collections.abc import Iterable, Mapping
from pathlib import Path

import xarray as xr
from latticode.datasets.netcdf import read


class ReportError(RuntimeError):
    """A page cannot be made; the message names the missing file."""


class Results:
    """The files of a run; names are paths relative to the page, of datasets without .nc.

    `differs` describes the differences of the configuration from the paper's by path.
    """

    def __init__(
        self, files: Iterable[str], page: str, differs: Mapping[str, str] | None = None
    ) -> None:
        self.differs = differs or {}
        self._paths = {link_to(path, page): Path(path) for path in files}
        self._read = {}

    def __getitem__(self, name: str) -> xr.Dataset:
        """Return a dataset such as "checks/lyapunov"."""
        if name not in self._read:
            self._read[name] = read(self.path(f"{name}.nc"))
        return self._read[name]

    def __contains__(self, name: str) -> bool:
        return f"{name}.nc" in self._paths

    def path(self, link: str) -> Path:
        """Return the path of the file to which the page links as `link`."""
        try:
            return self._paths[link]
        except KeyError:
            raise ReportError(f"the page needs {link}: add it to the inputs of its rule") from None


def link_to(path: str, page: str) -> str:
    """Return the path of a file of the run relative to the page, for a link."""
    return Path(path).relative_to(Path(page).parent).as_posix()
