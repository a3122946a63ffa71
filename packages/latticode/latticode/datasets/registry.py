"""Names of variables and attributes in datasets: each name has one meaning.

Names that several datasets share stand here with their long names, so that a writer need not
describe them and cannot give them another meaning. A quantity of one study is described where
it is computed; a test reads all datasets of a run and fails where one name means two things.

Equations are taken as dimensionless. So a rate is "per unit of time" and its units are "1", as
UDUNITS asks for; angles are in "rad".
"""

from collections.abc import Mapping
from typing import Any

from latticode import __version__
from latticode.integrators.methods import NAMED

CONVENTIONS = "CF-1.11"
MADE_BY = {"version": __version__, "history": f"computed by latticode {__version__}"}
"""What made a dataset; a program that calls the library names itself here."""
WAYS = {"make": "call simulate and save"}
"""What a message tells a user to do; a program that calls the library names its own commands."""
UNITS = ("1", "rad", "s", "s-1", "byte", "byte s-1")
"""All units in use; each is one that UDUNITS parses."""

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
"""Long names of variables that several datasets share; all of them have the units "1". A program
that calls the library adds its own, or gives its own words for these."""
ANGLES = ("linf", "l2", "modulus", "final", "state", "error")
"""Those that are angles in "rad" where pendula are followed."""


SOLVER_NAMES = {name: method.label for name, method in NAMED.items()} | {
    "auto": "two methods by error"
}
"""The solvers as figures and pages write them."""


class NamingError(ValueError):
    """A variable has no description, or units that its name does not have."""


def describe(name: str, long_name: str = "", units: str = "1") -> dict[str, str]:
    """Return `long_name` and `units` of a variable; the registry names what has no long name.

    Raises NamingError if nobody names the variable, or if its units are not among UNITS.
    """
    if not (long_name or name in NAMES):
        raise NamingError(f"{name}: has no long_name; give it one by .attrs['long_name'] = ...")
    known = ("1", "rad") if name in ANGLES else ("1",) if name in NAMES else UNITS
    if units not in known:
        raise NamingError(f"{name}: has the units {units!r}; known are {', '.join(known)}")
    return {"long_name": long_name or NAMES[name], "units": units}


def complete(attributes: Mapping[str, Any], title: str) -> dict[str, Any]:
    """Return a dataset's attributes together with those that every file has.

    No date, host, user or path is among them: two runs give the same content.
    """
    return {"title": title, **attributes, "Conventions": CONVENTIONS, **MADE_BY}
