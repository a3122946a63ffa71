"""Coupled PT-symmetric dNLS chains: the equations, their solvers, datasets and plots.

For notebooks: `from pendula import Case, simulate, sweep, check, read, draw_norms`. The public
names are listed in `pendula.__all__` and explained in `help(pendula.notebook)`.
"""

from importlib import import_module

from . import sources  # noqa: F401, so that hashes of code follow the imports of this package

__version__ = "1.0.0"
RELEASED = "2026-11-23"
"""The date of this version, as in CITATION.cff."""

_HOMES = {
    "pendula.notebook": (
        *("Case", "simulate", "sweep", "survey", "check", "read"),
        *("draw_breather", "draw_norms", "draw_spacetime", "draw_survey", "draw_sweep"),
    ),
    "latticode.datasets.netcdf": ("save", "DatasetError"),
    "latticode.equations.model": ("Model", "ModelError", "abs2", "lap"),
    "latticode.configuration.files": ("ConfigurationError",),
    "latticode.simulation.simulate": ("IntegrationError",),
}
"""The public names by their module. A module is loaded when a name of it is first asked for, so
that no job waits for modules that it does not use."""

__all__ = sorted(name for names in _HOMES.values() for name in names)


def __getattr__(name: str):
    for home, names in _HOMES.items():
        if name in names:
            return getattr(import_module(home), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])
