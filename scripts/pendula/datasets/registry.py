"""Names of variables and attributes in datasets: each name has one meaning.

Names that several datasets share stand here with their long names, so that a writer need not
describe them and cannot give them another meaning. A quantity of one study is described where
it is computed; a test reads all datasets of a run and fails where one name means two things.

Everything in the paper is dimensionless. Time is the slow time tau, so that a rate is "per unit of
tau" and its units are "1", as UDUNITS asks for. Angles are in "rad".
"""

from collections.abc import Mapping
from typing import Any

from pendula import __version__

CONVENTIONS = "CF-1.11"
UNITS = ("1", "rad", "s", "s-1", "byte", "byte s-1")
"""All units in use; each is one that UDUNITS parses."""

NAMES = {
    # coordinates
    "tau": "slow time",
    "snapshot_tau": "slow time of the snapshots",
    "growth_tau": "slow time",
    "component": "pendulum of each pair",
    "site": "site of the chain",
    "part": "part of a complex number",
    "half_width": "half-width M of the chain of 2M + 1 pairs",
    "quantity": "pendulum of each pair, or both",
    "statistic": "statistic over the time window",
    "window": "time window, both ends included",
    "case": "case",
    "sweep": "sweep",
    "solver": "solver",
    "boundary": "ends of the chain",
    "member": "member of the ensemble",
    "sample": "number of the sample",
    "reading": "reading of the paper",
    "curve_omega": "detuning Omega, on a finer grid",
    "panel": "panel of the figure",
    "initial_size": "size of the initial data, small or large",
    # the problem
    "omega": "detuning Omega",
    "gamma": "strength of the drive, gamma",
    "epsilon": "coupling of neighbours, epsilon",
    "mu": "small parameter mu",
    "initial": "initial {site: [A, B]}",
    "sites": "number of sites N",
    # the solution
    "linf": "l-infinity norm over the chain",
    "l2": "l2 norm over the chain",
    "energy": "conserved energy H of equation (8)",
    "modulus": "modulus of the amplitude on a site",
    "amplitude": "amplitude on a site",
    # what several studies have of their own
    "family": "family",
    "frequency": "frequency lambda",
    "power": "power P",
    "share": "share of",
    "size": "size of",
    "final": "amplitude at the end time",
    "bound": "bound",
    "end": "end of the time window",
    "error": "error",
    "order": "order in mu of the error",
    "span": "span of",
    "region": "region",
    "kind": "kind of",
    "distance": "distance",
    "contraction": "contraction",
    "exponent": "exponent of",
    "antisymmetric_power": "power",
}
"""Long names of variables that several datasets share; all of them have the units "1"."""
ANGLES = ("linf", "l2", "modulus", "final", "error")
"""Those that are angles in "rad" where the pendula themselves are followed."""


SOLVER_NAMES = {
    "ode45": "ode45",
    "ode45_real": "ode45 (real)",
    "crank_nicolson": "Crank\N{EN DASH}Nicolson",
    "delfour_fortin_payre": "Delfour\N{EN DASH}Fortin\N{EN DASH}Payre",
    "dop853": "DOP853",
    "taylor": "Taylor",
    "auto": "Taylor by error",
    "kahan_li": "Kahan\N{EN DASH}Li",
}
"""The solvers as figures and pages write them."""


class NamingError(ValueError):
    """A variable has no description, or units that its name does not have."""


def describe(name: str, long_name: str = "", units: str = "1") -> dict[str, str]:
    """Return `long_name` and `units` of a variable; the registry names what has no long name.

    Raises NamingError if nobody names the variable, or if its units are not among UNITS.
    """
    if not (long_name or name in NAMES):
        raise NamingError(f"{name}: has no long_name, and is not in datasets/registry.py")
    known = ("1", "rad") if name in ANGLES else ("1",) if name in NAMES else UNITS
    if units not in known:
        raise NamingError(f"{name}: has the units {units!r}; known are {', '.join(known)}")
    return {"long_name": long_name or NAMES[name], "units": units}


def complete(attributes: Mapping[str, Any], title: str) -> dict[str, Any]:
    """Return a dataset's attributes together with those that every file has.

    No date, host, user or path is among them: two runs give the same content.
    """
    made_by = f"computed by pendula {__version__}"
    fixed = {"Conventions": CONVENTIONS, "version": __version__, "history": made_by}
    return {"title": title, **attributes, **fixed}
