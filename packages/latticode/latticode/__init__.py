"""Chains of coupled oscillators: equations written once, compiled, integrated and measured.

A model is a function of its fields (see `equations.model`); kernels follow from its trace. The
public names are listed in `latticode.__all__` and explained in `help(latticode.notebook)`.
"""

from importlib import import_module

__version__ = "0.1.0"

_HOMES = {
    "latticode.equations.model": (
        *("Model", "ModelError", "lap", "abs2", "conj", "shift"),
        *("sin", "cos", "exp", "log", "sqrt"),
    ),
    "latticode.equations.symbols": ("abs", "max", "sign", "where"),
    "latticode.notebook": (
        *("Case", "simulate", "sweep", "survey", "check", "read"),
        *("draw_breather", "draw_norms", "draw_spacetime", "draw_survey", "draw_sweep"),
    ),
    "latticode.datasets.netcdf": ("save",),
    "latticode.datasets": ("DatasetError",),
    "latticode.configuration.files": ("ConfigurationError",),
    "latticode.simulation.simulate": ("IntegrationError",),
}
"""The public names by their module. A module is loaded when a name of it is first asked for, so
that nobody waits for modules that he does not use."""

__all__ = sorted(name for names in _HOMES.values() for name in names)


def __getattr__(name: str):
    for home, names in _HOMES.items():
        if name in names:
            return getattr(import_module(home), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])
