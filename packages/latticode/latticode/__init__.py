"""Chains of coupled oscillators: equations written once, compiled, integrated and analysed.

A model is a function of its fields (see `equations.model`), from which kernels are generated. The
public names are in `latticode.__all__`, and most are explained in `help(latticode.notebook)`.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # for type checkers and editors; a test compares it with _HOMES
    from latticode.configuration.files import ConfigurationError as ConfigurationError
    from latticode.datasets import DatasetError as DatasetError
    from latticode.datasets.netcdf import save as save
    from latticode.equations.model import Model as Model
    from latticode.equations.model import ModelError as ModelError
    from latticode.equations.model import abs2 as abs2
    from latticode.equations.model import conj as conj
    from latticode.equations.model import cos as cos
    from latticode.equations.model import exp as exp
    from latticode.equations.model import lap as lap
    from latticode.equations.model import log as log
    from latticode.equations.model import shift as shift
    from latticode.equations.model import sin as sin
    from latticode.equations.model import sqrt as sqrt
    from latticode.equations.symbols import abs as abs
    from latticode.equations.symbols import couple as couple
    from latticode.equations.symbols import max as max
    from latticode.equations.symbols import sign as sign
    from latticode.equations.symbols import where as where
    from latticode.notebook import Case as Case
    from latticode.notebook import check as check
    from latticode.notebook import draw_breather as draw_breather
    from latticode.notebook import draw_norms as draw_norms
    from latticode.notebook import draw_spacetime as draw_spacetime
    from latticode.notebook import draw_survey as draw_survey
    from latticode.notebook import draw_sweep as draw_sweep
    from latticode.notebook import lyapunov as lyapunov
    from latticode.notebook import read as read
    from latticode.notebook import section as section
    from latticode.notebook import simulate as simulate
    from latticode.notebook import survey as survey
    from latticode.notebook import sweep as sweep
    from latticode.simulation.simulate import IntegrationError as IntegrationError

__version__ = "0.2.0"

_EQUATIONS = "Model ModelError abs2 conj cos exp lap log shift sin sqrt"
_NOTEBOOK = (
    "Case check draw_breather draw_norms draw_spacetime draw_survey draw_sweep lyapunov read"
    " section simulate survey sweep"
)
_HOMES = {
    "latticode.configuration.files": "ConfigurationError",
    "latticode.datasets": "DatasetError",
    "latticode.datasets.netcdf": "save",
    "latticode.equations.model": _EQUATIONS,
    "latticode.equations.symbols": "abs couple max sign where",
    "latticode.notebook": _NOTEBOOK,
    "latticode.simulation.simulate": "IntegrationError",
}
"""The public names by module. A module is imported when one of its names is first used."""

__all__ = sorted(name for names in _HOMES.values() for name in names.split())

if not TYPE_CHECKING:

    def __getattr__(name: str) -> object:
        for home, names in _HOMES.items():
            if name in names.split():
                return getattr(import_module(home), name)
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])
