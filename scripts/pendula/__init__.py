"""Coupled PT-symmetric dNLS chains: the equations, their solvers, datasets and plots.

For notebooks: `from pendula import Case, simulate, sweep, check, read, draw_norms`. The public
names are listed in `pendula.__all__` and explained in `help(pendula.notebook)`.
"""

from importlib import import_module
from typing import TYPE_CHECKING

from . import sources  # noqa: F401, registers the folders whose code is hashed

if TYPE_CHECKING:  # for type checkers and editors; a test compares it with _HOMES
    from latticode.configuration.files import ConfigurationError as ConfigurationError
    from latticode.datasets import DatasetError as DatasetError
    from latticode.datasets.netcdf import save as save
    from latticode.equations.model import Model as Model
    from latticode.equations.model import ModelError as ModelError
    from latticode.equations.model import abs2 as abs2
    from latticode.equations.model import lap as lap
    from latticode.simulation.simulate import IntegrationError as IntegrationError

    from pendula.notebook import Case as Case
    from pendula.notebook import check as check
    from pendula.notebook import draw_breather as draw_breather
    from pendula.notebook import draw_norms as draw_norms
    from pendula.notebook import draw_spacetime as draw_spacetime
    from pendula.notebook import draw_survey as draw_survey
    from pendula.notebook import draw_sweep as draw_sweep
    from pendula.notebook import read as read
    from pendula.notebook import simulate as simulate
    from pendula.notebook import survey as survey
    from pendula.notebook import sweep as sweep

__version__ = "1.0.0"
RELEASED = "2026-11-23"
"""The date of this version, as in CITATION.cff."""

_NOTEBOOK = (
    "Case check draw_breather draw_norms draw_spacetime draw_survey draw_sweep read simulate survey"
    " sweep"
)
_HOMES = {
    "latticode.configuration.files": "ConfigurationError",
    "latticode.datasets": "DatasetError",
    "latticode.datasets.netcdf": "save",
    "latticode.equations.model": "Model ModelError abs2 lap",
    "latticode.simulation.simulate": "IntegrationError",
    "pendula.notebook": _NOTEBOOK,
}
"""The public names by their module. A module is imported when one of its names is first used, so
that jobs do not wait for modules that they do not need."""

__all__ = sorted(name for names in _HOMES.values() for name in names.split())


if not TYPE_CHECKING:

    def __getattr__(name: str) -> object:
        for home, names in _HOMES.items():
            if name in names.split():
                return getattr(import_module(home), name)
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])
