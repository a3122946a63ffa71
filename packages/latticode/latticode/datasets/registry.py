"""Names of variables and attributes in datasets: each name has one meaning.

Names that several datasets share are listed here with their long names. A quantity of only one
study is described where it is computed. A test reads all datasets of a run, and fails if a name has
two meanings.

Equations are treated as dimensionless: a rate "per unit of time" has the units "1", as UDUNITS
requires. Angles are in "rad".
"""

from collections.abc import Mapping
from typing import Any

from latticode import __version__
from latticode.integrators.methods import NAMED

CONVENTIONS = "CF-1.11"
MADE_BY = {"version": __version__, "history": f"computed by latticode {__version__}"}
"""Attributes that name the program that computed a dataset; a program replaces them by its own."""
WAYS = {"make": "call simulate and save"}
"""Remedies in messages; a program replaces them by its own commands."""
UNITS = ("1", "rad", "s", "s-1", "byte", "byte s-1")
"""All allowed units; UDUNITS can parse each of them."""

NAMES = {
    # coordinates
    "tau": "time",
    "snapshot_tau": "time of the snapshots",
    "component": "field",
    "site": "site of the chain",
    "part": "part of a complex number",
    "end_time": "end time",
    "half_width": "half-width M of the chain of 2M + 1 sites",
    "quantity": "field, or all of them",
    "statistic": "statistic over the time window",
    "window": "time window, both ends included",
    "case": "case",
    "sweep": "sweep",
    "solver": "solver",
    "boundary": "ends of the chain",
    "member": "member of the ensemble",
    "sample": "number of the sample",
    # the solution
    "linf": "l-infinity norm over the chain",
    "l2": "l2 norm over the chain",
    "modulus": "modulus of a field on a site",
    "final": "field at the end time",
    "state": "field at the snapshots",
}
"""Long names of variables that several datasets share; their units are "1". A program may add names
or replace long names."""
ANGLES = ("linf", "l2", "modulus", "final", "state", "error")
"""Variables that may also be in "rad": they are angles if the equations are those of pendula."""


SOLVER_NAMES = {name: method.label for name, method in NAMED.items()} | {
    "auto": "two methods by error"
}
"""The names of solvers in figures and pages."""


class NamingError(ValueError):
    """A variable has no long name, or units that are not allowed for its name."""


def describe(name: str, long_name: str = "", units: str = "1") -> dict[str, str]:
    """Return `long_name` and `units` of a variable; an empty long name is read from the registry.

    Raises NamingError if the registry has no long name either, or if the units are not allowed.
    """
    if not (long_name or name in NAMES):
        raise NamingError(f"{name}: has no long_name; give it one by .attrs['long_name'] = ...")
    known = ("1", "rad") if name in ANGLES else ("1",) if name in NAMES else UNITS
    if units not in known:
        raise NamingError(f"{name}: has the units {units!r}; give one of {', '.join(known)}")
    return {"long_name": long_name or NAMES[name], "units": units}


def complete(attributes: Mapping[str, Any], title: str) -> dict[str, Any]:
    """Return the attributes of a dataset, and add the attributes that all files share.

    There is no date, host, user or path, so that two runs give the same content.
    """
    return {"title": title, **attributes, "Conventions": CONVENTIONS, **MADE_BY}
